#include "manifold/in_double.h"

#include <algorithm>
#include <cassert>

#include "query/tolerance.h"

namespace contactscope {
namespace {

/// Metres.
struct Lengths {
  float reach = 0;  // of any point, from the shape's middle or its origin
  float size = 0;   // radius
};

Lengths lengths_of(const Shape<float>& shape) {
  if (const auto* hull = std::get_if<Hull<float>>(&shape)) return {hull->radius, hull->radius};
  if (const auto* sphere = std::get_if<Sphere<float>>(&shape))
    return {sphere->radius, sphere->radius};
  const auto& [points, radius] = *std::get_if<Capsule<float>>(&shape);
  return {points[0].cwiseAbs().cwiseMax(points[1].cwiseAbs()).maxCoeff() + radius, radius};
}

/// nullptr where there is none of the same name.
Reducer<double> reducer_in_double(Reducer<float> reducer) {
  for (const ReducerInfo& info : reducers())
    if (info.in_float == reducer) return info.in_double;
  return nullptr;
}

}  // namespace

bool belongs_in_double(const Shape<float>& a, const Shape<float>& b, Reducer<float> reducer) {
  if (kind_of(a) > ShapeKind::Hull || kind_of(b) > ShapeKind::Hull) return false;
  const Lengths of_a = lengths_of(a);
  const Lengths of_b = lengths_of(b);
  const float rounding = tie_tolerance(std::max(of_a.reach, of_b.reach));
  if (rounding <= preference_tolerance(0.0F, std::min(of_a.size, of_b.size))) return false;
  return reducer == nullptr || reducer_in_double(reducer) != nullptr;
}

Shape<double> in_double(const Shape<float>& shape) {
  if (const auto* sphere = std::get_if<Sphere<float>>(&shape))
    return Sphere<double>{sphere->radius};
  if (const auto* capsule = std::get_if<Capsule<float>>(&shape))
    return Capsule<double>{{capsule->points[0].cast<double>(), capsule->points[1].cast<double>()},
                           capsule->radius};
  assert(kind_of(shape) == ShapeKind::Hull);
  return hull_cast<double>(*std::get_if<Hull<float>>(&shape));
}

Pose<double> in_double(const Pose<float>& pose) {
  Pose<double> wide = pose.cast<double>();
  wide.rotation.normalize();
  return wide;
}

CollideOptions<double> in_double(const CollideOptions<float>& options) {
  CollideOptions<double> wide;
  wide.margin = options.margin;
  wide.preference = options.preference;
  wide.degenerate = options.degenerate;
  wide.internal_edges = options.internal_edges;
  wide.penetration = options.penetration;
  wide.reducer = options.reducer == nullptr ? nullptr : reducer_in_double(options.reducer);
  wide.reduction = options.reduction;
  return wide;
}

Manifold<float> in_float(const Manifold<double>& manifold) {
  Manifold<float> result;
  result.normal = manifold.normal.cast<float>();
  result.axis = manifold.axis;
  result.type = manifold.type;
  result.triangle = manifold.triangle;
  for (const ContactPoint<double>& point : manifold.points) {
    result.points.push_back(
        {point.position.cast<float>(), static_cast<float>(point.separation), point.id});
  }
  return result;
}

}  // namespace contactscope
