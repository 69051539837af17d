#include "manifold/create_contact.h"

#include "manifold/contact_depth.h"
#include "manifold/edge_contact.h"
#include "manifold/recorder.h"

namespace contactscope {
namespace {

template <class S> const PlacedHull<S>& hull_of(const HullPair<S>& pair, Owner owner) {
  return owner == Owner::A ? pair.a : pair.b;
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
  // The side planes in the order of the face's edges, all before the first clip: their square roots
  // and divisions overlap, and do not wait for the branches of clips.
  StaticVector<std::pair<Plane<S>, EdgeKey>, kMaxFaceVertices> sides;
  for (const int edge : hull.hull.around_face(query.face))
    sides.push_back({side_plane(hull, edge), edge_key(reference, edge)});
  ClipPolygon<S>* clipped = &polygon;
  ClipPolygon<S>* next = &spare;
  for (const auto& [side, edge] : sides) {
    if (clip(*clipped, side, edge, thickness, *next)) std::swap(clipped, next);
    if (recorder) [[unlikely]]
      recorder->clip_step(side, *clipped);
    // A record shows every side plane, also once nothing is left.
    if (!recorder && clipped->empty()) break;
  }

  contact.axis = reference == Owner::A ? AxisKind::FaceA : AxisKind::FaceB;
  contact.normal = reference == Owner::A ? plane.normal : Vec3<S>(-plane.normal);
  contact.scale = scale;
  contact.points.clear();
  S deepest = std::numeric_limits<S>::infinity();
  const S highest = highest_kept(margin, scale);
  for (const ClipVertex<S>& vertex : *clipped) {
    const S distance = plane.distance(vertex.position);
    if (distance <= highest) {
      const S separation = std::min(distance, margin);
      const Vec3<S> moved = vertex.position - distance * plane.normal;
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

/// Moves the hulls along the axis by their overlap and the smaller radius, so that they are
/// separated. Their closest points (GJK) are then where the axis's separation is measured: inside
/// the reference face, or on its border if the face's axis is not the deepest.
template <class S>
ContactPoint<S> support_contact(const HullPair<S>& pair, Owner reference, const FaceQuery<S>& query,
                                Recorder<S>* recorder) {
  const PlacedHull<S>& other_hull = hull_of(pair, other(reference));
  const Plane<S> plane = hull_of(pair, reference).plane(query.face);
  const bool of_a = reference == Owner::A;
  const Vec3<S> pull =
      (of_a ? plane.normal : Vec3<S>(-plane.normal)) * (pair.min_radius - query.separation);
  const Vec3<S> position = pair.b.vertices[0] - pair.b.rotation * pair.b.hull.vertices[0];
  const GjkResult<S> separated = gjk(support_set(pair.a.hull), support_set(pair.b.hull),
                                     {Quat<S>(pair.b.rotation), Vec3<S>(position + pull)});
  const Vec3<S> on_face = of_a ? separated.on_a : Vec3<S>(separated.on_b - pull);
  if (recorder) [[unlikely]]
    recorder->dropped(of_a ? Vec3<S>(separated.on_b - pull) : separated.on_a,
                      "cut off by the side planes; kept as the deepest point");

  int vertex = of_a ? separated.simplex.vertices[0].index_b : separated.simplex.vertices[0].index_a;
  for (const GjkVertex<S>& corner : separated.simplex.vertices)
    if ((of_a ? corner.index_b : corner.index_a) != vertex) vertex = -1;
  const FeatureRef feature =
      vertex >= 0
          ? vertex_ref(other(reference), vertex)
          : face_ref(other(reference), incident_face(other_hull, query.support, plane.normal));
  return {plane.project(on_face), query.separation,
          FeatureId::of(face_ref(reference, query.face), feature)};
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

template <class S>
void create_contact(const HullPair<S>& pair, const SatResult<S>& axes,
                    const CollideOptions& options, Contact<S>& contact, Recorder<S>* recorder) {
  for (const AxisKind axis : {axes.chosen, axes.deepest}) {
    if (axis == AxisKind::EdgeEdge)
      return create_edge_contact(closest_points(pair.a, pair.b, axes.edge), axes.edge, contact);
    const Owner reference = axis == AxisKind::FaceA ? Owner::A : Owner::B;
    const FaceQuery<S>& query = reference == Owner::A ? axes.face_a : axes.face_b;
    const S deepest = create_face_contact(pair, reference, query, static_cast<S>(options.margin),
                                          contact, recorder);
    const S deepest_axis = axes.separation(axes.deepest);
    const bool overlap = deepest_axis <= S(0);
    if (!overlap || is_deep_enough(deepest, deepest_axis, options.preference, pair.scale)) return;

    // Either the support vertex is outside the side planes (beyond rounding only if the face is not
    // the deepest axis), or the clipped face is not the one that reaches below the reference face.
    if (axis == axes.deepest) {
      const ContactPoint<S> support = support_contact(pair, reference, query, recorder);
      if (contact.points.size() < contact.points.capacity()) contact.points.push_back(support);
      contact.type = face_contact_type(contact.points.size());
      return;
    }
    if (recorder) [[unlikely]]
      recorder->clip_abandoned();
  }
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(create_contact);

}  // namespace contactscope
