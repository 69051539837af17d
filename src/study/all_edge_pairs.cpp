#include "study/all_edge_pairs.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "query/sat.h"
#include "query/tolerance.h"

namespace contactscope {
namespace {

template <class S>
S best_face(const HullPair<S>& pair) {
  FaceSeparations<S> faces_a(pair.a), faces_b(pair.b);
  return std::max(query_faces(pair.a, pair.b, S(0), faces_a).separation,
                  query_faces(pair.b, pair.a, S(0), faces_b).separation);
}

template <class S>
std::vector<Vec3<S>> directions(const PlacedHull<S>& hull) {
  std::vector<Vec3<S>> list;
  for (int h = 0; h < 2 * hull.hull.edge_count(); h += 2) list.push_back(hull.direction(h));
  return list;
}

template <class S>
struct Extent {
  S least = std::numeric_limits<S>::infinity();
  S most = -std::numeric_limits<S>::infinity();
};

template <class S>
Extent<S> extent(const PlacedHull<S>& hull, const Vec3<S>& axis) {
  Extent<S> result;
  for (int v = 0; v < hull.vertices.count(); ++v) {
    const S along = axis.dot(hull.vertices[v]);
    result.least = along < result.least ? along : result.least;
    result.most = along > result.most ? along : result.most;
  }
  return result;
}

}  // namespace

template <class S>
S separation_by_all_edge_pairs(const HullPair<S>& pair) {
  S best = best_face(pair);
  const std::vector<Vec3<S>> of_b = directions(pair.b);
  for (const Vec3<S>& along_a : directions(pair.a)) {
    for (const Vec3<S>& along_b : of_b) {
      const Vec3<S> cross = along_a.cross(along_b);
      const S sine = cross.norm();
      if (sine < kParallelSine<S>) continue;
      const Vec3<S> axis = cross / sine;
      const Extent<S> a = extent(pair.a, axis);
      const Extent<S> b = extent(pair.b, axis);
      best = std::max({best, b.least - a.most, a.least - b.most});
    }
  }
  return best;
}

template <class S>
S separation_by_minkowski_faces(const HullPair<S>& pair) {
  S best = best_face(pair);
  const std::vector<Vec3<S>> of_a = directions(pair.a);
  const std::vector<Vec3<S>> of_b = directions(pair.b);
  const Vec3<S> center_a = pair.a.rotation * pair.a.hull.centroid;
  for (int h = 0; h < 2 * pair.a.hull.edge_count(); h += 2) {
    const Vec3<S> a1 = pair.a.normals[pair.a.half_edge(h).face];
    const Vec3<S> a2 = pair.a.normals[pair.a.half_edge(h + 1).face];
    const Vec3<S>& along_a = of_a[static_cast<std::size_t>(h / 2)];
    for (int g = 0; g < 2 * pair.b.hull.edge_count(); g += 2) {
      const Vec3<S> b1 = pair.b.normals[pair.b.half_edge(g).face];
      const Vec3<S> b2 = pair.b.normals[pair.b.half_edge(g + 1).face];
      const Vec3<S>& along_b = of_b[static_cast<std::size_t>(g / 2)];
      // Along the edges instead of cross products of normals, as in the talk: the same planes.
      const S b1_side = -b1.dot(along_a), b2_side = -b2.dot(along_a);
      const S a1_side = a1.dot(along_b), a2_side = a2.dot(along_b);
      if (!(b1_side * b2_side < S(0)) || !(a1_side * a2_side < S(0))) continue;
      // Both arcs cross the other's great circle; on the same half of the sphere only if these agree.
      if (!(b1_side * a2_side > S(0))) continue;
      const Vec3<S> cross = along_a.cross(along_b);
      const S sine = cross.norm();
      if (sine < kParallelSine<S>) continue;
      Vec3<S> axis = cross / sine;
      const Vec3<S> on_a = pair.a.origin(h);
      if (axis.dot(Vec3<S>(on_a - center_a)) < S(0)) axis = -axis;
      best = std::max(best, axis.dot(Vec3<S>(pair.b.origin(g) - on_a)));
    }
  }
  return best;
}

template float separation_by_all_edge_pairs(const HullPair<float>&);
template double separation_by_all_edge_pairs(const HullPair<double>&);
template float separation_by_minkowski_faces(const HullPair<float>&);
template double separation_by_minkowski_faces(const HullPair<double>&);

}  // namespace contactscope
