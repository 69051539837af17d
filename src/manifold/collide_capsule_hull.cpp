#include "manifold/collide_pairs.h"
#include "manifold/round_contact.h"
#include "query/closest_points.h"
#include "query/tolerance.h"

namespace contactscope {
namespace {

/// A point of the segment that makes a contact point, in the hull's frame.
template <class S> struct CorePoint {
  S parameter;
  S distance;  // from the hull along the normal, negative in overlap
  FeatureId id;
};

/// One or two points, the deepest first up to rounding.
template <class S> struct CorePoints {
  StaticVector<CorePoint<S>, 2> points;
  ContactType type;
};

/// The point of a segment at a parameter, from its nearer end, which is exact.
template <class S, class Ends> Vec3<S> segment_point(const Ends& ends, S parameter) {
  const Vec3<S> along = ends[1] - ends[0];
  if (parameter <= S(0.5)) return ends[0] + parameter * along;
  return ends[1] - (S(1) - parameter) * along;
}

/// The segment and the hull that it touches.
template <class S> struct TouchingPair {
  const Hull<S>& hull;
  const Vec3<S> (&ends)[2];
  Vec3<S> along;
  S length;
  S scale;
  S merging;  // metres: points of the segment this close are merged

  bool are_one(S parameter, S other) const {
    return std::abs(parameter - other) * length <= merging;
  }
};

/// Two points closer than this times the capsule's radius are merged, even on a face so large that
/// rounding at its corners is more: the segment's ends are exact.
template <class S> constexpr S kOnePoint = S(0.01);

template <class S>
CorePoint<S> face_point(const TouchingPair<S>& pair, const ClippedSegment<S>& clipped, int face,
                        int end) {
  const S parameter = clipped.parameters[end];
  const int cut_by = clipped.edges[end];
  return {parameter, at(pair.hull.planes, face).distance(segment_point(pair.ends, parameter)),
          clip_id(end, cut_by, face_ref(Owner::B, face), edge_ref(Owner::B, cut_by / 2))};
}

/// The deeper one first; if equal up to rounding, the one nearer to the capsule's first end.
template <class S> void in_order(CorePoint<S>& first, CorePoint<S>& second, S scale) {
  if (second.distance < first.distance - tie_tolerance(scale)) std::swap(first, second);
}

/// Talk, "Capsule vs Hull: Deep Face Contact" and "Clipping": both ends of the clipped segment,
/// each with its own distance from the face.
template <class S>
CorePoints<S> points_on_face(const TouchingPair<S>& pair, const CapsuleTouch<S>& touch, S reach) {
  CorePoint<S> first = face_point(pair, touch.clipped, touch.feature.index, 0);
  CorePoint<S> second = face_point(pair, touch.clipped, touch.feature.index, 1);
  in_order(first, second, pair.scale);
  CorePoints<S> result;
  result.points.push_back(first);
  const bool is_one = pair.are_one(first.parameter, second.parameter);
  if (!is_one && second.distance <= reach) result.points.push_back(second);
  result.type = face_contact_type(result.points.size());
  return result;
}

/// Calls visit(half_edge) for both half-edges of the edge, or for all that leave the vertex.
template <class S, class Visit>
void for_each_edge(const Hull<S>& hull, const HullFeature& feature, const Visit& visit) {
  if (feature.kind == FeatureKind::Edge) {
    visit(feature.index);
    visit(Hull<S>::twin(feature.index));
    return;
  }
  for (const int edge : hull.around_vertex(feature.index)) visit(edge);
}

/// The face at an edge or a vertex that is nearly aligned with the normal; -1 if there is none.
template <class S> int face_along(const Hull<S>& hull, const CapsuleTouch<S>& touch) {
  int best = -1;
  S most = S(0);
  for_each_edge(hull, touch.feature, [&](int edge) {
    const int face = at(hull.half_edges, edge).face;
    const S along = touch.normal.dot(at(hull.planes, face).normal);
    if (along > most) {
      most = along;
      best = face;
    }
  });
  if (best < 0) return -1;
  const Vec3<S> sine = touch.normal.cross(at(hull.planes, best).normal);
  constexpr S kSine = kNearlyParallelSine<S>;
  return sine.squaredNorm() <= kSine * kSine ? best : -1;
}

/// The edge (or edge at a vertex) that is nearly parallel to the segment; -1 if there is none.
template <class S> int edge_along(const TouchingPair<S>& pair, const CapsuleTouch<S>& touch) {
  int best = -1;
  S least = kNearlyParallelSine<S> * kNearlyParallelSine<S>;
  for_each_edge(pair.hull, touch.feature, [&](int edge) {
    const Vec3<S> along = pair.hull.target(edge) - pair.hull.origin(edge);
    const S squared_lengths = along.squaredNorm() * pair.length * pair.length;
    // Most edges are far from parallel, which is cheaper to detect than by a cross product.
    const S cosine = along.dot(pair.along);  // times both lengths
    if (cosine * cosine < S(0.9) * squared_lengths) return;
    const S squared_sine = along.cross(pair.along).squaredNorm();
    if (squared_sine < least * squared_lengths) {
      least = squared_sine / squared_lengths;
      best = edge;
    }
  });
  return best;
}

/// Talk, "Capsule vs Hull: Stacking": the contact normal is nearly a face's. Keeps the normal and
/// the deepest point, and adds the far end of the segment clipped by the face's side planes.
template <class S>
bool add_point_over_face(const TouchingPair<S>& pair, const CapsuleTouch<S>& touch, S reach,
                         CorePoints<S>& result) {
  const int face = face_along(pair.hull, touch);
  if (face < 0) return false;
  const ClippedSegment<S> clipped =
      clip_to_prism(pair.hull, face, pair.ends, clip_thickness(pair.scale));
  if (clipped.empty()) return false;
  const S before = touch.parameter - clipped.parameters[0];
  const S behind = clipped.parameters[1] - touch.parameter;
  CorePoint<S> far = face_point(pair, clipped, face, behind > before ? 1 : 0);
  far.distance = std::max(far.distance, touch.distance);
  // A parallel edge, within rounding, can have both the closest point and a cut.
  if (far.id == result.points[0].id || pair.are_one(far.parameter, touch.parameter)) return false;
  if (far.distance > reach) return false;
  result.points.push_back(far);
  result.type = ContactType::EdgeFace;
  return true;
}

/// Not in the talk: a capsule along an edge, outside of every face's prism, would rock on one
/// point. Along an edge's normal, edge and segment keep their distance, so both ends of the common
/// stretch are equally deep. If the segment rises from one end, that end is the deepest. At a
/// vertex the edge may fall away, and the far end is less deep by that.
template <class S>
void add_point_next_to_edge(const TouchingPair<S>& pair, const CapsuleTouch<S>& touch, S reach,
                            CorePoints<S>& result) {
  const int edge = edge_along(pair, touch);
  if (edge < 0) return;
  const ClippedSegment<S> clipped = clip_to_edge(pair.hull, edge, pair.ends);
  if (clipped.empty() || pair.are_one(clipped.parameters[0], clipped.parameters[1])) return;

  const S rise = touch.normal.dot(pair.along);
  const Vec3<S> corner = pair.hull.origin(edge);
  const Vec3<S> along_edge = pair.hull.target(edge) - corner;
  const bool at_vertex = touch.feature.kind == FeatureKind::Vertex;
  const S fall = at_vertex ? touch.normal.dot(along_edge) / along_edge.squaredNorm() : S(0);
  CorePoint<S> stretch[2];
  for (const int end : {0, 1}) {
    const S parameter = clipped.parameters[end];
    const int cut_by = clipped.edges[end];
    const int vertex = cut_by < 0 ? 0 : at(pair.hull.half_edges, cut_by).origin;
    const S of_edge =
        fall * along_edge.dot(segment_point(pair.ends, parameter) - corner);  // m, never positive
    const S distance =
        std::max(touch.distance + (parameter - touch.parameter) * rise - of_edge, touch.distance);
    stretch[end] = {
        parameter, distance,
        clip_id(end, cut_by, edge_ref(Owner::B, edge / 2), vertex_ref(Owner::B, vertex))};
  }
  in_order(stretch[0], stretch[1], pair.scale);
  const CorePoint<S>& first = result.points[0];
  if (stretch[0].distance <= first.distance + tie_tolerance(pair.scale))
    result.points[0] = stretch[0];
  if (stretch[1].id == first.id || pair.are_one(stretch[1].parameter, first.parameter)) return;
  if (stretch[1].distance <= reach) result.points.push_back(stretch[1]);
  result.type = ContactType::EdgeEdge;
}

template <class S>
CorePoints<S> points_on_edge_or_vertex(const TouchingPair<S>& pair, const CapsuleTouch<S>& touch,
                                       S reach) {
  const FeatureId id =
      FeatureId::of(axis_feature(Owner::A, touch.parameter), touch.feature.ref(Owner::B));
  CorePoints<S> result;
  result.points.push_back({touch.parameter, touch.distance, id});
  result.type = contact_type(id.first.kind, id.second.kind);
  if (!(pair.length > S(0)) || touch.feature.kind == FeatureKind::Face) return result;
  if (!add_point_over_face(pair, touch, reach, result))
    add_point_next_to_edge(pair, touch, reach, result);
  return result;
}

/// The axis is a face's if two points are on it, or if the segment itself overlaps.
template <class S> AxisKind axis_of(const CapsuleTouch<S>& touch, const CorePoints<S>& core) {
  if (touch.kind == CapsuleTouchKind::Face) {
    if (core.points.size() == 2 || touch.distance <= S(0)) return AxisKind::FaceB;
    return AxisKind::ClosestPoints;
  }
  if (touch.kind == CapsuleTouchKind::EdgePair && touch.distance <= S(0)) return AxisKind::EdgeEdge;
  return AxisKind::ClosestPoints;
}

/// To the hull; midway between two edges that have passed each other (talk, "Deep Contact").
template <class S> S distance_to_hull(const CapsuleTouch<S>& touch, const CorePoint<S>& point) {
  const bool midway = touch.kind == CapsuleTouchKind::EdgePair && touch.distance < S(0) &&
                      point.distance <= touch.distance;
  return midway ? S(0.5) * point.distance : point.distance;
}

}  // namespace

/// Talk, "Capsule vs Hull: Deep Penetration": the best face, and the best pair of the segment and an
/// edge of the hull. A test that a face wins does not name that pair, so every edge whose faces'
/// normals lie on different sides of the segment's ring is measured.
template <class S>
void Recorder<S>::capsule_axes(const Hull<S>& hull, const Pose<S>& hull_in_a,
                               const Vec3<S> (&ends)[2], const CapsuleSat<S>& axes) {
  if (!stages_.sat) return;
  trace::Sat& sat = pair_.sat.emplace();
  sat.chosen = to_string(axes.edge_wins() ? AxisKind::EdgeEdge : AxisKind::FaceB);
  const auto axis = [&](const Vec3<S>& normal) { return direction(-hull_in_a.rotate(normal)); };
  const Plane<S>& plane = at(hull.planes, axes.face);
  const int lower = plane.distance(ends[1]) < plane.distance(ends[0]) ? 1 : 0;
  sat.face_b = trace::FaceAxis{axes.face, axes.face_separation, axis(plane.normal),
                               point(hull_in_a.transform(ends[lower]))};
  const Vec3<S> along = ends[1] - ends[0];
  for (int edge = 0; edge < count_of(hull.half_edges); edge += 2) {
    const auto rise = [&](int half_edge) {
      return at(hull.planes, at(hull.half_edges, half_edge).face).normal.dot(along);
    };
    if ((rise(edge) > S(0)) == (rise(edge + 1) > S(0))) continue;
    const Vec3<S>&from = hull.origin(edge), &to = hull.target(edge);
    const Vec3<S> edge_along = to - from;
    const Vec3<S> normal =
        safe_unit(Vec3<S>(rise(edge) > S(0) ? edge_along.cross(along) : along.cross(edge_along)));
    if (normal.isZero(S(0))) continue;
    const auto separation = static_cast<double>(normal.dot(Vec3<S>(ends[0] - from)));
    if (stages_.gauss_map) sat.edge_pairs.push_back({0, edge / 2, separation, axis(normal)});
    if (axes.edge_wins() ? edge != axes.edge : sat.edge && sat.edge->separation >= separation)
      continue;
    const auto closest = closest_of_segments(ends[0], ends[1], from, to);
    sat.edge = trace::EdgeAxis{0,
                               edge / 2,
                               separation,
                               axis(normal),
                               point(hull_in_a.transform(closest.on_a)),
                               point(hull_in_a.transform(closest.on_b))};
  }
}

template <class S>
void add_capsule_touch(const Capsule<S>& a, const Hull<S>& b, const Mat3<S>& rotation,
                       const Vec3<S> (&ends)[2], const CapsuleTouch<S>& touch, S scale, S reach,
                       Contact<S>& contact) {
  const Vec3<S> along = ends[1] - ends[0];
  const S merging = std::min(touching_distance(scale), kOnePoint<S> * a.radius);
  const TouchingPair<S> pair{b, ends, along, along.norm(), scale, merging};
  const CorePoints<S> core = touch.kind == CapsuleTouchKind::Face
                                 ? points_on_face(pair, touch, reach)
                                 : points_on_edge_or_vertex(pair, touch, reach);
  contact.axis = axis_of(touch, core);
  contact.type = core.type;
  contact.normal = -(rotation * touch.normal);
  for (const CorePoint<S>& point : core.points) {
    const Vec3<S> position =
        segment_point(a.points, point.parameter) + distance_to_hull(touch, point) * contact.normal;
    contact.points.push_back({position, point.distance - a.radius, point.id});
  }
}

/// Steps: 1. separating axis test; 2. the touching feature and point (capsule_sat.h). 3. one or two
/// points, by the talk's clipping for faces; 4. to A's frame.
template <class S>
S collide_capsule_hull(const Capsule<S>& a, const Hull<S>& b, const Pose<S>& b_in_a,
                       const CollideOptions& options, Contact<S>& contact, Recorder<S>* recorder) {
  const Mat3<S> rotation = b_in_a.rotation.toRotationMatrix();
  const Vec3<S> ends[2] = {rotation.transpose() * (a.points[0] - b_in_a.position),
                           rotation.transpose() * (a.points[1] - b_in_a.position)};
  const S core_reach = std::sqrt(std::max(a.points[0].squaredNorm(), a.points[1].squaredNorm()));
  const S scale = length_scale(b, b_in_a, core_reach);
  const S reach = a.radius + static_cast<S>(options.margin);
  const CapsuleSat<S> axes = capsule_sat(b, ends, reach, tie_tolerance(scale));
  if (axes.separation() > reach) return axes.separation() - a.radius;

  const CapsuleTouch<S> touch =
      capsule_touch(b, ends, axes, scale, touching_distance(scale), gjk_run(recorder));
  if (recorder) {
    recorder->gjk(b_in_a);
    if (axes.separation() <= S(0)) recorder->capsule_axes(b, b_in_a, ends, axes);
  }
  const S separation = touch.distance - a.radius;
  if (touch.distance > reach) return separation;
  if (touch.degenerate != nullptr && skips_degenerate(touch.degenerate, options, recorder))
    return separation;
  add_capsule_touch(a, b, rotation, ends, touch, scale, reach, contact);
  return separation;
}

template void Recorder<float>::capsule_axes(const Hull<float>&, const Pose<float>&,
                                            const Vec3<float> (&)[2], const CapsuleSat<float>&);
template void Recorder<double>::capsule_axes(const Hull<double>&, const Pose<double>&,
                                             const Vec3<double> (&)[2], const CapsuleSat<double>&);
CONTACTSCOPE_FLOAT_AND_DOUBLE(add_capsule_touch, collide_capsule_hull);

}  // namespace contactscope
