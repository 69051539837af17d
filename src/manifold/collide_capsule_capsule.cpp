#include "manifold/collide_pairs.h"
#include "manifold/round_contact.h"
#include "query/closest_points.h"
#include "query/tolerance.h"

namespace contactscope {
namespace {

/// Two axes are nearly parallel if they diverge, over their common stretch, by no more than this
/// times the sum of the radii. Two points then represent a contact as long as the stretch. If the
/// axes cross in its middle, the surfaces at its ends are farther from each other than in the
/// middle by at most 0.05^2 / 2 of the radii, which is below any slop.
template <class S> inline constexpr S kNearlyParallel = S(0.1);

/// Two points closer than this times the sum of the radii are merged.
template <class S> inline constexpr S kShortStretch = S(0.01);

/// An axis in A's frame, metres.
template <class S> struct Axis {
  Vec3<S> points[2];
  Vec3<S> along;  // from the first to the second
  S length;

  bool has_length() const { return length > S(0); }
  Vec3<S> unit() const { return along / length; }
};

template <class S> Axis<S> axis_in_own_frame(const Capsule<S>& capsule) {
  const Vec3<S> along = capsule.points[1] - capsule.points[0];
  return {{capsule.points[0], capsule.points[1]}, along, along.norm()};
}

/// Rotates the direction separately: it does not lose the digits that the ends lose far from A.
template <class S> Axis<S> placed(const Axis<S>& axis, const Pose<S>& pose) {
  return {{pose.transform(axis.points[0]), pose.transform(axis.points[1])},
          pose.rotate(axis.along),
          axis.length};
}

/// The common stretch of the two axes, along A's.
template <class S> struct Stretch {
  S from_b = 0, to_b = 0;  // B's ends along A's axis, metres from A's first
  S length = 0;            // negative if they do not overlap
  /// Limit for the angle between nearly parallel axes.
  S largest_sine = kNearlyParallel<S>;
};

/// Two axes and their relative position.
template <class S> struct AxisPair {
  AxisPair(const Axis<S>& one, const Axis<S>& other, S sum_of_radii)
      : a(one), b(other), radii(sum_of_radii), cross(a.along.cross(b.along)), sine(0) {
    const S lengths = a.length * b.length;
    if (lengths > S(0)) sine = cross.norm() / lengths;
  }

  Stretch<S> stretch() const {
    if (!a.has_length() || !b.has_length()) return {};
    const Vec3<S> unit = a.unit();
    const S first = unit.dot(b.points[0] - a.points[0]);
    const S second = unit.dot(b.points[1] - a.points[0]);
    Stretch<S> result;
    result.from_b = std::min(first, second);
    result.to_b = std::max(first, second);
    result.length = std::min(result.to_b, a.length) - std::max(result.from_b, S(0));
    // Rounding must not decide for axes placed in parallel.
    result.largest_sine = std::max(kNearlyParallel<S> * radii / std::max(result.length, radii),
                                   S(2) * kParallelSine<S>);
    return result;
  }
  S scale() const {
    const auto largest = [](const Axis<S>& axis) {
      return axis.points[0].cwiseAbs().cwiseMax(axis.points[1].cwiseAbs()).maxCoeff();
    };
    return std::max(largest(a), largest(b));
  }

  const Axis<S>&a, &b;
  S radii;
  Vec3<S> cross;  // A's by B's, square metres
  S sine;         // of the angle between them; 0 if one has no length
};

/// Removes the parts along the axes. For the cross product of nearly parallel axes they are
/// rounding divided by the sine, and would appear as depth at the ends of the axes.
template <class S> Vec3<S> perpendicular_to(const AxisPair<S>& axes, const Vec3<S>& direction) {
  const Vec3<S> to_a = axes.a.has_length() ? rejected(direction, axes.a.unit()) : direction;
  return safe_unit(axes.b.has_length() ? rejected(to_a, axes.b.unit()) : to_a);
}

/// From A to B by the closest points. Inside an axis the normal is perpendicular to it. It is made
/// so, since rounding divided by the distance would show at the end of a long axis. Where lines
/// cross, their cross product is the same directionand less rounded.
template <class S>
Vec3<S> normal_between(const AxisPair<S>& axes, const ClosestOfSegments<S>& closest) {
  Vec3<S> between = closest.on_b - closest.on_a;
  const auto is_inside = [](const Axis<S>& axis, S parameter) {
    return axis.has_length() && S(0) < parameter && parameter < S(1);
  };
  // Rounding may select an end although a point up to the square root of that rounding away is
  // nearer. The axis then leans towards the other shape, in direction `towards`.
  const auto leans_from_end = [](const Axis<S>& axis, S parameter, const Vec3<S>& towards) {
    if (!axis.has_length()) return false;
    const S offset = towards.dot(axis.along);
    return (parameter == S(0) && offset > S(0)) || (parameter == S(1) && offset < S(0));
  };
  const bool inside_a = is_inside(axes.a, closest.parameter_a);
  const bool inside_b = is_inside(axes.b, closest.parameter_b);
  if (inside_a && inside_b &&
      closest.distance < axes.sine * std::min(axes.a.length, axes.b.length)) {
    const Vec3<S> normal = perpendicular_to(axes, Vec3<S>(axes.cross.normalized()));
    return normal.dot(between) < S(0) ? Vec3<S>(-normal) : normal;
  }
  if (inside_a || leans_from_end(axes.a, closest.parameter_a, between))
    between = rejected(between, axes.a.unit());
  if (inside_b || leans_from_end(axes.b, closest.parameter_b, Vec3<S>(-between)))
    between = rejected(between, axes.b.unit());
  return between.normalized();
}

template <class S> const char* degenerate_name(const AxisPair<S>& axes, const Stretch<S>& stretch) {
  if (!axes.a.has_length() && !axes.b.has_length()) return "coincident centres";
  if (!axes.a.has_length() || !axes.b.has_length()) return "centre on the axis";
  return axes.sine < stretch.largest_sine ? "overlapping axes" : "crossing axes";
}

/// Up to this sine the direction of the axes' cross product is not trusted. A direction that leans
/// along an axis by no more is still perpendicular to it within rounding.
template <class S> inline constexpr S kUnsureSine = S(4) * kParallelSine<S>;

/// For axes that meet: their cross product, as for slightly separated axes; no other direction is
/// perpendicular to both. For parallel axes it is only rounding, so a direction fixed to a body is
/// used. In between, the normal turns from one to the other.
template <class S>
Vec3<S> fallback_normal(const AxisPair<S>& axes, const Capsule<S>& a, const Capsule<S>& b,
                        const Pose<S>& b_in_a) {
  if (!axes.b.has_length() && axes.a.has_length())
    return body_perpendicular(Vec3<S>(a.points[1] - a.points[0]));
  const Vec3<S> fixed = b_in_a.rotate(body_perpendicular(Vec3<S>(b.points[1] - b.points[0])));
  const S sure = std::clamp(axes.sine - kParallelSine<S>, S(0), kUnsureSine<S>);
  const S unsure = std::max(S(0), kUnsureSine<S> - axes.sine);
  const Vec3<S> across = sure * safe_unit(axes.cross);
  const Vec3<S> cross = across.dot(fixed) < S(0) ? Vec3<S>(-across) : across;
  return perpendicular_to(axes, safe_unit(Vec3<S>(cross + unsure * fixed)));
}

/// The facing points of both axes at A's end `side` of the stretch: the end of B's axis if it is
/// within A's stretch, otherwise A's end, each with the closest point of the other axis.
template <class S>
std::pair<Vec3<S>, Vec3<S>> facing_at(const AxisPair<S>& axes, const Stretch<S>& stretch, int side,
                                      int end_of_b) {
  const bool b_ends = side == 0 ? stretch.from_b > S(0) : stretch.to_b < axes.a.length;
  if (b_ends) {
    const Vec3<S>& end = axes.b.points[end_of_b];
    return {closest_on_segment(end, axes.a.points[0], axes.a.points[1]).point, end};
  }
  const Vec3<S>& end = axes.a.points[side];
  return {end, closest_on_segment(end, axes.b.points[0], axes.b.points[1]).point};
}

/// Adds points only if the axes are nearly parallel and overlap for long enough.
template <class S>
void add_two_points(const AxisPair<S>& axes, S radius_a, S radius_b, S margin,
                    Contact<S>& contact) {
  if (axes.sine > kNearlyParallel<S>) return;
  const Stretch<S> stretch = axes.stretch();
  if (stretch.length <= kShortStretch<S> * axes.radii || axes.sine > stretch.largest_sine) return;
  const bool same_direction = axes.a.along.dot(axes.b.along) > S(0);
  for (int side = 0; side < 2; ++side) {
    const int end_of_b = same_direction ? side : 1 - side;
    const auto [on_a, on_b] = facing_at(axes, stretch, side, end_of_b);
    const S distance = contact.normal.dot(on_b - on_a);
    if (distance - axes.radii > margin) continue;
    const FeatureId id = FeatureId::of(vertex_ref(Owner::A, side), vertex_ref(Owner::B, end_of_b));
    add_round_point(on_a, radius_a, on_b, radius_b, contact.normal, distance, id, contact);
  }
  if (contact.points.size() == 2) contact.type = ContactType::EdgeEdge;
}

}  // namespace

/// Two deviations from the talk, which clips the second axis against planes at the ends of the
/// first: we take the closest point of either axis to the other's end, so that the depth does not
/// jump when one point becomes two; and we measure along the common normal, as for the separation,
/// instead of keeping points near the first axis. Steps: 1. closest points of the axes; 2. their
/// direction is the normal, unless they meet; 3. two points if the axes are nearly parallel and
/// overlap far enough; 4. otherwise, or if both are above the margin, the closest points.
template <class S>
S collide_capsule_capsule(const Capsule<S>& a, const Capsule<S>& b, const Pose<S>& b_in_a,
                          const CollideOptions& options, Contact<S>& contact,
                          Recorder<S>* recorder) {
  const Axis<S> axis_a = axis_in_own_frame(a);
  const Axis<S> axis_b = placed(axis_in_own_frame(b), b_in_a);
  const ClosestOfSegments<S> closest =
      closest_of_segments(axis_a.points[0], axis_a.points[1], axis_b.points[0], axis_b.points[1]);
  const S separation = closest.distance - (a.radius + b.radius);
  if (separation > options.margin) return separation;

  const AxisPair<S> axes(axis_a, axis_b, a.radius + b.radius);
  if (closest.distance > clip_thickness(axes.scale())) {
    contact.normal = normal_between(axes, closest);
  } else {
    const char* const geometry = recorder ? degenerate_name(axes, axes.stretch()) : nullptr;
    if (skips_degenerate(geometry, options, recorder)) return separation;
    contact.normal = fallback_normal(axes, a, b, b_in_a);
  }
  const FeatureRef feature_a = axis_feature(Owner::A, closest.parameter_a, axis_a.has_length());
  const FeatureRef feature_b = axis_feature(Owner::B, closest.parameter_b, axis_b.has_length());
  contact.axis = AxisKind::ClosestPoints;
  contact.type = contact_type(feature_a.kind, feature_b.kind);
  add_two_points(axes, a.radius, b.radius, static_cast<S>(options.margin), contact);
  if (contact.points.empty())
    add_round_point(closest.on_a, a.radius, closest.on_b, b.radius, contact.normal,
                    closest.distance, FeatureId::of(feature_a, feature_b), contact);
  return separation;
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(collide_capsule_capsule);

}  // namespace contactscope
