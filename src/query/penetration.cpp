#include "query/penetration.h"

#include "query/capsule_sat.h"
#include "query/closest_points.h"
#include "query/penetration_bounds.h"
#include "query/sat.h"

namespace contactscope {
namespace {

/// `deepest` is a point of B if `is_of_b`, otherwise of A.
template <class S>
PenetrationResult<S> axis_result(S separation, const Vec3<S>& normal, const Vec3<S>& deepest,
                                 bool is_of_b) {
  const S depth = std::max(-separation, S(0));
  const Vec3<S> offset = depth * normal;
  return {.status = PenetrationStatus::Converged,
          .depth = depth,
          .least_depth = depth,
          .normal = normal,
          .on_a = is_of_b ? Vec3<S>(deepest + offset) : deepest,
          .on_b = is_of_b ? deepest : Vec3<S>(deepest - offset),
          .iterations = 1};
}

/// Where edges cross, A's p q and B's r s, their closest points are the shapes' deepest.
template <class S>
PenetrationResult<S> edge_result(S separation, const Vec3<S>& normal, const Vec3<S>& p,
                                 const Vec3<S>& q, const Vec3<S>& r, const Vec3<S>& s) {
  PenetrationResult<S> result = axis_result(separation, normal, r, true);
  const ClosestOfSegments<S> closest = closest_of_segments(p, q, r, s);
  result.on_a = closest.on_a;
  result.on_b = closest.on_b;
  return result;
}

template <class S> PenetrationResult<S> separated_along(const Vec3<S>& normal) {
  return {.status = PenetrationStatus::Separated, .normal = normal, .iterations = 1};
}

template <class S>
PenetrationResult<S> of_hulls(const Hull<S>& a, const Hull<S>& b, const Pose<S>& b_in_a) {
  const HullPair<S> pair(a, b, b_in_a);
  const SatResult<S> axes = sat(pair, tie_tolerance(pair.scale), Preference::None);
  const bool is_separated = axes.status == SatStatus::Separated;
  if (axes.chosen == AxisKind::EdgeEdge) {
    const auto [edge_a, edge_b, separation, normal] = axes.edge;
    if (is_separated) return separated_along(normal);
    return edge_result(separation, normal, pair.a.origin(edge_a),
                       pair.a.origin(Hull<S>::twin(edge_a)), pair.b.origin(edge_b),
                       pair.b.origin(Hull<S>::twin(edge_b)));
  }
  const bool is_of_a = axes.chosen == AxisKind::FaceA;
  const FaceQuery<S>& best = is_of_a ? axes.face_a : axes.face_b;
  const Vec3<S> normal = is_of_a ? pair.a.normals[best.face] : Vec3<S>(-pair.b.normals[best.face]);
  if (is_separated) return separated_along(normal);
  const PlacedHull<S>& other = is_of_a ? pair.b : pair.a;
  return axis_result(best.separation, normal, other.vertex(best.support), is_of_a);
}

/// The core, a point or a segment, is in the hull's frame. The hull is A in the result.
template <class S>
PenetrationResult<S> of_hull_and_segment(const Hull<S>& hull, const Vec3<S> (&ends)[2]) {
  const S scale = hull.centroid.norm() + hull.radius + std::max(ends[0].norm(), ends[1].norm());
  const S tie = tie_tolerance(scale);
  const CapsuleSat<S> axes = capsule_sat(hull, ends, tie, tie);
  const Vec3<S> normal = axes.edge_wins() ? axes.edge_normal : at(hull.planes, axes.face).normal;
  if (axes.separation() > tie) return separated_along(normal);
  if (axes.edge_wins())
    return edge_result(axes.separation(), normal, hull.origin(axes.edge), hull.target(axes.edge),
                       ends[0], ends[1]);
  const int lower = normal.dot(ends[1]) < normal.dot(ends[0]) ? 1 : 0;
  return axis_result(axes.separation(), normal, ends[lower], true);
}

template <class S> bool is_finite(const SupportSet<S>& set) {
  return std::all_of(set.points, set.points + set.count,
                     [](const Vec3<S>& point) { return point.allFinite(); });
}

/// The exact reference for the other methods: sat() for two hulls, capsule_sat() for a hull and a
/// point or segment. Cores without volume give Flat, with a normal perpendicular to both.
template <class S>
PenetrationResult<S> sat_penetration(const SupportSet<S>& a, const SupportSet<S>& b,
                                     const Pose<S>& b_in_a) {
  const bool pose_is_finite = b_in_a.rotation.coeffs().allFinite() && b_in_a.position.allFinite();
  if (!pose_is_finite || !is_finite(a) || !is_finite(b)) return {};
  if (a.hull != nullptr && b.hull != nullptr) return of_hulls(*a.hull, *b.hull, b_in_a);
  if (a.hull != nullptr) {
    const Vec3<S> ends[2] = {b_in_a.transform(b.points[0]),
                             b_in_a.transform(b.points[b.count - 1])};
    return of_hull_and_segment(*a.hull, ends);
  }
  if (b.hull != nullptr) {
    const Vec3<S> ends[2] = {b_in_a.inverse_transform(a.points[0]),
                             b_in_a.inverse_transform(a.points[a.count - 1])};
    PenetrationResult<S> record = of_hull_and_segment(*b.hull, ends);
    std::swap(record.on_a, record.on_b);
    record.on_a = b_in_a.transform(record.on_a);
    record.on_b = b_in_a.transform(record.on_b);
    record.normal = -b_in_a.rotate(record.normal);
    return record;
  }
  return epa<S>(a, b, b_in_a, {}, nullptr, nullptr);
}

}  // namespace

const char* to_string(PenetrationStatus status) {
  constexpr const char* kNames[] = {"converged",         "flat",      "separated", "stalled",
                                    "out_of_iterations", "not_finite"};
  return kNames[static_cast<int>(status)];
}

template <class S>
bool may_overlap(const GjkResult<S>& gjk, const SupportSet<S>& a, const SupportSet<S>& b,
                 const Pose<S>& b_in_a) {
  if (gjk.status == GjkStatus::Touching || gjk.status == GjkStatus::Overlap) return true;
  return gjk.distance <=
         depth_rounding(S(2) * (reach_of(a) + reach_of(b) + b_in_a.position.norm()));
}

template <class S>
PenetrationResult<S> penetration(PenetrationMethod method, const SupportSet<S>& a,
                                 const SupportSet<S>& b, const Pose<S>& b_in_a,
                                 const PenetrationOptions<S>& options, const GjkSimplex<S>* overlap,
                                 PenetrationSteps<S>* steps) {
  using enum PenetrationMethod;
  if (method == Epa) return epa(a, b, b_in_a, options, overlap, steps);
  if (method == Mpr) return mpr(a, b, b_in_a, options, steps);
  if (method == Sampling) return sampling(a, b, b_in_a, options, steps);
  return sat_penetration(a, b, b_in_a);
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(may_overlap, penetration);

}  // namespace contactscope
