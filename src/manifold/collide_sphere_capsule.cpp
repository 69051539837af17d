#include <cmath>
#include <limits>

#include "manifold/collide_pairs.h"
#include "manifold/round_contact.h"
#include "query/closest_points.h"

namespace contactscope {
namespace {

/// From the centre to the closest point of the axis, in the capsule's frame.
template <class S>
struct ToAxis {
  Vec3<S> vector;
  FeatureRef feature;  // of the capsule
};

template <class S>
ToAxis<S> to_axis(const Vec3<S>& center, const Capsule<S>& capsule) {
  const ClosestOnSegment<S> closest =
      closest_on_segment(center, capsule.points[0], capsule.points[1]);
  const Vec3<S> vector = closest.point - center;
  const Vec3<S> unit = safe_unit(Vec3<S>(capsule.points[1] - capsule.points[0]));
  const FeatureRef feature = axis_feature(Owner::B, closest.parameter, !unit.isZero(S(0)));
  if (feature.kind == FeatureKind::Vertex) return {vector, feature};
  // The place along a long axis is rounded by more than a near centre is away from it.
  return {rejected(vector, unit), feature};
}

/// How far rounding can move the centre off the axis, metres: the centre has been turned into the
/// capsule's frame, and a point on an axis that is oblique there has been rounded across it.
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

/// Works in the capsule's own frame: there its axis is as exact as it was given, also one that is
/// very much longer than the distance. Steps: 1. the vector to the closest point of the axis; 2. its
/// direction is the normal, unless it is rounding alone.
template <class S>
S collide_sphere_capsule(const Sphere<S>& a, const Capsule<S>& b, const Pose<S>& b_in_a,
                         const CollideOptions<S>& options, Contact<S>& contact,
                         Recorder<S>* recorder) {
  const Vec3<S> center = b_in_a.inverse_transform(Vec3<S>::Zero());
  const ToAxis<S> to_axis = contactscope::to_axis(center, b);
  const S distance = safe_norm(to_axis.vector);
  const S separation = distance - (a.radius + b.radius);
  if (separation > options.margin) return separation;

  if (distance > rounding_across(center, b)) {
    contact.normal = b_in_a.rotate(safe_unit(to_axis.vector));
  } else {
    const Vec3<S> along = b.points[1] - b.points[0];
    const char* geometry = along.isZero(S(0)) ? "coincident centres" : "centre on the axis";
    if (skips_degenerate(geometry, options, recorder)) return separation;
    contact.normal = b_in_a.rotate(body_perpendicular(along));
  }
  contact.axis = AxisKind::ClosestPoints;
  contact.type = contact_type(FeatureKind::Vertex, to_axis.feature.kind);
  const FeatureId id = FeatureId::of(vertex_ref(Owner::A, 0), to_axis.feature);
  add_round_point(Vec3<S>(Vec3<S>::Zero()), a.radius, b_in_a.rotate(to_axis.vector), b.radius,
                  contact.normal, distance, id, contact);
  return separation;
}

template CollideConvex<float, Sphere<float>, Capsule<float>> collide_sphere_capsule;
template CollideConvex<double, Sphere<double>, Capsule<double>> collide_sphere_capsule;

}  // namespace contactscope
