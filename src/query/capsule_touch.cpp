#include "query/capsule_touch.h"

#include <algorithm>

#include "core/at.h"
#include "query/closest_points.h"
#include "query/tolerance.h"

namespace contactscope {
namespace {

template <class S>
CapsuleTouch<S> face_touch(const Hull<S>& hull, const Vec3<S> (&ends)[2], int face, S scale) {
  const Plane<S>& plane = at(hull.planes, face);
  const S at_start = plane.distance(ends[0]);
  const S at_end = plane.distance(ends[1]);
  return {.feature = {FeatureKind::Face, face},
          .parameter = at_end < at_start ? S(1) : S(0),
          .distance = std::min(at_start, at_end),
          .normal = plane.normal,
          .clipped = clip_to_prism(hull, face, ends, clip_thickness(scale))};
}

/// True if the deepest point is over the face, and not only over its plane. Takes that point from
/// the clipped segment. If the segment is parallel within rounding, it can be the other end.
template <class S>
bool settle_on_face(const Hull<S>& hull, const Vec3<S> (&ends)[2], S tie, CapsuleTouch<S>& touch) {
  if (touch.clipped.empty()) return false;
  const Plane<S>& plane = at(hull.planes, touch.feature.index);
  const Vec3<S> along = ends[1] - ends[0];
  const auto& [start, end] = touch.clipped.parameters;
  if (touch.parameter == start || touch.parameter == end) return true;
  for (const S parameter : touch.clipped.parameters) {
    if (plane.distance(Vec3<S>(ends[0] + parameter * along)) <= touch.distance + tie) {
      touch.parameter = parameter;
      return true;
    }
  }
  return false;
}

/// Component of `offset` perpendicular to `along`.
template <class S>
Vec3<S> across(const Vec3<S>& offset, const Vec3<S>& along) {
  return offset - (offset.dot(along) / along.squaredNorm()) * along;
}

/// Vector from the closest point of the feature to that of the segment. If one of them is a vertex
/// or an end, computed from the nearer end of the other, so that rounding is relative to the
/// distance and not to the coordinates.
template <class S>
Vec3<S> outward(const Hull<S>& hull, const Vec3<S> (&ends)[2], HullFeature& feature, S& parameter) {
  const Vec3<S> along = ends[1] - ends[0];
  if (feature.kind == FeatureKind::Edge) {
    const Vec3<S>& origin = hull.origin(feature.index);
    const Vec3<S>& target = hull.target(feature.index);
    const ClosestOfSegments<S> closest = closest_of_segments(ends[0], ends[1], origin, target);
    parameter = closest.parameter_a;
    const bool at_end = parameter <= S(0) || parameter >= S(1);
    if (closest.parameter_b > S(0) && closest.parameter_b < S(1)) {
      if (!at_end) return closest.on_a - closest.on_b;
      const Vec3<S>& from = closest.parameter_b <= S(0.5) ? origin : target;
      return across(Vec3<S>(ends[parameter > S(0) ? 1 : 0] - from), Vec3<S>(target - origin));
    }
    const int leaving = closest.parameter_b > S(0) ? Hull<S>::twin(feature.index) : feature.index;
    feature = {FeatureKind::Vertex, at(hull.half_edges, leaving).origin};
  }
  const Vec3<S>& vertex = at(hull.vertices, feature.index);
  parameter = closest_on_segment(vertex, ends[0], ends[1]).parameter;
  if (parameter <= S(0)) return ends[0] - vertex;
  if (parameter >= S(1)) return ends[1] - vertex;
  return across(Vec3<S>(ends[parameter <= S(0.5) ? 0 : 1] - vertex), along);
}

/// Closest points that are neither over a face nor at the crossing of two edges. `best` is the
/// touch of the best axis. It provides the normal if the points coincide.
template <class S>
CapsuleTouch<S> closest_touch(const Hull<S>& hull, const Vec3<S> (&ends)[2],
                              const CapsuleTouch<S>& best, S scale, S touching, GjkRun<S>* run) {
  // Starting at the edge or the face of the best axis, GJK needs a step or two.
  const int near_end = best.parameter > S(0.5) ? 1 : 0;
  const int near_edge = best.feature.kind == FeatureKind::Edge
                            ? best.feature.index
                            : nearest_outside_edge(hull, best.feature.index, ends[near_end]);
  const GjkSimplex<S> start = simplex_near(hull, near_edge, near_end);
  const GjkResult<S> closest = gjk(support_set(ends), support_set(hull), Pose<S>{}, &start, run);
  CapsuleTouch<S> touch{.kind = CapsuleTouchKind::Closest,
                        .feature = feature_of_b(hull, closest.simplex),
                        .distance = closest.distance,
                        .normal = -closest.normal};
  const S tie = tie_tolerance(scale);
  if (touch.feature.kind == FeatureKind::Face) {
    if (touch.feature.index >= 0) {
      CapsuleTouch<S> face = face_touch(hull, ends, touch.feature.index, scale);
      if (settle_on_face(hull, ends, tie, face)) return face;
    } else {
      touch.feature = best.feature;
    }
    touch.parameter = closest_on_segment(closest.on_b, ends[0], ends[1]).parameter;
  } else {
    const Vec3<S> displacement = outward(hull, ends, touch.feature, touch.parameter);
    touch.distance = displacement.norm();
    if (touch.distance > touching) touch.normal = displacement / touch.distance;
  }
  if (closest.status == GjkStatus::Separated && touch.distance > touching) return touch;
  touch.normal = best.normal;
  touch.distance = best.distance;
  touch.degenerate = "segment touches an edge or a vertex";
  return touch;
}

}  // namespace

/// The talk uses GJK first and the separating axis test if it fails. We test axes first: if a face,
/// or an edge and the segment, are closest, their axis has the exact distance, and the same code
/// computes it on both sides of the surface. So the contact cannot jump as the segment sinks in,
/// and its normal has all digits at the surface, where the vector between two closest points has
/// none. GJK remains for vertices, and for ends next to edges.
///
/// Steps: 1. if a face is best: it is closest if the lowest part of the segment projects into it;
/// 2. if an edge pair is best: it is closest if the closest points of the two edges are inside both
/// (their distance is no test, as it is second order in the points); 3. in overlap one of these
/// holds up to rounding: the nearest boundary point of a convex body (here the Minkowski
/// difference) lies on one of its faces; 4. outside, use GJK.
template <class S>
CapsuleTouch<S> capsule_touch(const Hull<S>& hull, const Vec3<S> (&ends)[2],
                              const CapsuleSat<S>& axes, S scale, S touching, GjkRun<S>* run) {
  const S tie = tie_tolerance(scale);
  const bool is_deep = axes.separation() < -touching;
  if (axes.edge_wins()) {
    const ClosestOfSegments<S> closest =
        closest_of_segments(ends[0], ends[1], hull.origin(axes.edge), hull.target(axes.edge));
    CapsuleTouch<S> touch{.kind = CapsuleTouchKind::EdgePair,
                          .feature = {FeatureKind::Edge, axes.edge},
                          .parameter = closest.parameter_a,
                          .distance = axes.edge_separation,
                          .normal = axes.edge_normal};
    const bool cross = closest.parameter_a > S(0) && closest.parameter_a < S(1) &&
                       closest.parameter_b > S(0) && closest.parameter_b < S(1);
    if (cross && touch.distance > touching && closest.distance > touch.distance + tie) {
      // Separated, no axis has more than the distance, but this axis has less: the cross product of
      // nearly parallel edges is rounded by epsilon over their sine. The error of the points along
      // the edges hardly changes their distance.
      touch.distance = closest.distance;
      touch.normal = (closest.on_a - closest.on_b) / closest.distance;
    }
    if (cross || is_deep) return touch;
    return closest_touch(hull, ends, touch, scale, touching, run);
  }
  CapsuleTouch<S> touch = face_touch(hull, ends, axes.face, scale);
  const bool is_over_face = settle_on_face(hull, ends, tie, touch);
  if (!is_over_face) {
    if (!is_deep) return closest_touch(hull, ends, touch, scale, touching, run);
    // Rounding at the face's border clipped the deepest end. Restore it, for the depth.
    auto& [parameters, edges] = touch.clipped;
    const int end = touch.parameter > S(0) ? 1 : 0;
    if (touch.clipped.empty()) parameters[0] = parameters[1] = touch.parameter;
    parameters[end] = touch.parameter;
    edges[end] = -1;
  }
  if (axes.face_tied && touch.distance <= touching) {
    touch.degenerate = "segment as near to several faces";
  }
  return touch;
}

template decltype(capsule_touch<float>) capsule_touch<float>;
template decltype(capsule_touch<double>) capsule_touch<double>;

}  // namespace contactscope
