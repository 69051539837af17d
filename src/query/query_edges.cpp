#include <cmath>
#include <limits>

#include "query/gauss_map.h"
#include "query/sat.h"
#include "query/tolerance.h"

namespace contactscope {
namespace {

/// One edge of A as an arc on the Gauss map.
template <class S>
struct Arc {
  Vec3<S> edge;   // unit, along first x second
  Vec3<S> first;  // normal of the face on the edge's left
  Vec3<S> second;
  Vec3<S> sum;      // first + second
  bool wide;        // the faces meet at a sharp edge: the arc is longer than a quarter turn
  Vec3<S> on_edge;  // a vertex of the edge
};

template <class S>
Arc<S> arc_of(const PlacedHull<S>& hull, int half_edge) {
  const Vec3<S> first = hull.normals[hull.half_edge(half_edge).face];
  const Vec3<S> second = hull.normals[hull.half_edge(half_edge ^ 1).face];
  return {hull.directions[half_edge / 2], first, second, first + second, first.dot(second) < S(0),
          hull.origin(half_edge)};
}

/// side[f] = edge . normal of face f of `hull`.
template <class S>
void dot_with_normals(const Vec3<S>& edge, const PlacedHull<S>& hull, S* result) {
  const S* __restrict nx = hull.normals.x();
  const S* __restrict ny = hull.normals.y();
  const S* __restrict nz = hull.normals.z();
  S* __restrict side = result;
  const S x = edge.x(), y = edge.y(), z = edge.z();
  const int faces = hull.normals.padded_count();
  for (int f = 0; f < faces; ++f) side[f] = dot(nx[f], ny[f], nz[f], x, y, z);
}

/// The edges of `hull` whose arc crosses the plane for which side[f] was computed; the first half
/// of the Gauss map test. Returns their number. Written without a branch: which edges cross is
/// random to a branch predictor.
template <class S>
int crossing_edges(const PlacedHull<S>& hull, const S* side, int* crossing) {
  int count = 0;
  const HalfEdge* half_edges = hull.hull.half_edges.data();
  const int edges = hull.hull.edge_count();
  for (int e = 0; e < edges; ++e) {
    crossing[count] = e;
    count += sides_differ(side[half_edges[2 * e].face], side[half_edges[2 * e + 1].face]) ? 1 : 0;
  }
  return count;
}

/// Separation along a unit direction by the support points of both whole hulls. Valid for every
/// direction: the hulls' distance is never less.
template <class S>
S support_separation(const HullPair<S>& pair, const Vec3<S>& direction) {
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

/// +1 or -1, so that cross times it points from A to B, that is to the side of the arc. Talk,
/// "Normal Orientation": towards the edge from A's centre. We ask the arc itself instead: the
/// crossing x lies on it, so x . (first + second) > 0. For a wide arc first + second cancels, and
/// its difference seen along B's edge has the same sign: with k > 0,
///   x . (first + second) = k (1 + first . second) (first . edge_b - second . edge_b).
template <class S>
S orientation(const Arc<S>& arc, const Vec3<S>& cross, S first_along_b, S second_along_b) {
  const S outward = arc.wide ? first_along_b - second_along_b : cross.dot(arc.sum);
  return outward < S(0) ? S(-1) : S(1);
}

}  // namespace

/// Gregorius 2015, QueryEdgeDirection, with the Gauss map test of Gregorius 2013 first.
///
/// Steps, for each edge of A:
/// 1. its dot products with all face normals of B; edges of B whose faces lie on two sides are
/// left;
/// 2. for each of these the rest of the Gauss map test;
/// 3. the axis is the cross product of the unit edges. For a Minkowski face the edges themselves
///    are the support, so the separation is measured between a point of each;
/// 4. an axis that would win and is either uncertain (nearly parallel edges) or would separate is
///    measured again with the support points of both hulls. A slip of the Gauss map test at the
///    limit of rounding therefore cannot report a gap that is not there.
template <class S>
EdgeQuery<S> query_edges(const HullPair<S>& pair, S tie) {
  const PlacedHull<S>& a = pair.a;
  const PlacedHull<S>& b = pair.b;
  Scratch<S, 128> side(b.normals.padded_count());
  Scratch<int, 192> crossing(b.hull.edge_count() + 1);
  EdgeQuery<S> best;
  S to_beat = -std::numeric_limits<S>::infinity();

  for (int edge_a = 0; edge_a < a.hull.edge_count(); ++edge_a) {
    const Arc<S> arc = arc_of(a, 2 * edge_a);
    dot_with_normals(arc.edge, b, side.data());
    const int count = crossing_edges(b, side.data(), crossing.data());
    for (int k = 0; k < count; ++k) {
      const int edge_b = crossing[k];
      const Vec3<S> along_b = b.directions[edge_b];
      const S first_along_b = arc.first.dot(along_b);
      const S second_along_b = arc.second.dot(along_b);
      if (!sides_differ(first_along_b, second_along_b)) continue;
      if (!same_hemisphere(side[b.half_edge(2 * edge_b).face], first_along_b)) continue;

      const Vec3<S> cross = arc.edge.cross(along_b);
      const S sine = cross.norm();
      if (sine < kParallelSine<S>) continue;
      const Vec3<S> normal =
          cross * (orientation(arc, cross, first_along_b, second_along_b) / sine);
      S separation = normal.dot(Vec3<S>(b.origin(2 * edge_b) - arc.on_edge));
      if (!(separation > to_beat)) continue;
      if (sine < kNoisySine<S> || separation > S(0)) {
        separation = support_separation(pair, normal);
        if (!(separation > to_beat)) continue;
      }
      best = {2 * edge_a, 2 * edge_b, separation, normal};
      to_beat = separation + tie;
    }
  }
  return best;
}

template EdgeQuery<float> query_edges(const HullPair<float>&, float);
template EdgeQuery<double> query_edges(const HullPair<double>&, double);

}  // namespace contactscope
