#include "query/fast/face_bounds.h"
#include "query/gauss_map.h"
#include "query/tolerance.h"

namespace contactscope {
namespace {

/// End of an arc: a unit direction, B's support vertex along it, and the separation it gives.
template <class S> struct ArcEnd {
  Vec3<S> direction;
  int support;
  S separation;  // metres
};

/// An edge of A as an arc on the Gauss map, from the normal of the half-edge's left face to that of
/// the other face. For a flat A, one half of it.
template <class S> struct Arc {
  int half_edge;
  Vec3<S> on_edge;  // a vertex of the edge
  ArcEnd<S> first, second;
};

/// `direction` is a unit vector, and `on_a` a support point of A along it.
template <class S>
ArcEnd<S> end_along(const PlacedHull<S>& b, const Vec3<S>& direction, const Vec3<S>& on_a) {
  ArcEnd<S> end{direction, 0, std::numeric_limits<S>::infinity()};
  for (int v = 0; v < b.vertices.count(); ++v) {
    const S separation = direction.dot(Vec3<S>(b.vertices[v] - on_a));
    if (separation < end.separation) end = {direction, v, separation};
  }
  return end;
}

/// True if no direction of the arc has a separation above `bound`, judged by the support vertices
/// at its ends. Along n(t) = (1 - t) first + t second the distance of B's deepest vertex from a
/// point of the edge is a minimum over vertices of linear functions of t: concave, and below the
/// line of each vertex. Where that is negative, dividing by |n(t)| <= 1 only lowers it.
template <class S>
bool arc_stays_below(const PlacedHull<S>& b, const Vec3<S>& on_edge, const ArcEnd<S>& first,
                     const ArcEnd<S>& second, S bound) {
  const S most = std::min(bound, S(0));
  const S first_at_second = second.direction.dot(Vec3<S>(b.vertices[first.support] - on_edge));
  if (std::max(first.separation, first_at_second) <= most) return true;
  const S second_at_first = first.direction.dot(Vec3<S>(b.vertices[second.support] - on_edge));
  return std::max(second.separation, second_at_first) <= most;
}

/// Separation along a unit direction by the support points of both hulls. Valid for every
/// direction: the hulls' distance is never less.
template <class S> S support_separation(const HullPair<S>& pair, const Vec3<S>& direction) {
  S a_most = -std::numeric_limits<S>::infinity();
  for (int v = 0; v < pair.a.vertices.count(); ++v) {
    const S along = direction.dot(pair.a.vertices[v]);
    a_most = along > a_most ? along : a_most;
  }
  S b_least = std::numeric_limits<S>::infinity();
  for (int v = 0; v < pair.b.vertices.count(); ++v) {
    const S along = direction.dot(pair.b.vertices[v]);
    b_least = along < b_least ? along : b_least;
  }
  return b_least - a_most;
}

/// Sign, +1 or -1, that orients cross = edge A x edge B from A to B, along the arc. The talk
/// ("Normal Orientation") uses A's centre. Here the crossing x is on the arc: x . (first + second)
/// > 0. Of arcs of more than a quarter turn the sum cancels. But it is k (1 + first . second)
/// (first . edge_b - second . edge_b) with k > 0, and the walk uses edges of B with a positive last
/// factor.
template <class S> S orientation(const Arc<S>& arc, const Vec3<S>& cross) {
  const Vec3<S>&first = arc.first.direction, &second = arc.second.direction;
  const bool wide = first.dot(second) < S(0);
  return wide || cross.dot(Vec3<S>(first + second)) >= S(0) ? S(1) : S(-1);
}

/// Computes the axis of a crossing: the cross product of the unit edges, which has no scale. The
/// edges are the support features, so the separation is the distance between a point of each.
/// Returns the sine of their angle; below kParallelSine there is no axis.
template <class S>
[[gnu::always_inline]] inline S cross_edges(const HullPair<S>& pair, const Arc<S>& arc,
                                            const Vec3<S>& along_a, int edge_b,
                                            EdgeQuery<S>& found) {
  const Vec3<S> cross = along_a.cross(pair.b.direction(edge_b));
  const S sine = cross.norm();
  if (sine < kParallelSine<S>) return sine;
  const Vec3<S> normal = cross * (orientation(arc, cross) / sine);
  const Vec3<S> between = pair.b.origin(edge_b) - arc.on_edge;
  found = {arc.half_edge, edge_b, normal.dot(between), normal};
  return sine;
}

/// Measures one face of the Minkowski difference. An axis that would win and is uncertain (nearly
/// parallel edges) or would separate is measured again with the support points of both hulls, so
/// that rounding cannot report a false separation. Returns true if it becomes the `best`.
template <class S>
[[gnu::always_inline]] inline bool measure(const HullPair<S>& pair, const Arc<S>& arc,
                                           const Vec3<S>& along_a, int edge_b, S to_beat,
                                           EdgeQuery<S>& best) {
  EdgeQuery<S> found;
  const S sine = cross_edges(pair, arc, along_a, edge_b, found);
  if (sine < kParallelSine<S> || !(found.separation > to_beat)) return false;
  if (sine < kNoisySine<S> || found.separation > S(0)) {
    found.separation = support_separation(pair, found.normal);
    if (!(found.separation > to_beat)) return false;
  }
  best = found;
  return true;
}

/// Calls visit(arc, along_a, edge_b) for each edge of B whose arc crosses the given (half) arc of
/// A, unless no separation on it can exceed `to_beat`. Inlined; the Arc is built only for a walk.
template <class S, class Visit>
[[gnu::always_inline]] inline void walk(const HullPair<S>& pair, const Mat3<S>& a_to_b, int edge,
                                        const Vec3<S>& on_edge, const ArcEnd<S>& first,
                                        const ArcEnd<S>& second, S to_beat, Visit& visit) {
  if (first.support == second.support || arc_stays_below(pair.b, on_edge, first, second, to_beat))
    return;
  const Arc<S> arc{edge, on_edge, first, second};
  const Vec3<S> along_a = pair.a.direction(edge);
  const Vec3<S> first_in_b = a_to_b * first.direction, second_in_b = a_to_b * second.direction;
  walk_arc(pair.b.hull, first_in_b, second_in_b, first.support, second.support,
           [&](int edge_b) { visit(arc, along_a, edge_b); });
}

/// Calls visit(arc, along_a, edge_b) for every pair of edges whose arcs cross, except for arcs on
/// which no separation can exceed `to_beat`. `visit` may raise `to_beat`.
template <class S, class Visit>
void each_crossing(const HullPair<S>& pair, const FaceSeparations<S>& faces_a, const S& to_beat,
                   Visit&& visit) {
  const PlacedHull<S>&a = pair.a, &b = pair.b;
  const Mat3<S> a_to_b = b.rotation.transpose();
  const auto end_at = [&](int face) {
    return ArcEnd<S>{a.normals[face], faces_a.support(face), faces_a.separation(face)};
  };
  const bool flat = a.hull.flat();
  for (int edge = 0; edge < 2 * a.hull.edge_count(); edge += 2) {
    const int first = a.half_edge(edge).face;
    const int second = a.half_edge(edge + 1).face;
    if (flat) [[unlikely]] {
      // The normals of the two faces are opposite and do not determine the arc. Split it in two
      // quarters at the direction in the plane that points away from the edge.
      const Vec3<S> on_edge = a.origin(edge);
      const Vec3<S> side = a.direction(edge).cross(a.normals[first]);
      const ArcEnd<S> middle = end_along(b, side, on_edge);
      walk(pair, a_to_b, edge, on_edge, end_at(first), middle, to_beat, visit);
      walk(pair, a_to_b, edge, on_edge, middle, end_at(second), to_beat, visit);
    } else if (faces_a.support(first) != faces_a.support(second)) {
      walk(pair, a_to_b, edge, a.origin(edge), end_at(first), end_at(second), to_beat, visit);
    }
  }
}

/// Keeps the best of the visited crossings.
template <class S> struct BestCrossing {
  void operator()(const Arc<S>& arc, const Vec3<S>& along_a, int edge_b) {
    if (measure(pair, arc, along_a, edge_b, to_beat, best)) to_beat = best.separation + tie;
  }

  const HullPair<S>& pair;
  S to_beat;
  S tie;
  EdgeQuery<S> best{};
};

/// The edge at a vertex of a flat hull that is less parallel to a direction.
template <class S>
int edge_across(const PlacedHull<S>& hull, int vertex, const Vec3<S>& direction) {
  const int one = at(hull.hull.vertex_edges, vertex);
  const int other = hull.half_edge(Hull<S>::twin(one)).next;
  const auto cosine = [&](int edge) { return std::abs(direction.dot(hull.direction(edge))); };
  return cosine(one) <= cosine(other) ? one : other;
}

}  // namespace

/// Gregorius 2015, QueryEdgeDirection, on the Gauss map (see gauss_map.h).
///
/// Steps, for each edge of A:
/// 1. its arc runs between the regions of two support vertices of B; if they are the same, the arc
///    crosses nothing;
/// 2. skip arcs that cannot beat the best so far; 3. walk the arc, and measure each crossing.
template <class S>
EdgeQuery<S> query_edges(const HullPair<S>& pair, const FaceSeparations<S>& faces_a, S floor,
                         S tie) {
  BestCrossing<S> crossing{pair, floor, tie};
  each_crossing(pair, faces_a, crossing.to_beat, crossing);
  return crossing.best;
}

/// Rounding may raise a measured crossing above the true value of its arc: by the rounding of the
/// sine times the measured length. So `floor` is lowered by that much. The error can exceed this
/// only for nearly parallel edges, whose axes are measured again with support points.
template <class S>
EdgeQuery<S> query_edges(const HullPair<S>& pair, const FaceBounds<S>& bounds_a, S floor, S tie) {
  const PlacedHull<S>& a = pair.a;
  const S rounding = S(64) * std::numeric_limits<S>::epsilon() * pair.scale;
  Scratch<int, 256> edges(a.hull.edge_count() + 1);
  const int count = bounds_a.edges_above(std::min(floor, S(0)) - rounding, edges.data());
  const Mat3<S> a_to_b = pair.b.rotation.transpose();
  const FaceQuery<S>& best_face = bounds_a.best();
  const auto end_at = [&](int face) {
    const FaceQuery<S> query = face == best_face.face ? best_face : measure_face(a, face, pair.b);
    return ArcEnd<S>{a.normals[face], query.support, query.separation};
  };
  BestCrossing<S> crossing{pair, floor, tie};
  for (int i = 0; i < count; ++i) {
    const int edge = edges[i];
    const ArcEnd<S> first = end_at(a.half_edge(edge).face);
    const ArcEnd<S> second = end_at(a.half_edge(edge + 1).face);
    walk(pair, a_to_b, edge, a.origin(edge), first, second, crossing.to_beat, crossing);
  }
  return crossing.best;
}

template <class S>
std::vector<EdgeQuery<S>> all_crossings(const HullPair<S>& pair,
                                        const FaceSeparations<S>& faces_a) {
  std::vector<EdgeQuery<S>> crossings;
  each_crossing(pair, faces_a, -std::numeric_limits<S>::infinity(),
                [&](const Arc<S>& arc, const Vec3<S>& along_a, int edge_b) {
                  EdgeQuery<S> found;
                  if (cross_edges(pair, arc, along_a, edge_b, found) >= kParallelSine<S>)
                    crossings.push_back(found);
                });
  return crossings;
}

template <class S> EdgeQuery<S> query_sides(const HullPair<S>& pair) {
  EdgeQuery<S> best;
  best.separation = -std::numeric_limits<S>::infinity();
  const auto look = [&](const PlacedHull<S>& hull, const PlacedHull<S>& other, Owner owner) {
    for (int edge = 0; edge < 2 * hull.hull.edge_count(); edge += 2) {
      const Vec3<S> along = hull.direction(edge);
      const Vec3<S> side = along.cross(hull.normals[hull.half_edge(edge).face]);
      const ArcEnd<S> end = end_along(other, side, hull.origin(edge));
      if (!(end.separation > best.separation)) continue;
      const int across = edge_across(other, end.support, along);
      if (owner == Owner::A)
        best = {edge, across, end.separation, side};
      else
        best = {across, edge, end.separation, -side};
    }
  };
  look(pair.a, pair.b, Owner::A);
  look(pair.b, pair.a, Owner::B);
  return best;
}

#define CONTACTSCOPE_INSTANTIATE(S)                                                                \
  template EdgeQuery<S> query_edges(const HullPair<S>&, const FaceSeparations<S>&, S, S);          \
  template EdgeQuery<S> query_edges(const HullPair<S>&, const FaceBounds<S>&, S, S);               \
  template std::vector<EdgeQuery<S>> all_crossings(const HullPair<S>&, const FaceSeparations<S>&); \
  template EdgeQuery<S> query_sides(const HullPair<S>&);
CONTACTSCOPE_INSTANTIATE(float)
CONTACTSCOPE_INSTANTIATE(double)
#undef CONTACTSCOPE_INSTANTIATE

}  // namespace contactscope
