#include "manifold/clip.h"

#include <algorithm>
#include <limits>

namespace contactscope {
namespace {

EdgeRef edge_ref(Owner owner, int half_edge) {
  return {owner, static_cast<std::uint32_t>(half_edge / 2)};
}

/// Sutherland and Hodgman assume that the polygon is convex, which rounding of a face with
/// almost straight corners can break; then a plane may add more than one corner.
template <class S>
void append(ClipPolygon<S>& polygon, const ClipVertex<S>& vertex) {
  if (polygon.size() < polygon.capacity()) polygon.push_back(vertex);
}

}  // namespace

template <class S>
void face_polygon(const PlacedHull<S>& hull, Owner owner, int face, ClipPolygon<S>& polygon) {
  polygon.clear();
  const int start = hull.hull.face_edges[static_cast<std::size_t>(face)];
  int edge = start;
  EdgeRef arriving{};
  do {
    const EdgeRef leaving = edge_ref(owner, edge);
    polygon.push_back({hull.origin(edge), leaving, FeatureId::of(arriving, leaving)});
    arriving = leaving;
    edge = hull.half_edge(edge).next;
  } while (edge != start);
  // Only now is the edge known that arrives at the first corner.
  polygon[0].id = FeatureId::of(arriving, polygon[0].leaving);
}

template <class S>
Plane<S> side_plane(const PlacedHull<S>& hull, int half_edge) {
  const Vec3<S> face_normal = hull.normals[hull.half_edge(half_edge).face];
  const Vec3<S> normal = hull.direction(half_edge).cross(face_normal);
  return {normal, normal.dot(hull.origin(half_edge))};
}

/// Sutherland and Hodgman 1974, one plane, with a plane as thick as rounding. Each polygon edge
/// from p to q in turn: p stays unless it is outside; an edge that runs from inside to outside or
/// back leaves its crossing with the plane.
///
///          p .            the crossing made here has the id (edge p q, side edge) and goes on
///             \           along the side edge; the one where the polygon comes back has the id
///     ---------x------    (side edge, edge of that p) and goes on along that edge
///               \ q
template <class S>
bool clip(const ClipPolygon<S>& polygon, const Plane<S>& side, EdgeRef side_edge, S thickness,
          ClipPolygon<S>& result) {
  S distances[kMaxManifoldPoints];
  S farthest = -std::numeric_limits<S>::infinity();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    distances[i] = side.distance(polygon[i].position);
    farthest = std::max(farthest, distances[i]);
  }
  if (!(farthest > thickness)) return false;

  result.clear();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const std::size_t next = i + 1 < polygon.size() ? i + 1 : 0;
    const ClipVertex<S>& p = polygon[i];
    const S p_distance = distances[i];
    const S q_distance = distances[next];
    const bool p_outside = p_distance > thickness;
    const bool q_outside = q_distance > thickness;
    const bool p_inside = p_distance < -thickness;
    const bool q_inside = q_distance < -thickness;

    if (!p_outside) {
      const bool on_and_out = !p_inside && q_outside;
      append(result, {p.position, on_and_out ? side_edge : p.leaving, p.id});
    }
    if ((p_inside && q_outside) || (p_outside && q_inside)) {
      const S fraction = p_distance / (p_distance - q_distance);
      const Vec3<S> crossing = p.position + fraction * (polygon[next].position - p.position);
      append(result,
             {crossing, p_inside ? side_edge : p.leaving, FeatureId::of(p.leaving, side_edge)});
    }
  }
  return true;
}

template void face_polygon(const PlacedHull<float>&, Owner, int, ClipPolygon<float>&);
template void face_polygon(const PlacedHull<double>&, Owner, int, ClipPolygon<double>&);
template Plane<float> side_plane(const PlacedHull<float>&, int);
template Plane<double> side_plane(const PlacedHull<double>&, int);
template bool clip(const ClipPolygon<float>&, const Plane<float>&, EdgeRef, float,
                   ClipPolygon<float>&);
template bool clip(const ClipPolygon<double>&, const Plane<double>&, EdgeRef, double,
                   ClipPolygon<double>&);

}  // namespace contactscope
