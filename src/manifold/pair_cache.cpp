#include "manifold/pair_cache.h"

#include "manifold/contact_depth.h"
#include "manifold/create_contact.h"
#include "manifold/edge_contact.h"
#include "manifold/recorder.h"

namespace contactscope {
namespace {

/// How much worse than the kept axis another must be to be ignored, as a fraction of the smaller
/// radius. A pair that has moved this far gets a full test.
template <class S> constexpr S kHorizon = S(0.2);

/// Two hulls whose features are placed on demand.
template <class S> struct FeaturePair {
  FeaturePair(const Hull<S>& hull_a, const Hull<S>& hull_b, const Pose<S>& b_in_a)
      : rotation(b_in_a.rotation.toRotationMatrix()),
        position(b_in_a.position),
        a(hull_a, rotation, position),
        b(hull_b, rotation, position) {}

  Mat3<S> rotation;
  Vec3<S> position;
  PlacedFeatures<S, false> a;
  PlacedFeatures<S, true> b;
};

/// The kept axis at the new pose. `separation` is valid for any direction, whatever the features:
/// it is that of the support points of both hulls.
template <class S> struct MeasuredAxis {
  Vec3<S> normal;  // unit, from A to B
  S separation;
  FaceQuery<S> face;  // of a face axis
  int incident = -1;  // of a face axis whose contact was made: face of the other hull
  EdgeQuery<S> edge;  // of an edge axis
  S beyond = 0;       // metres: how far an edge axis's edges are from being the support
};

/// The vertex of a hull that is farthest along a direction.
template <class S, bool kMoved>
int support_of(const PlacedFeatures<S, kMoved>& placed, const Vec3<S>& direction) {
  const SupportSet<S> set = support_set(placed.hull);
  if constexpr (kMoved) return support_index(set, Vec3<S>(placed.rotation.transpose() * direction));
  return support_index(set, direction);
}

/// Whether the support of a hull along `direction` (its own frame, unit, perpendicular to the edge)
/// is certainly this edge: on the Gauss map the direction is on the edge's arc, between the normals
/// of its faces and nearer to their middle than the ends are, by more than rounding.
template <class S> bool supports_along(const Hull<S>& hull, int edge, const Vec3<S>& direction) {
  const auto normal = [&](int half_edge) -> const Vec3<S>& {
    return at(hull.planes, at(hull.half_edges, half_edge).face).normal;
  };
  const Vec3<S>& left = normal(edge);
  const Vec3<S>& right = normal(Hull<S>::twin(edge));
  const S of_direction = direction.dot(left) + direction.dot(right);
  return of_direction > S(1) + left.dot(right) + S(32) * std::numeric_limits<S>::epsilon();
}

/// The normal has the direction of `outward` (A's frame) rather than the opposite. False if the
/// edges are so nearly parallel that their cross product is unreliable (see kNoisySine).
template <class S>
bool measure_edges(const FeaturePair<S>& pair, int edge_a, int edge_b, const Vec3<S>& outward,
                   MeasuredAxis<S>& axis) {
  const Vec3<S> cross = pair.a.direction(edge_a).cross(pair.b.direction(edge_b));
  const S sine = cross.norm();
  if (!(sine >= kNoisySine<S>)) return false;
  axis.normal = cross * ((cross.dot(outward) >= S(0) ? S(1) : S(-1)) / sine);
  const Vec3<S> between = pair.b.origin(edge_b) - pair.a.origin(edge_a);
  axis.edge = {edge_a, edge_b, axis.normal.dot(between), axis.normal};
  const Vec3<S> to_a = pair.rotation.transpose() * Vec3<S>(-axis.normal);
  if (axis.edge.separation <= S(0) && supports_along(pair.a.hull, edge_a, axis.normal) &&
      supports_along(pair.b.hull, edge_b, to_a)) {
    axis.separation = axis.edge.separation;
    return true;
  }
  const S most_a = axis.normal.dot(pair.a.vertex(support_of(pair.a, axis.normal)));
  const S least_b = axis.normal.dot(pair.b.vertex(support_index(support_set(pair.b.hull), to_a)));
  axis.separation = least_b - most_a;
  axis.beyond = axis.edge.separation - axis.separation;
  if (axis.edge.separation > S(0)) axis.edge.separation = axis.separation;  // as query_edges does
  return true;
}

/// Result of `visit(reference, other)`, where `reference` owns the face of a face axis.
template <class S, class Visit>
auto from_reference(const FeaturePair<S>& pair, AxisKind axis, const Visit& visit) {
  return axis == AxisKind::FaceA ? visit(pair.a, pair.b) : visit(pair.b, pair.a);
}

template <class S>
bool measure(const FeaturePair<S>& pair, const PairCache<S>& cache, S moved,
             MeasuredAxis<S>& axis) {
  if (cache.axis == AxisKind::EdgeEdge)
    return measure_edges(pair, cache.first, cache.second, cache.normal, axis);
  axis.normal = from_reference(pair, cache.axis, [&](const auto& reference, const auto& other) {
    const Plane<S> plane = reference.plane(cache.first);
    // Along the face's normal no vertex has moved by more than the pair has.
    const bool still_deepest = S(2) * moved < cache.support_clearance;
    const int support = still_deepest ? cache.support : support_of(other, Vec3<S>(-plane.normal));
    // As in the face query, bit for bit.
    const Vec3<S>&n = plane.normal, p = other.vertex(support);
    axis.separation = dot(n.x(), n.y(), n.z(), p.x(), p.y(), p.z()) - plane.offset;
    axis.face = {cache.first, support, axis.separation};
    return plane.normal;
  });
  if (cache.axis == AxisKind::FaceB) axis.normal = -axis.normal;
  return true;
}

/// Whether the cache may belong to these hulls; if so, its indices are valid for them.
template <class S> bool belongs_to(const PairCache<S>& cache, const Hull<S>& a, const Hull<S>& b) {
  if (cache.radius_a != a.radius || cache.radius_b != b.radius) return false;
  const auto first = static_cast<std::size_t>(cache.first);
  if (cache.axis == AxisKind::FaceA) return first < a.planes.size();
  if (cache.axis == AxisKind::FaceB) return first < b.planes.size();
  return first < a.half_edges.size() &&
         static_cast<std::size_t>(cache.second) < b.half_edges.size();
}

/// How far the pair has moved since the full test.
template <class S> struct Motion {
  S farthest;  // metres: of any point of one hull, seen from the other
  S turn;      // length of the change of any unit vector of one, seen from the other
};

template <class S>
Motion<S> motion_since(const PairCache<S>& cache, const FeaturePair<S>& pair,
                       const Quat<S>& rotation) {
  const S turn = turn_since(cache, rotation);
  const Vec3<S> center_b = pair.rotation * pair.b.hull.centroid + pair.position;
  const Vec3<S> center_a =
      pair.rotation.transpose() * Vec3<S>(pair.a.hull.centroid - pair.position);
  const S of_b = Vec3<S>(center_b - cache.center_b).norm() + turn * pair.b.hull.radius;
  const S of_a = Vec3<S>(center_a - cache.center_a).norm() + turn * pair.a.hull.radius;
  return {std::max(of_a, of_b), turn};
}

/// Makes the kept axis's contact at the new pose, where both hulls have turned by at most `turn`.
/// Returns its bound for all near axes: of the separation along unit directions whose cosine with
/// the normal is at least `near_cosine`.
template <class S>
S rebuild(const FeaturePair<S>& pair, const PairCache<S>& cache, MeasuredAxis<S>& axis, S turn,
          S near_cosine, S scale, S margin, Contact<S>& contact, Recorder<S>* recorder) {
  S deepest;   // separation of the deepest point
  S slip = 0;  // metres between its points on the two hulls, along the contact plane
  if (cache.axis == AxisKind::EdgeEdge) {
    const ClosestPoints<S> closest = closest_points(pair.a, pair.b, axis.edge);
    create_edge_contact(closest, axis.edge, contact);
    const Vec3<S> between = closest.on_b - closest.on_a;
    deepest = between.dot(axis.normal);
    slip = Vec3<S>(between - deepest * axis.normal).norm();
  } else {
    const FaceQuery<S>& query = axis.face;
    const Owner owner = cache.axis == AxisKind::FaceA ? Owner::A : Owner::B;
    const bool still_incident =
        query.support == cache.support && S(2) * turn < cache.incident_clearance;
    deepest = from_reference(pair, cache.axis, [&](const auto& reference, const auto& other) {
      axis.incident = still_incident
                          ? cache.incident
                          : incident_face(other, query.support, reference.normal(query.face));
      return create_face_contact(reference, other, owner, query, axis.incident, scale, margin,
                                 contact, recorder);
    });
  }
  return (deepest < S(0) ? deepest * near_cosine : deepest) + slip;
}

/// The separation along the incident face of a face axis's contact; -infinity without one.
template <class S> S along_incident(const FeaturePair<S>& pair, AxisKind axis, int incident) {
  if (incident < 0) return -std::numeric_limits<S>::infinity();
  return from_reference(pair, axis, [&](const auto& reference, const auto& other) {
    const Plane<S> plane = other.plane(incident);
    return plane.distance(reference.vertex(support_of(reference, Vec3<S>(-plane.normal))));
  });
}

/// The separation along the cross product of two edges; -infinity if unreliable, or without edges.
template <class S> S along_edges(const FeaturePair<S>& pair, const std::pair<int, int>& edges) {
  const auto& [edge_a, edge_b] = edges;
  const Hull<S>& a = pair.a.hull;
  const auto normal = [&](int half_edge) -> const Vec3<S>& {
    return at(a.planes, at(a.half_edges, half_edge).face).normal;
  };
  MeasuredAxis<S> axis;
  return edge_a >= 0 && measure_edges(pair, 2 * edge_a, 2 * edge_b,
                                      Vec3<S>(normal(2 * edge_a) + normal(2 * edge_a + 1)), axis)
             ? axis.separation
             : -std::numeric_limits<S>::infinity();
}

}  // namespace

/// Steps: measure the axis; done if it separates. Otherwise, if features were kept, bound the far
/// axes by the pair's motion, rebuild the contact, and bound the near axes by it.
template <class S>
CacheAnswer<S> collide_from_cache(const Hull<S>& a, const Hull<S>& b, const Pose<S>& b_in_a,
                                  const CollideOptions& options, const PairCache<S>& cache,
                                  Contact<S>& contact, Recorder<S>* recorder) {
  CacheAnswer<S> answer;
  if (cache.kind == CachedKind::Empty || !belongs_to(cache, a, b)) return answer;
  answer.kind = cache.kind;
  answer.axis = cache.axis;

  const FeaturePair<S> pair(a, b, b_in_a);
  const bool features = cache.kind == CachedKind::Features;
  const Motion<S> motion =
      features ? motion_since(cache, pair, b_in_a.rotation) : Motion<S>{S(0), S(0)};
  MeasuredAxis<S> axis;
  if (!measure(pair, cache, motion.farthest, axis)) return answer;
  answer.normal = axis.normal;
  answer.separation = axis.separation;
  const S margin = static_cast<S>(options.margin);
  if (axis.separation > margin) {  // still, or now, a separating axis
    answer.kind = CachedKind::SeparatingAxis;
    answer.hit = true;
    contact.points.clear();
    return answer;
  }
  answer.moved = motion.farthest;
  if (!features || options.preference != Preference::Relative) return answer;

  const S scale =
      a.centroid.norm() + a.radius + b.centroid.norm() + b.radius + pair.position.norm();
  const S min_radius = std::min(a.radius, b.radius);
  const S rounding = depth_rounding(scale);
  const S far_bound = cache.far + motion.farthest + rounding;
  if (!preferred(axis.separation, far_bound, margin, min_radius)) return answer;
  if (!(axis.beyond <= rounding)) return answer;  // these edges no longer cross on the Gauss map

  // A face's normal is fixed in its own hull; a cross product may turn more than the hulls do.
  const bool on_face = cache.axis != AxisKind::EdgeEdge;
  const S swing = motion.turn + (on_face ? S(0) : Vec3<S>(axis.normal - cache.normal).norm());
  const S near_bound = rebuild(pair, cache, axis, motion.turn, cache.near_cosine - swing, scale,
                               margin, contact, recorder);
  const S bound = std::max(far_bound, near_bound);
  answer.hit = !contact.points.empty() && preferred(axis.separation, bound, margin, min_radius) &&
               is_still_deep(
                   cache, contact.deepest(), axis.separation, motion.farthest, scale,
                   [&] { return along_incident(pair, cache.axis, axis.incident); },
                   [&] { return along_edges(pair, edges_at_deepest(contact.points)); });
  if (recorder && !answer.hit) [[unlikely]]
    recorder->clip_abandoned();
  return answer;
}

/// Stores a face axis's support vertex and incident face, and their clearance from the next.
template <class S>
void note_features(const PlacedHull<S>& reference, const PlacedHull<S>& other_hull,
                   const FaceQuery<S>& query, S rounding, PairCache<S>& cache) {
  const Plane<S> plane = reference.plane(query.face);
  S next = std::numeric_limits<S>::infinity();
  for (int v = 0; v < other_hull.vertices.count(); ++v)
    if (v != query.support) next = std::min(next, plane.distance(other_hull.vertices[v]));
  cache.support = query.support;
  cache.support_clearance = next - query.separation - rounding;

  cache.incident = incident_face(other_hull, query.support, plane.normal);
  next = std::numeric_limits<S>::infinity();
  for (const int edge : other_hull.hull.around_vertex(query.support)) {
    const int face = other_hull.half_edge(edge).face;
    if (face != cache.incident) next = std::min(next, plane.normal.dot(other_hull.normals[face]));
  }
  cache.incident_clearance = next - plane.normal.dot(other_hull.normals[cache.incident]) -
                             S(32) * std::numeric_limits<S>::epsilon();
}

template <class S>
PairCache<S> cache_of(const HullPair<S>& pair, const Pose<S>& b_in_a, const CollideOptions& options,
                      const SatResult<S>& axes, const FaceSeparations<S>& faces_a,
                      const FaceSeparations<S>& faces_b, const Contact<S>& contact) {
  const Hull<S>&a = pair.a.hull, &b = pair.b.hull;
  const bool touching = axes.status == SatStatus::Touching;
  PairCache<S> cache;
  cache.radius_a = a.radius;
  cache.radius_b = b.radius;
  cache.axis = touching ? contact.axis : axes.chosen;
  if (cache.axis == AxisKind::EdgeEdge) {
    cache.first = axes.edge.edge_a;
    cache.second = axes.edge.edge_b;
    cache.normal = axes.edge.normal;
  } else if (cache.axis == AxisKind::FaceA) {
    cache.first = axes.face_a.face;
    cache.normal = pair.a.normals[cache.first];
  } else {
    cache.first = axes.face_b.face;
    cache.normal = -pair.b.normals[cache.first];
  }
  if (!touching) {
    cache.kind = CachedKind::SeparatingAxis;
    return cache;
  }
  if (contact.points.empty() || options.preference != Preference::Relative) return cache;
  if (a.flat()) return cache;  // far_separation follows arcs of less than half a turn

  // The angle within which the kept axis is preferred to any other. About half of what the
  // preference can spare goes to the angle; the rest is left for turning and a growing overlap.
  // Depth lost by clipping is already subtracted.
  const S separation = axes.separation(cache.axis);
  const S depth = std::max(-separation, S(0));
  const S tolerance = preference_tolerance(depth, pair.min_radius);
  const S spare = tolerance - std::max(contact.deepest() - separation, S(0));
  cache.near_cosine = S(1) - S(0.6) * spare / (depth + tolerance);
  if (!(spare > S(0))) return cache;
  cache.best = axes.separation(axes.deepest);
  cache.far = far_separation(pair, faces_a, faces_b, cache.normal, cache.near_cosine,
                             separation - kHorizon<S> * pair.min_radius, separation + tolerance);
  if (!preferred(separation, cache.far, static_cast<S>(options.margin), pair.min_radius))
    return cache;
  cache.kind = CachedKind::Features;
  const S rounding = depth_rounding(pair.scale);
  if (cache.axis == AxisKind::FaceA)
    note_features(pair.a, pair.b, axes.face_a, rounding, cache);
  else if (cache.axis == AxisKind::FaceB)
    note_features(pair.b, pair.a, axes.face_b, rounding, cache);
  cache.rotation = b_in_a.rotation;
  cache.center_b = pair.b.rotation * b.centroid + b_in_a.position;
  cache.center_a = pair.b.rotation.transpose() * Vec3<S>(a.centroid - b_in_a.position);
  return cache;
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(collide_from_cache, cache_of);

}  // namespace contactscope
