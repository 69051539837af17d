#include <limits>
#include <utility>

#include "manifold/create_contact.h"
#include "manifold/recorder.h"
#include "query/tolerance.h"

namespace contactscope {
namespace {

template <class S>
const PlacedHull<S>& hull_of(const HullPair<S>& pair, Owner owner) {
  return owner == Owner::A ? pair.a : pair.b;
}

/// The two edges of a face that meet at one of its vertices.
template <class S>
FeatureId corner_id(const PlacedHull<S>& hull, Owner owner, int face, int vertex) {
  int arriving = at(hull.hull.face_edges, face);
  while (hull.half_edge(Hull<S>::twin(arriving)).origin != vertex) {
    arriving = hull.half_edge(arriving).next;
  }
  const int leaving = hull.half_edge(arriving).next;
  return Crossing::of(edge_key(owner, arriving), edge_key(owner, leaving)).id();
}

}  // namespace

template <class Placed, class S>
int incident_face(const Placed& hull, int support, const Vec3<S>& reference_normal) {
  int best = hull.half_edge(at(hull.hull.vertex_edges, support)).face;
  S least = std::numeric_limits<S>::infinity();
  for (const int edge : hull.hull.around_vertex(support)) {
    const int face = hull.half_edge(edge).face;
    const S along = reference_normal.dot(hull.normal(face));
    if (along < least) {
      least = along;
      best = face;
    }
  }
  return best;
}

template <class Reference, class Other, class S>
S create_face_contact(const Reference& hull, const Other& other_hull, Owner reference,
                      const FaceQuery<S>& query, int incident, S scale, S margin,
                      Contact<S>& contact, Recorder<S>* recorder) {
  const Plane<S> plane = hull.plane(query.face);

  ClipPolygon<S> polygon;
  ClipPolygon<S> spare;
  face_polygon(other_hull, other(reference), incident, polygon);
  if (recorder) [[unlikely]] {
    face_polygon(hull, reference, query.face, spare);
    recorder->clip_begins(reference, ClipFace<S>{query.face, plane.normal, spare},
                          ClipFace<S>{incident, other_hull.normal(incident), polygon});
    recorder->incident_decision(other_hull, query.support, plane.normal, incident);
  }
  const S thickness = clip_thickness(scale);
  // The side planes in the order of the face's edges. All at once, before the first clip: their square
  // roots and divisions then overlap, where between clips each would wait for the branches of the
  // last one.
  StaticVector<std::pair<Plane<S>, EdgeKey>, kMaxFaceVertices> sides;
  for (const int edge : hull.hull.around_face(query.face))
    sides.push_back({side_plane(hull, edge), edge_key(reference, edge)});
  ClipPolygon<S>* clipped = &polygon;
  ClipPolygon<S>* next = &spare;
  for (const auto& [side, edge] : sides) {
    if (clip(*clipped, side, edge, thickness, *next)) std::swap(clipped, next);
    if (recorder) [[unlikely]]
      recorder->clip_step(side, *clipped);
    // A record shows every side plane, also after nothing is left.
    if (!recorder && clipped->empty()) break;
  }

  contact.axis = reference == Owner::A ? AxisKind::FaceA : AxisKind::FaceB;
  contact.normal = reference == Owner::A ? plane.normal : Vec3<S>(-plane.normal);
  contact.points.clear();
  S deepest = std::numeric_limits<S>::infinity();
  for (const ClipVertex<S>& vertex : *clipped) {
    const S separation = plane.distance(vertex.position);
    if (separation <= margin) {
      const Vec3<S> moved = vertex.position - separation * plane.normal;
      contact.points.push_back({moved, separation, vertex.crossing.id()});
      deepest = separation < deepest ? separation : deepest;
    } else if (recorder) [[unlikely]] {
      recorder->dropped(vertex.position, "above the reference face");
    }
  }
  contact.type = face_contact_type(contact.points.size());
  return deepest;
}

template <class S>
S create_face_contact(const HullPair<S>& pair, Owner reference, const FaceQuery<S>& query, S margin,
                      Contact<S>& contact, Recorder<S>* recorder) {
  const PlacedHull<S>& hull = hull_of(pair, reference);
  const PlacedHull<S>& other_hull = hull_of(pair, other(reference));
  const int incident = incident_face(other_hull, query.support, hull.normal(query.face));
  return create_face_contact(hull, other_hull, reference, query, incident, pair.scale, margin,
                             contact, recorder);
}

template <class S>
ContactPoint<S> support_contact(const HullPair<S>& pair, Owner reference, const FaceQuery<S>& query,
                                Recorder<S>* recorder) {
  const PlacedHull<S>& other_hull = hull_of(pair, other(reference));
  const Plane<S> plane = hull_of(pair, reference).plane(query.face);
  const int incident = incident_face(other_hull, query.support, plane.normal);
  const Vec3<S> support = other_hull.vertices[query.support];
  if (recorder) [[unlikely]]
    recorder->dropped(support, "cut off by the side planes; kept as the deepest point");

  const Owner owner = other(reference);
  const FeatureId id = corner_id(other_hull, owner, incident, query.support);
  return {support - query.separation * plane.normal, query.separation, id};
}

#define CONTACTSCOPE_INSTANTIATE(S)                                                               \
  template S create_face_contact(const HullPair<S>&, Owner, const FaceQuery<S>&, S, Contact<S>&,  \
                                 Recorder<S>*);                                                   \
  template S create_face_contact(const PlacedFeatures<S, false>&, const PlacedFeatures<S, true>&, \
                                 Owner, const FaceQuery<S>&, int, S, S, Contact<S>&,              \
                                 Recorder<S>*);                                                   \
  template S create_face_contact(const PlacedFeatures<S, true>&, const PlacedFeatures<S, false>&, \
                                 Owner, const FaceQuery<S>&, int, S, S, Contact<S>&,              \
                                 Recorder<S>*);                                                   \
  template ContactPoint<S> support_contact(const HullPair<S>&, Owner, const FaceQuery<S>&,        \
                                           Recorder<S>*);                                         \
  template int incident_face(const PlacedHull<S>&, int, const Vec3<S>&);                          \
  template int incident_face(const PlacedFeatures<S, false>&, int, const Vec3<S>&);               \
  template int incident_face(const PlacedFeatures<S, true>&, int, const Vec3<S>&);
CONTACTSCOPE_INSTANTIATE(float)
CONTACTSCOPE_INSTANTIATE(double)
#undef CONTACTSCOPE_INSTANTIATE

}  // namespace contactscope
