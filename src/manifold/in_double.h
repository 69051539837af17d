#pragma once

#include <algorithm>

#include "core/pose.h"
#include "geometry/shape.h"
#include "query/tolerance.h"

/// Pairs that single precision cannot hold together. A crate of 2 cm on a floor of 20 km: a corner of
/// the floor is rounded by a millimetre, and so is what clipping makes of it, however close to the
/// crate. Such a pair is worked on in double from what float holds of it, and the result is rounded
/// once, in the world. Tolerances that look away from the far corners would not do: the numbers
/// themselves are lost.
namespace contactscope {

/// Metres.
struct Lengths {
  float reach = 0;  // of any point, from the shape's middle or its origin
  float size = 0;   // radius
};

inline Lengths lengths_of(const Shape<float>& shape) {
  if (const auto* hull = std::get_if<Hull<float>>(&shape)) return {hull->radius, hull->radius};
  if (const auto* sphere = std::get_if<Sphere<float>>(&shape))
    return {sphere->radius, sphere->radius};
  const auto& [points, radius] = *std::get_if<Capsule<float>>(&shape);
  return {points[0].cwiseAbs().cwiseMax(points[1].cwiseAbs()).maxCoeff() + radius, radius};
}

/// Whether the pair is one of these: four roundings of the larger shape are more than what the
/// preference for an axis grants at a kiss, 0.2% of the smaller one (tolerance.h). That is where one is
/// some four thousand times the other. Never of planes, which have no corners, nor of meshes, which
/// are too large to be copied.
inline bool belongs_in_double(const Shape<float>& a, const Shape<float>& b) {
  if (!is_convex(kind_of(a)) || !is_convex(kind_of(b))) return false;
  const Lengths of_a = lengths_of(a);
  const Lengths of_b = lengths_of(b);
  const float rounding = tie_tolerance(std::max(of_a.reach, of_b.reach));
  return rounding > preference_tolerance(0.0F, std::min(of_a.size, of_b.size));
}

/// The same numbers; of convex shapes and planes.
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

/// The rotation is made unit to double's precision, so that a long lever keeps its length.
template <class S>
Pose<double> in_double(const Pose<S>& pose) {
  Pose<double> wide = pose.template cast<double>();
  wide.rotation.normalize();
  return wide;
}

}  // namespace contactscope
