#include "manifold/clip.h"

namespace contactscope {
namespace {

/// Sutherland and Hodgman assume a convex polygon. Rounding of a face with almost straight corners
/// can break that; then a plane may add more than one corner.
template <class S> void append(ClipPolygon<S>& polygon, const ClipVertex<S>& vertex) {
  if (polygon.size() < polygon.capacity()) polygon.push_back(vertex);
}

}  // namespace

template <class Placed>
void face_polygon(const Placed& hull, Owner owner, int face,
                  ClipPolygon<typename Placed::Scalar>& polygon) {
  polygon.clear();
  EdgeKey arriving{};
  for (const int edge : hull.hull.around_face(face)) {
    const EdgeKey leaving = edge_key(owner, edge);
    polygon.push_back({hull.origin(edge), leaving, Crossing::of(arriving, leaving)});
    arriving = leaving;
  }
  // Only now is the edge known that arrives at the first corner.
  polygon[0].crossing = Crossing::of(arriving, polygon[0].leaving);
}

/// Sutherland and Hodgman 1974, one plane, as thick as rounding. For each polygon edge from p to q:
/// p stays unless it is outside; an edge that crosses the plane adds the crossing.
///
///          p .            the crossing made here has the id (edge p q, side edge) and continues
///             \           along the side edge; the crossing where the polygon comes back has the
///     ---------x------    id (side edge, edge of that p) and continues along that edge
///               \ q
template <class S>
bool clip(const ClipPolygon<S>& polygon, const Plane<S>& side, EdgeKey side_edge, S thickness,
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
      append(result, {p.position, on_and_out ? side_edge : p.leaving, p.crossing});
    }
    if ((p_inside && q_outside) || (p_outside && q_inside)) {
      const S fraction = p_distance / (p_distance - q_distance);
      const Vec3<S> crossing = p.position + fraction * (polygon[next].position - p.position);
      append(result,
             {crossing, p_inside ? side_edge : p.leaving, Crossing::of(p.leaving, side_edge)});
    }
  }
  return true;
}

#define CONTACTSCOPE_INSTANTIATE(S)                                                         \
  template void face_polygon(const PlacedHull<S>&, Owner, int, ClipPolygon<S>&);            \
  template void face_polygon(const PlacedFeatures<S, false>&, Owner, int, ClipPolygon<S>&); \
  template void face_polygon(const PlacedFeatures<S, true>&, Owner, int, ClipPolygon<S>&);  \
  template bool clip(const ClipPolygon<S>&, const Plane<S>&, EdgeKey, S, ClipPolygon<S>&);
CONTACTSCOPE_INSTANTIATE(float)
CONTACTSCOPE_INSTANTIATE(double)
#undef CONTACTSCOPE_INSTANTIATE

}  // namespace contactscope
