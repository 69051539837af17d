#include "manifold/contact_from_normal.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "query/tolerance.h"

namespace contactscope {
namespace {

/// Of the plane of `face` the other hull's deepest vertex.
template <class S>
FaceQuery<S> measured_face(const PlacedHull<S>& reference, const PlacedHull<S>& other, int face) {
  const Plane<S> plane = reference.plane(face);
  FaceQuery<S> query{face, -1, std::numeric_limits<S>::infinity()};
  for (int v = 0; v < other.vertices.count(); ++v) {
    const Vec3<S> vertex = other.vertices[v];
    const S distance = dot(plane.normal.x(), plane.normal.y(), plane.normal.z(), vertex.x(),
                           vertex.y(), vertex.z()) -
                       plane.offset;
    if (distance < query.separation) query.separation = distance, query.support = v;
  }
  return query;
}

template <class S>
int most_parallel_face(const PlacedHull<S>& hull, const Vec3<S>& direction) {
  int best = 0;
  S most = -std::numeric_limits<S>::infinity();
  for (int face = 0; face < hull.normals.count(); ++face) {
    const S along = direction.dot(hull.normals[face]);
    if (along > most) most = along, best = face;
  }
  return best;
}

/// The farthest vertex along a direction.
template <class S>
int farthest_vertex(const PlacedHull<S>& hull, const Vec3<S>& direction) {
  int best = 0;
  S most = -std::numeric_limits<S>::infinity();
  for (int v = 0; v < hull.vertices.count(); ++v) {
    const S along = direction.dot(hull.vertices[v]);
    if (along > most) most = along, best = v;
  }
  return best;
}

template <class S>
S measured_separation(const HullPair<S>& pair, const Vec3<S>& normal) {
  const Vec3<S> on_a = pair.a.vertices[farthest_vertex(pair.a, normal)];
  const Vec3<S> on_b = pair.b.vertices[farthest_vertex(pair.b, Vec3<S>(-normal))];
  return normal.dot(Vec3<S>(on_b - on_a));
}

/// Calls visit(half_edge) for those that leave a vertex.
template <class S, class Visit>
void edges_around(const PlacedHull<S>& hull, int vertex, const Visit& visit) {
  const int first = hull.hull.vertex_edges[static_cast<std::size_t>(vertex)];
  int edge = first;
  do {
    visit(edge);
    edge = hull.half_edge(Hull<S>::twin(edge)).next;
  } while (edge != first);
}

/// Of the edges at both support vertices the pair whose cross product is nearest to the normal.
template <class S>
EdgeQuery<S> nearest_edge_pair(const HullPair<S>& pair, const Vec3<S>& normal) {
  const int vertex_a = farthest_vertex(pair.a, normal);
  const int vertex_b = farthest_vertex(pair.b, Vec3<S>(-normal));
  EdgeQuery<S> best;
  S most = S(0);
  edges_around(pair.a, vertex_a, [&](int edge_a) {
    const Vec3<S> along_a = pair.a.direction(edge_a);
    edges_around(pair.b, vertex_b, [&](int edge_b) {
      const Vec3<S> cross = along_a.cross(pair.b.direction(edge_b));
      const S sine = cross.norm();
      if (sine < kParallelSine<S>) return;
      const S along = normal.dot(cross) / sine;
      if (!(std::abs(along) > most)) return;
      most = std::abs(along);
      best.edge_a = edge_a & ~1;
      best.edge_b = edge_b & ~1;
      best.normal = along < S(0) ? Vec3<S>(-cross / sine) : Vec3<S>(cross / sine);
    });
  });
  if (best.edge_a >= 0) best.separation = measured_separation(pair, best.normal);
  return best;
}

template <class S>
bool has_pair(const SatResult<S>& axes) {
  return axes.edge.edge_a >= 0;
}

}  // namespace

template <class S>
SatResult<S> axes_of_normal(const HullPair<S>& pair, const Vec3<S>& normal, S depth,
                            Preference preference) {
  SatResult<S> axes;
  axes.queries_run = 3;
  axes.face_a = measured_face(pair.a, pair.b, most_parallel_face(pair.a, normal));
  axes.face_b = measured_face(pair.b, pair.a, most_parallel_face(pair.b, Vec3<S>(-normal)));
  axes.edge = nearest_edge_pair(pair, normal);

  axes.deepest = AxisKind::FaceA;
  if (axes.face_b.separation > axes.face_a.separation) axes.deepest = AxisKind::FaceB;
  if (has_pair(axes) && axes.edge.separation > axes.separation(axes.deepest)) {
    axes.deepest = AxisKind::EdgeEdge;
  }
  const S best = axes.separation(axes.deepest);
  const bool is_relative = preference == Preference::Relative;
  const S slack = is_relative ? preference_tolerance(depth, pair.min_radius)
                              : std::max(S(1e-4) * pair.min_radius, depth_rounding(pair.scale));
  axes.status = best < -depth - slack ? SatStatus::Separated : SatStatus::Touching;

  const S least = best - (is_relative ? preference_tolerance(best, pair.min_radius) : S(0));
  axes.chosen = AxisKind::EdgeEdge;
  if (axes.face_b.separation >= least) axes.chosen = AxisKind::FaceB;
  if (axes.face_a.separation >= least) axes.chosen = AxisKind::FaceA;
  return axes;
}

template SatResult<float> axes_of_normal(const HullPair<float>&, const Vec3<float>&, float,
                                         Preference);
template SatResult<double> axes_of_normal(const HullPair<double>&, const Vec3<double>&, double,
                                          Preference);

}  // namespace contactscope
