#include "query/sat_penetration.h"

#include "query/capsule_sat.h"
#include "query/closest_points.h"
#include "query/epa.h"
#include "query/sat.h"
#include "query/tolerance.h"

namespace contactscope {
namespace {

/// `deepest` is a point of B, or of A.
template <class S>
PenetrationResult<S> axis_result(S separation, const Vec3<S>& normal, const Vec3<S>& deepest,
                                 bool is_of_b) {
  PenetrationResult<S> result;
  result.status = PenetrationStatus::Converged;
  result.depth = result.least_depth = std::max(-separation, S(0));
  result.normal = normal;
  const Vec3<S> way = result.depth * normal;
  result.on_a = is_of_b ? Vec3<S>(deepest + way) : deepest;
  result.on_b = is_of_b ? deepest : Vec3<S>(deepest - way);
  result.iterations = 1;
  return result;
}

template <class S>
PenetrationResult<S> separated_along(const Vec3<S>& normal) {
  PenetrationResult<S> result;
  result.status = PenetrationStatus::Separated;
  result.normal = normal;
  result.iterations = 1;
  return result;
}

template <class S>
PenetrationResult<S> of_hulls(const Hull<S>& a, const Hull<S>& b, const Pose<S>& b_in_a) {
  const HullPair<S> pair(a, b, b_in_a);
  const SatResult<S> axes = sat(pair, tie_tolerance(pair.scale), Preference::None);
  switch (axes.chosen) {
    case AxisKind::FaceA: {
      const Vec3<S> normal = pair.a.normals[axes.face_a.face];
      if (axes.status == SatStatus::Separated) return separated_along(normal);
      return axis_result(axes.face_a.separation, normal, pair.b.vertex(axes.face_a.support), true);
    }
    case AxisKind::FaceB: {
      const Vec3<S> normal = -pair.b.normals[axes.face_b.face];
      if (axes.status == SatStatus::Separated) return separated_along(normal);
      return axis_result(axes.face_b.separation, normal, pair.a.vertex(axes.face_b.support), false);
    }
    default:
      break;
  }
  const EdgeQuery<S>& edge = axes.edge;
  if (axes.status == SatStatus::Separated) return separated_along(edge.normal);
  PenetrationResult<S> result =
      axis_result(edge.separation, edge.normal, pair.b.origin(edge.edge_b), true);
  const ClosestOfSegments<S> closest =
      closest_of_segments(pair.a.origin(edge.edge_a), pair.a.origin(Hull<S>::twin(edge.edge_a)),
                          pair.b.origin(edge.edge_b), pair.b.origin(Hull<S>::twin(edge.edge_b)));
  result.on_a = closest.on_a;
  result.on_b = closest.on_b;
  return result;
}

/// `core` is a point or a segment in the hull's frame; normal from the hull to the core. Told as if
/// the hull were A.
template <class S>
PenetrationResult<S> of_hull_and_segment(const Hull<S>& hull, const Vec3<S> (&ends)[2]) {
  const S scale = hull.centroid.norm() + hull.radius + std::max(ends[0].norm(), ends[1].norm());
  const S tie = tie_tolerance(scale);
  const CapsuleSat<S> axes = capsule_sat(hull, ends, tie, tie);
  const Vec3<S> normal =
      axes.edge_wins() ? axes.edge_normal : hull.planes[static_cast<std::size_t>(axes.face)].normal;
  if (axes.separation() > tie) return separated_along(normal);
  const int lower = normal.dot(ends[1]) < normal.dot(ends[0]) ? 1 : 0;
  PenetrationResult<S> result = axis_result(axes.separation(), normal, ends[lower], true);
  if (axes.edge_wins()) {
    const ClosestOfSegments<S> closest =
        closest_of_segments(hull.origin(axes.edge), hull.target(axes.edge), ends[0], ends[1]);
    result.on_a = closest.on_a;
    result.on_b = closest.on_b;
  }
  return result;
}

template <class S>
bool is_finite(const SupportSet<S>& set) {
  for (int i = 0; i < set.count; ++i) {
    if (!set.points[i].allFinite()) return false;
  }
  return true;
}

}  // namespace

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
    PenetrationResult<S> told = of_hull_and_segment(*b.hull, ends);
    std::swap(told.on_a, told.on_b);
    told.on_a = b_in_a.transform(told.on_a);
    told.on_b = b_in_a.transform(told.on_b);
    told.normal = -b_in_a.rotate(told.normal);
    return told;
  }
  return epa<S>(a, b, b_in_a, {}, nullptr, nullptr);
}

template PenetrationResult<float> sat_penetration(const SupportSet<float>&,
                                                  const SupportSet<float>&, const Pose<float>&);
template PenetrationResult<double> sat_penetration(const SupportSet<double>&,
                                                   const SupportSet<double>&, const Pose<double>&);

}  // namespace contactscope
