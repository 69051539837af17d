#pragma once

#include "geometry/shape.h"
#include "query/tolerance.h"

/// Pairs beyond the range of single precision. A crate of 2 cm on a floor of 20 km: a corner of the
/// floor is rounded to a millimetre, and so is every point that clipping computes from it, however
/// close to the crate. Such a pair is computed in double from its float data, and the result is
/// rounded once, in the world. Wider tolerances would not help: the numbers themselves are lost.
namespace contactscope {

/// Metres.
struct Lengths {
  float reach = 0;  // largest distance of a point from the shape's centre or its origin
  float size = 0;   // radius
};

inline Lengths lengths_of(const Shape<float>& shape) {
  if (const auto* hull = std::get_if<Hull<float>>(&shape)) return {hull->radius, hull->radius};
  if (const auto* sphere = std::get_if<Sphere<float>>(&shape))
    return {sphere->radius, sphere->radius};
  const auto& [points, radius] = *std::get_if<Capsule<float>>(&shape);
  return {points[0].cwiseAbs().cwiseMax(points[1].cwiseAbs()).maxCoeff() + radius, radius};
}

/// Whether a pair is one of these: four roundings of the larger shape exceed the preference for an
/// axis at touching, 0.2% of the smaller shape (tolerance.h). That is a size ratio of about four
/// thousand. Never for planes, which have no corners, nor for meshes, which are too large to copy.
inline bool belongs_in_double(const Shape<float>& a, const Shape<float>& b) {
  if (!is_convex(kind_of(a)) || !is_convex(kind_of(b))) return false;
  const Lengths of_a = lengths_of(a), of_b = lengths_of(b);
  const float rounding = tie_tolerance(std::max(of_a.reach, of_b.reach));
  return rounding > preference_tolerance(0.0F, std::min(of_a.size, of_b.size));
}

/// The same numbers, for convex shapes and planes.
inline Shape<double> in_double(const Shape<float>& shape) {
  if (const auto* sphere = std::get_if<Sphere<float>>(&shape))
    return Sphere<double>{sphere->radius};
  if (const auto* capsule = std::get_if<Capsule<float>>(&shape))
    return Capsule<double>{{capsule->points[0].cast<double>(), capsule->points[1].cast<double>()},
                           capsule->radius};
  if (const auto* half_space = std::get_if<HalfSpace<float>>(&shape))
    return HalfSpace<double>{half_space->plane.cast<double>()};
  return hull_cast<double>(std::get<Hull<float>>(shape));
}

/// The rotation is normalized to double precision, so that a long lever keeps its length.
template <class S> Pose<double> in_double(const Pose<S>& pose) {
  Pose<double> wide = pose.template cast<double>();
  wide.rotation.normalize();
  return wide;
}

}  // namespace contactscope
