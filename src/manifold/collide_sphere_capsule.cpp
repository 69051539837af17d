#include <cmath>
#include <limits>

#include "manifold/collide_pairs.h"
#include "manifold/round_contact.h"
#include "query/closest_points.h"

namespace contactscope {
namespace {

/// How far rounding can move the centre off the axis, metres: the centre was turned into the
/// capsule's frame, and points on an axis that is oblique there are rounded across it.
template <class S>
S rounding_across(const Vec3<S>& center, const Capsule<S>& capsule) {
  const Vec3<S> along = capsule.points[1] - capsule.points[0];
  const Vec3<S> unit = safe_unit(along);
  const Vec3<S> squares = unit.cwiseAbs2();
  const S obliqueness = std::sqrt(squares.dot(Vec3<S>(Vec3<S>::Ones() - squares)));
  constexpr S kRoundings = S(8) * std::numeric_limits<S>::epsilon();
  return kRoundings * (safe_norm(center) + obliqueness * safe_norm(along));
}

}  // namespace

/// Works in the capsule's own frame, where its axis is exact even if it is much longer than the
/// distance. Steps: 1. the vector to the closest point of the axis; 2. its direction is the normal,
/// unless it is only rounding.
template <class S>
S collide_sphere_capsule(const Sphere<S>& a, const Capsule<S>& b, const Pose<S>& b_in_a,
                         const CollideOptions& options, Contact<S>& contact,
                         Recorder<S>* recorder) {
  const Vec3<S> center = b_in_a.inverse_transform(Vec3<S>::Zero());
  const Vec3<S> along = b.points[1] - b.points[0];
  const Vec3<S> unit = safe_unit(along);
  const ClosestOnSegment<S> closest = closest_on_segment(center, b.points[0], b.points[1]);
  const FeatureRef feature = axis_feature(Owner::B, closest.parameter, !unit.isZero(S(0)));
  Vec3<S> to_axis = closest.point - center;
  // On a long axis the point is rounded by more than the distance of a near centre.
  if (feature.kind != FeatureKind::Vertex) to_axis = rejected(to_axis, unit);
  const S distance = safe_norm(to_axis);
  const S separation = distance - (a.radius + b.radius);
  if (separation > options.margin) return separation;

  if (distance > rounding_across(center, b)) {
    contact.normal = b_in_a.rotate(safe_unit(to_axis));
  } else {
    const char* geometry = along.isZero(S(0)) ? "coincident centres" : "centre on the axis";
    if (skips_degenerate(geometry, options, recorder)) return separation;
    contact.normal = b_in_a.rotate(body_perpendicular(along));
  }
  contact.axis = AxisKind::ClosestPoints;
  contact.type = contact_type(FeatureKind::Vertex, feature.kind);
  const FeatureId id = FeatureId::of(vertex_ref(Owner::A, 0), feature);
  add_round_point(Vec3<S>(Vec3<S>::Zero()), a.radius, b_in_a.rotate(to_axis), b.radius,
                  contact.normal, distance, id, contact);
  return separation;
}

template CollideConvex<float, Sphere<float>, Capsule<float>> collide_sphere_capsule;
template CollideConvex<double, Sphere<double>, Capsule<double>> collide_sphere_capsule;

}  // namespace contactscope
