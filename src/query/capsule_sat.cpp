#include "query/capsule_sat.h"

#include "query/closest_points.h"
#include "query/fast/point_faces.h"
#include "query/tolerance.h"

namespace contactscope {
namespace {

/// Faces with a smaller sine of their angle are parallel: the normal is the same after a tie.
template <class S> constexpr S kSameDirection = S(0.05);

/// For every face: both ends' distances, the smaller one, and the segment's rise along the normal.
template <class S> struct FaceDistances {
  FaceDistances(const Hull<S>& hull, const Vec3<S> (&ends)[2])
      : at_start(padded(hull.face_count())),
        at_end(padded(hull.face_count())),
        lower(padded(hull.face_count())),
        rise(padded(hull.face_count())) {
    measure({hull.lanes.normals.data(), hull.face_count()}, hull.lanes.offsets.data(), ends,
            at_start.data(), at_end.data(), lower.data(), rise.data());
    largest = largest_in_lanes(lower.data(), padded(hull.face_count()));
  }

  static void measure(const VectorLanes<S>& normals, const S* __restrict offsets,
                      const Vec3<S> (&ends)[2], S* __restrict start, S* __restrict end,
                      S* __restrict lesser, S* __restrict rises) {
    const S* __restrict nx = normals.x();
    const S* __restrict ny = normals.y();
    const S* __restrict nz = normals.z();
    const int count = normals.padded_count();
    // Not the difference of the distances, whose digits cancel: the sign of the rise matters.
    const Vec3<S> along = ends[1] - ends[0];
    const S ax = ends[0].x(), ay = ends[0].y(), az = ends[0].z();
    const S bx = ends[1].x(), by = ends[1].y(), bz = ends[1].z();
    const S ux = along.x(), uy = along.y(), uz = along.z();
    for (int f = 0; f < count; ++f) {
      const S at_a = dot(nx[f], ny[f], nz[f], ax, ay, az) - offsets[f];
      const S at_b = dot(nx[f], ny[f], nz[f], bx, by, bz) - offsets[f];
      start[f] = at_a;
      end[f] = at_b;
      lesser[f] = at_b < at_a ? at_b : at_a;
      rises[f] = dot(nx[f], ny[f], nz[f], ux, uy, uz);
    }
  }

  Scratch<S, 128> at_start, at_end, lower, rise;
  S largest;
};

template <class S>
void best_face(const Hull<S>& hull, const Vec3<S> (&ends)[2], const FaceDistances<S>& distances,
               S tie, CapsuleSat<S>& result) {
  bool settled = false;
  result.face = -1;
  const S least = distances.largest - tie;
  for_each_not_below(distances.lower.data(), hull.face_count(), least, [&](int face) {
    if (result.face < 0) {
      result.face = face;
      return;
    }
    // A tie. Only now the position of the lower ends matters.
    const auto holds = [&](int candidate) {
      const int lower_end = distances.at_end[candidate] < distances.at_start[candidate] ? 1 : 0;
      return projects_into(hull, candidate, ends[lower_end], tie);
    };
    settled = settled || holds(result.face);
    if (!face_the_same_direction(hull, result.face, face, kSameDirection<S>))
      result.face_tied = true;
    if (!settled && holds(face)) {
      result.face = face;
      settled = true;
    }
  });
  result.face_separation = distances.lower[result.face];
}

/// Separation along a unit direction from the hull to the segment, computed with support points of
/// both. Valid for every direction: the distance is never less.
template <class S>
S support_separation(const Hull<S>& hull, const Vec3<S> (&ends)[2], const Vec3<S>& direction) {
  const Vec3<S>& vertex = at(hull.vertices, support_index(support_set(hull), direction));
  return std::min(direction.dot(Vec3<S>(ends[0] - vertex)),
                  direction.dot(Vec3<S>(ends[1] - vertex)));
}

/// Face marks. For the two faces of an edge, bits of their sum describe its arc. Bit 0: the segment
/// rises above exactly one face. Bit 5: its start is above `bound` for at least one, because of the
/// sums 3 + 3, 3 + 5 and 5 + 5 only the first lacks the bit 8. Bit 9: the same for its end.
constexpr int kNeither = 3 << 2 | 3 << 6;
constexpr int kRises = 1, kStartAbove = 2 << 2, kEndAbove = 2 << 6;
constexpr int kCrosses = 1 | 8 << 2 | 8 << 6;

template <class S>
void mark_faces(const FaceDistances<S>& distances, S bound, int count, int* __restrict marks) {
  const S* __restrict start = distances.at_start.data();
  const S* __restrict end = distances.at_end.data();
  const S* __restrict rise = distances.rise.data();
  for (int f = 0; f < count; ++f)
    marks[f] = kNeither + (rise[f] > S(0) ? kRises : 0) + (start[f] > bound ? kStartAbove : 0) +
               (end[f] > bound ? kEndAbove : 0);
}

/// Collects in `edges` those whose arcs cross the ring and reach above `bound` (metres, <= 0);
/// returns their number. Along an arc n(t) = (1 - t) n_f + t n_g the distance of an end of the
/// segment from the edge is linear in t; where it is negative, dividing by |n(t)| <= 1 only lowers
/// it. Computes all sums first, without branches: the crossing edges are unpredictable.
template <class S>
int crossing_edges(const Hull<S>& hull, const FaceDistances<S>& distances, S bound, int* edges) {
  Scratch<int, 128> marks(padded(hull.face_count()));
  mark_faces(distances, bound, padded(hull.face_count()), marks.data());
  const HalfEdge* half_edges = hull.half_edges.data();
  const int* mark = marks.data();
  const int edge_count = hull.edge_count();
  Scratch<int, 192> sums(padded(edge_count));
  int* sum = sums.data();
#pragma GCC unroll 4
  for (int edge = 0; edge < edge_count; ++edge)
    sum[edge] = mark[half_edges[2 * edge].face] + mark[half_edges[2 * edge + 1].face];
  int count = 0;
  for_each_with_bits(sum, edge_count, kCrosses, [&](int edge) { edges[count++] = 2 * edge; });
  return count;
}

/// For a positive bound: |n(t)| is smallest in the middle, the cosine of half the faces' angle.
template <class S>
bool arc_stays_below(const Hull<S>& hull, const FaceDistances<S>& distances, int f, int g,
                     S bound) {
  if (!(bound > S(0))) return false;
  const S cosine = at(hull.planes, f).normal.dot(at(hull.planes, g).normal);
  const S reach = std::min(std::max(distances.at_start[f], distances.at_start[g]),
                           std::max(distances.at_end[f], distances.at_end[g]));
  return reach <= S(0) || reach * reach <= bound * bound * (S(0.5) * (S(1) + cosine));
}

enum class Check { Last, Every };

/// Finds the best edge pair. An axis that is uncertain (nearly parallel edges) or would separate is
/// measured again with support points, as in query_edges: every one that would win, or only the
/// last. Returns false if the last one fails this check: then others may be better.
template <class S>
bool best_edge_pair(const Hull<S>& hull, const Vec3<S> (&ends)[2],
                    const FaceDistances<S>& distances, const int* edges, int count, S tie,
                    Check check, CapsuleSat<S>& result) {
  const Vec3<S> along = ends[1] - ends[0];
  const S squared_along = along.squaredNorm();
  S to_beat = result.face_separation + tie;
  bool is_uncertain = false;
  for (int i = 0; i < count; ++i) {
    const int edge = edges[i];
    const int f = at(hull.half_edges, edge).face;
    const int g = at(hull.half_edges, edge + 1).face;
    if (arc_stays_below(hull, distances, f, g, to_beat)) continue;
    const Vec3<S>& origin = hull.origin(edge);
    const Vec3<S> edge_along = hull.target(edge) - origin;
    const Vec3<S> cross =
        distances.rise[f] > S(0) ? edge_along.cross(along) : along.cross(edge_along);
    const S squared_sine = cross.squaredNorm();  // times both squared lengths
    const S squared_lengths = squared_along * edge_along.squaredNorm();
    if (!(squared_sine > kParallelSine<S> * kParallelSine<S> * squared_lengths)) continue;
    const Vec3<S> normal = cross / std::sqrt(squared_sine);
    S separation = normal.dot(Vec3<S>(ends[0] - origin));
    if (!(separation > to_beat)) continue;
    const bool is_noisy = squared_sine < kNoisySine<S> * kNoisySine<S> * squared_lengths;
    is_uncertain = is_noisy || separation > S(0);
    if (check == Check::Every && is_uncertain) {
      separation = support_separation(hull, ends, normal);
      if (!(separation > to_beat)) continue;
    }
    result.edge = edge;
    result.edge_separation = separation;
    result.edge_normal = normal;
    to_beat = separation + tie;
  }
  if (check == Check::Every || result.edge < 0 || !is_uncertain) return true;
  const S checked = support_separation(hull, ends, result.edge_normal);
  const bool stands = checked >= result.edge_separation - S(4) * tie;
  result.edge_separation = checked;
  return stands;
}

template <class S>
CapsuleTouch<S> face_touch(const Hull<S>& hull, const Vec3<S> (&ends)[2], int face, S scale) {
  const Plane<S>& plane = at(hull.planes, face);
  const S at_start = plane.distance(ends[0]), at_end = plane.distance(ends[1]);
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
template <class S> Vec3<S> across(const Vec3<S>& offset, const Vec3<S>& along) {
  return offset - (offset.dot(along) / along.squaredNorm()) * along;
}

/// Vector from the closest point of the feature to that of the segment. With a vertex or an end,
/// from the nearer end of the other: rounding is then relative to the distance.
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

/// On the Gauss map the segment is a ring: the great circle of all directions perpendicular to it,
/// along which both of its ends are equally deep. An edge of the hull is the arc between the
/// normals of its faces f and g. They make a face of the Minkowski difference where the arc crosses
/// the ring: the segment rises above one face and sinks below the other.
///
///          f .                         rise(f) = n_f . u > 0
///             \                        rise(g) = n_g . u < 0
///    ----------x---------- ring of u   The normal is x = e x u, with e along the half-edge whose
///               \                      left face is f: n_f x (e x u) = (n_f . u) e, so x lies
///                . g                   between n_f and n_g (otherwise it is -x).
///
/// Steps: 1. for every face, measure the lower end's distance from its plane; 2. for every edge
/// whose arc crosses the ring, measure the segment's distance along x, unless the ends of the arc
/// prove that it cannot beat the best so far.
template <class S>
CapsuleSat<S> capsule_sat(const Hull<S>& hull, const Vec3<S> (&ends)[2], S reach, S tie) {
  const FaceDistances<S> distances(hull, ends);
  CapsuleSat<S> result;
  best_face(hull, ends, distances, tie, result);
  if (result.face_separation > reach) return result;
  Scratch<int, 192> edges(hull.edge_count());
  const S bound = std::min(result.face_separation, S(0));
  const int count = crossing_edges(hull, distances, bound, edges.data());
  if (!best_edge_pair(hull, ends, distances, edges.data(), count, tie, Check::Last, result)) {
    result.edge = -1;
    best_edge_pair(hull, ends, distances, edges.data(), count, tie, Check::Every, result);
  }
  return result;
}

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
      // Separated, no axis has more than the distance, but this one has less: the cross product of
      // nearly parallel edges is rounded by epsilon over their sine. Their distance hardly changes.
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
  if (axes.face_tied && touch.distance <= touching)
    touch.degenerate = "segment as near to several faces";
  return touch;
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(capsule_sat, capsule_touch);

}  // namespace contactscope
