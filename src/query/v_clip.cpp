#include "query/v_clip.h"

#include "query/closest_points.h"
#include "query/voronoi_region.h"

namespace contactscope {
namespace {

/// The result of comparing two features: they are closest, their hulls overlap, or one changed.
enum class Verdict { Closest, Overlap, Moved };

/// One hull, and the other's pose in its frame.
template <class S> struct View {
  const Hull<S>& own;
  const Hull<S>& other;
  Pose<S> other_in_own;

  Vec3<S> vertex_of_other(int vertex) const {
    return other_in_own.transform(at(other.vertices, vertex));
  }
  Vec3<S> origin_of_other(int half_edge) const {
    return vertex_of_other(at(other.half_edges, half_edge).origin);
  }
};

template <class S> HullFeature origin_of(const Hull<S>& hull, int half_edge) {
  return {FeatureKind::Vertex, at(hull.half_edges, half_edge).origin};
}

/// The part of a segment inside some planes, and the neighbours behind the planes that end it.
template <class S> struct ClippedEdge {
  S low = 0, high = 1;  // parameters; reversed if no part is left
  HullFeature neighbor_low, neighbor_high;
  bool is_excluded = false;  // all of it is beyond one plane, towards `neighbor_low`

  /// `tail`, `head`: signed distances of the ends from a plane, positive inside, times any length.
  void cut(S tail, S head, const HullFeature& neighbor) {
    if (is_excluded || (tail >= S(0) && head >= S(0))) return;
    if (tail < S(0) && head < S(0)) {
      is_excluded = true;
      neighbor_low = neighbor;
    } else if (tail < S(0)) {
      const S crossing = tail / (tail - head);
      if (crossing > low) low = crossing, neighbor_low = neighbor;
    } else {
      const S crossing = tail / (tail - head);
      if (crossing < high) high = crossing, neighbor_high = neighbor;
    }
  }
};

/// Where an edge leaves a region through a plane, the distance from the region's feature must grow
/// to the outside; else the neighbour behind that plane is closer. `growth(parameter, neighbour)`:
/// the derivative of the distance along the edge, times any length.
template <class S, class Growth>
Verdict follow(const ClippedEdge<S>& part, HullFeature& feature, const Growth& growth) {
  if (part.is_excluded) {
    feature = part.neighbor_low;
    return Verdict::Moved;
  }
  if (part.neighbor_low.index >= 0 && growth(part.low, part.neighbor_low) > S(0)) {
    feature = part.neighbor_low;
    return Verdict::Moved;
  }
  if (part.neighbor_high.index >= 0 && growth(part.high, part.neighbor_high) < S(0)) {
    feature = part.neighbor_high;
    return Verdict::Moved;
  }
  return Verdict::Closest;
}

/// Normal of the side plane of a face at one of its half-edges, outward, with the edge's length.
template <class S> Vec3<S> outward_of(const Hull<S>& hull, int half_edge) {
  const Vec3<S> along = hull.target(half_edge) - hull.origin(half_edge);
  return along.cross(at(hull.planes, at(hull.half_edges, half_edge).face).normal);
}

/// Moves `vertex` along an edge whose plane at the vertex the point is beyond.
template <class S>
Verdict leave_vertex(const Hull<S>& hull, const Vec3<S>& point, HullFeature& vertex) {
  const Vec3<S>& from = at(hull.vertices, vertex.index);
  for (const int edge : hull.around_vertex(vertex.index)) {
    if ((hull.target(edge) - from).dot(Vec3<S>(point - from)) <= S(0)) continue;
    vertex = {FeatureKind::Edge, edge};
    return Verdict::Moved;
  }
  return Verdict::Closest;
}

/// A vertex of the other hull against the region of an edge.
template <class S>
Verdict leave_edge(const Hull<S>& hull, const Vec3<S>& point, HullFeature& edge) {
  for (const int half_edge : {edge.index, Hull<S>::twin(edge.index)}) {
    const Vec3<S>& from = hull.origin(half_edge);
    const Vec3<S> along = hull.target(half_edge) - from, offset = point - from;
    if (along.dot(offset) < S(0)) {
      edge = origin_of(hull, half_edge);
      return Verdict::Moved;
    }
    if (outward_of(hull, half_edge).dot(offset) < S(0)) {
      edge = {FeatureKind::Face, at(hull.half_edges, half_edge).face};
      return Verdict::Moved;
    }
  }
  return Verdict::Closest;
}

/// An edge of the other hull against the region of a vertex.
template <class S>
Verdict clip_to_vertex(const View<S>& view, int other_edge, HullFeature& vertex) {
  const Vec3<S>& at_vertex = at(view.own.vertices, vertex.index);
  const Vec3<S> tail = view.origin_of_other(other_edge) - at_vertex;
  const Vec3<S> head = view.origin_of_other(Hull<S>::twin(other_edge)) - at_vertex;
  ClippedEdge<S> part;
  for (const int edge : view.own.around_vertex(vertex.index)) {
    const Vec3<S> along = view.own.target(edge) - at_vertex;
    part.cut(-along.dot(tail), -along.dot(head), {FeatureKind::Edge, edge});
  }
  const Vec3<S> offset = head - tail;
  return follow(part, vertex, [&](S parameter, const HullFeature&) {
    return offset.dot(Vec3<S>(tail + parameter * offset));
  });
}

/// An edge of the other hull against an edge's region: planes at its vertices, then of its faces.
template <class S>
Verdict clip_to_edge_region(const View<S>& view, int other_edge, HullFeature& edge) {
  const Hull<S>& hull = view.own;
  const Vec3<S> tail = view.origin_of_other(other_edge);
  const Vec3<S> head = view.origin_of_other(Hull<S>::twin(other_edge));
  const Vec3<S> offset = head - tail;
  const int sides[] = {edge.index, Hull<S>::twin(edge.index)};
  ClippedEdge<S> by_vertices;
  for (const int side : sides) {
    const Vec3<S>& from = hull.origin(side);
    const Vec3<S> along = hull.target(side) - from;
    by_vertices.cut(along.dot(Vec3<S>(tail - from)), along.dot(Vec3<S>(head - from)),
                    origin_of(hull, side));
  }
  const Verdict verdict = follow(by_vertices, edge, [&](S parameter, const HullFeature& vertex) {
    return offset.dot(Vec3<S>(tail + parameter * offset - at(hull.vertices, vertex.index)));
  });
  if (verdict == Verdict::Moved) return verdict;
  ClippedEdge<S> by_faces;
  for (const int side : sides) {
    const Vec3<S>& from = hull.origin(side);
    const Vec3<S> outward = outward_of(hull, side);
    by_faces.cut(outward.dot(Vec3<S>(tail - from)), outward.dot(Vec3<S>(head - from)),
                 {FeatureKind::Face, at(hull.half_edges, side).face});
  }
  return follow(by_faces, edge, [&](S parameter, const HullFeature& face) {
    const Plane<S>& plane = at(hull.planes, face.index);
    const S rise = plane.normal.dot(offset);
    return plane.distance(Vec3<S>(tail + parameter * offset)) < S(0) ? -rise : rise;
  });
}

/// A vertex of the other hull against a face and its region.
template <class S>
Verdict test_vertex_face(const View<S>& view, HullFeature& vertex, HullFeature& face) {
  const Vec3<S> point = view.vertex_of_other(vertex.index);
  if (const int edge = outside_side(view.own, face.index, point); edge >= 0) {
    face = {FeatureKind::Edge, edge};
    return Verdict::Moved;
  }
  const auto height = [&](const Vec3<S>& of) {
    return at(view.own.planes, face.index).distance(of);
  };
  const S own_height = height(point);
  for (const int edge : view.other.around_vertex(vertex.index)) {
    const S end = height(view.origin_of_other(Hull<S>::twin(edge)));
    if (own_height > S(0) ? end >= own_height : end <= own_height) continue;
    vertex = {FeatureKind::Edge, edge};
    return Verdict::Moved;
  }
  if (own_height > S(0)) return Verdict::Closest;
  // Below this face, but no lower: a local minimum, unless the vertex is below all faces.
  S highest = S(0);
  for (int i = 0; i < view.own.face_count(); ++i) {
    const S above = at(view.own.planes, i).distance(point);
    if (above <= highest) continue;
    highest = above;
    face.index = i;
  }
  return highest > S(0) ? Verdict::Moved : Verdict::Overlap;
}

/// An edge of the other hull against a face and its region. Such features are never closest.
template <class S>
Verdict test_edge_face(const View<S>& view, HullFeature& edge, HullFeature& face) {
  const Hull<S>& hull = view.own;
  const int twin = Hull<S>::twin(edge.index);
  const Vec3<S> tail = view.origin_of_other(edge.index), head = view.origin_of_other(twin);
  const Plane<S>& plane = at(hull.planes, face.index);
  const ClippedSegment<S> part = clip_to_prism<S>(hull, face.index, {tail, head}, S(0));
  if (part.empty()) {
    // Outside of the prism over the face, whose border is as close.
    S least = std::numeric_limits<S>::infinity();
    const int old = face.index;
    for (const int side : hull.around_face(old)) {
      const S distance =
          closest_of_segments<S>(hull.origin(side), hull.target(side), tail, head).distance;
      if (distance >= least) continue;
      least = distance;
      face = {FeatureKind::Edge, side};
    }
    return Verdict::Moved;
  }
  const Vec3<S> offset = head - tail;
  const S low = plane.distance(Vec3<S>(tail + part.parameters[0] * offset));
  const S high = plane.distance(Vec3<S>(tail + part.parameters[1] * offset));
  if ((low <= S(0)) != (high <= S(0))) return Verdict::Overlap;
  const bool towards_tail = std::abs(low) <= std::abs(high);
  if (const int side = part.edges[towards_tail ? 0 : 1]; side >= 0)
    face = {FeatureKind::Edge, side};
  else
    edge = origin_of(view.other, towards_tail ? edge.index : twin);
  return Verdict::Moved;
}

template <class S>
Verdict test(const View<S>& from_a, const View<S>& from_b, ComparedFeatures& pair) {
  using K = FeatureKind;
  const auto is = [&](K a, K b) { return pair.a.kind == a && pair.b.kind == b; };
  const auto either = [](Verdict first, const auto& second) {
    return first == Verdict::Closest ? second() : first;
  };
  if (is(K::Vertex, K::Vertex))
    return either(leave_vertex(from_a.own, from_a.vertex_of_other(pair.b.index), pair.a), [&] {
      return leave_vertex(from_b.own, from_b.vertex_of_other(pair.a.index), pair.b);
    });
  if (is(K::Vertex, K::Edge))
    return either(leave_edge(from_b.own, from_b.vertex_of_other(pair.a.index), pair.b),
                  [&] { return clip_to_vertex(from_a, pair.b.index, pair.a); });
  if (is(K::Edge, K::Vertex))
    return either(leave_edge(from_a.own, from_a.vertex_of_other(pair.b.index), pair.a),
                  [&] { return clip_to_vertex(from_b, pair.a.index, pair.b); });
  if (is(K::Edge, K::Edge))
    return either(clip_to_edge_region(from_a, pair.b.index, pair.a),
                  [&] { return clip_to_edge_region(from_b, pair.a.index, pair.b); });
  if (is(K::Vertex, K::Face)) return test_vertex_face(from_b, pair.a, pair.b);
  if (is(K::Face, K::Vertex)) return test_vertex_face(from_a, pair.b, pair.a);
  if (is(K::Edge, K::Face)) return test_edge_face(from_b, pair.a, pair.b);
  return test_edge_face(from_a, pair.b, pair.a);  // two faces are never compared
}

/// Closest points of two features in one frame: a segment for an edge, a point for a vertex.
template <class S>
std::array<Vec3<S>, 2> ends_of(const Hull<S>& hull, const HullFeature& feature,
                               const Pose<S>& pose) {
  if (feature.kind == FeatureKind::Vertex)
    return {pose.transform(at(hull.vertices, feature.index)),
            pose.transform(at(hull.vertices, feature.index))};
  return {pose.transform(hull.origin(feature.index)), pose.transform(hull.target(feature.index))};
}

template <class S>
void measure(const View<S>& from_a, const View<S>& from_b, VClipResult<S>& result) {
  const auto [a, b] = result.features;
  const Pose<S>& b_in_a = from_a.other_in_own;
  if (b.kind == FeatureKind::Face) {
    const Vec3<S> point = from_b.vertex_of_other(a.index);
    result.on_a = at(from_a.own.vertices, a.index);
    result.on_b = b_in_a.transform(at(from_b.own.planes, b.index).project(point));
  } else if (a.kind == FeatureKind::Face) {
    result.on_b = from_a.vertex_of_other(b.index);
    result.on_a = at(from_a.own.planes, a.index).project(result.on_b);
  } else {
    const auto of_a = ends_of(from_a.own, a, Pose<S>()), of_b = ends_of(from_b.own, b, b_in_a);
    const auto closest = closest_of_segments<S>(of_a[0], of_a[1], of_b[0], of_b[1]);
    result.on_a = closest.on_a;
    result.on_b = closest.on_b;
  }
  result.distance = (result.on_b - result.on_a).norm();
}

}  // namespace

template <class S>
VClipResult<S> v_clip(const Hull<S>& a, const Hull<S>& b, const Pose<S>& b_in_a,
                      const ComparedFeatures* start, std::vector<ComparedFeatures>* walk) {
  const View<S> from_a{a, b, b_in_a}, from_b{b, a, relative_pose(b_in_a, Pose<S>())};
  VClipResult<S> result;
  result.features =
      start ? *start : ComparedFeatures{{FeatureKind::Vertex, 0}, {FeatureKind::Vertex, 0}};
  const int most = 4 * (a.edge_count() + b.edge_count()) + 64;
  ComparedFeatures seen = result.features;
  int next_kept = 1;
  for (; result.steps < most; ++result.steps) {
    if (walk) walk->push_back(result.features);
    const Verdict verdict = test(from_a, from_b, result.features);
    if (verdict != Verdict::Moved) {
      result.status = verdict == Verdict::Overlap ? VClipStatus::Overlap : VClipStatus::Separated;
      break;
    }
    // The distance never grows. A walk in a circle is over: rounding decides between features that
    // are as close, such as parallel edges and their ends. (Brent 1980 finds circles.)
    if (result.features == seen) {
      result.status = VClipStatus::Separated;
      break;
    }
    if (result.steps + 1 == next_kept) {
      seen = result.features;
      next_kept *= 2;
    }
  }
  if (result.status != VClipStatus::Overlap) measure(from_a, from_b, result);
  return result;
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(v_clip);

}  // namespace contactscope
