#include "manifold/collide_pairs.h"
#include "manifold/round_contact.h"
#include "query/closest_points.h"
#include "query/fast/point_faces.h"
#include "query/tolerance.h"
#include "query/voronoi_region.h"

namespace contactscope {
namespace {

/// How far rounding can move the centre off the axis, metres: the centre was turned into the
/// capsule's frame, and points on an axis that is oblique there are rounded across it.
template <class S> S rounding_across(const Vec3<S>& center, const Capsule<S>& capsule) {
  const Vec3<S> along = capsule.points[1] - capsule.points[0];
  const Vec3<S> unit = safe_unit(along);
  const Vec3<S> squares = unit.cwiseAbs2();
  const S obliqueness = std::sqrt(squares.dot(Vec3<S>(Vec3<S>::Ones() - squares)));
  constexpr S kRoundings = S(8) * std::numeric_limits<S>::epsilon();
  return kRoundings * (safe_norm(center) + obliqueness * safe_norm(along));
}

/// The closest feature of the hull to the centre, in the hull's frame.
template <class S> struct Touch {
  HullFeature feature;
  S distance;      // of the centre from the feature, negative inside
  Vec3<S> normal;  // unit, from the hull outward
};

template <class S> Touch<S> touch_face(const Hull<S>& hull, int face, S distance) {
  return {{FeatureKind::Face, face}, distance, at(hull.planes, face).normal};
}

/// Perpendicular vector from an edge to a point outside, computed from the nearer vertex: its
/// rounding is then relative to the vector, not to the coordinates.
template <class S> Vec3<S> from_edge(const Hull<S>& hull, int half_edge, const Vec3<S>& point) {
  const Vec3<S> from_origin = point - hull.origin(half_edge);
  const Vec3<S> from_target = point - hull.target(half_edge);
  const Vec3<S> along = hull.target(half_edge) - hull.origin(half_edge);
  const S to_origin = from_origin.squaredNorm(), to_target = from_target.squaredNorm();
  // For two equally near vertices, the same from either half-edge.
  const bool origin_is_nearer =
      to_origin < to_target || (to_origin == to_target && half_edge % 2 != 0);
  const Vec3<S>& from = origin_is_nearer ? from_origin : from_target;
  return from - (from.dot(along) / along.squaredNorm()) * along;
}

/// The closest feature of the hull to a centre over none of its nearest faces and beyond the
/// half-edge `side_edge` of one. GJK runs only for a record, or if no Voronoi region decides.
template <class S>
Touch<S> touch_edge_or_vertex(const Hull<S>& hull, const Vec3<S>& center, int nearest_face,
                              int side_edge, S scale, GjkRun<S>* run) {
  const std::optional<HullFeature> region = voronoi_region(hull, side_edge, center, scale);
  const auto by_gjk = [&] {
    const GjkSimplex<S> start =
        simplex_near(hull, nearest_outside_edge(hull, nearest_face, center), 0);
    return feature_of_b(
        hull, gjk(support_set(center), support_set(hull), Pose<S>{}, &start, run).simplex);
  };
  HullFeature feature;
  if (!region || run != nullptr) feature = by_gjk();
  if (region) feature = *region;
  if (feature.kind == FeatureKind::Face) {
    const int face = feature.index < 0 ? nearest_face : feature.index;
    return touch_face(hull, face, at(hull.planes, face).distance(center));
  }
  const Vec3<S> outward = feature.kind == FeatureKind::Edge
                              ? from_edge(hull, feature.index, center)
                              : Vec3<S>(center - at(hull.vertices, feature.index));
  const S distance = outward.norm();
  return {feature, distance, distance > S(0) ? Vec3<S>(outward / distance) : outward};
}

}  // namespace

/// Works in the capsule's own frame, where its axis is exact. Steps: 1. the vector to the closest
/// point of the axis; 2. its direction is the normal, unless it is only rounding.
template <class S>
S collide_sphere_capsule(const Sphere<S>& a, const Capsule<S>& b, const Pose<S>& b_in_a,
                         const CollideOptions& options, Contact<S>& contact,
                         Recorder<S>* recorder) {
  const Vec3<S> center = b_in_a.inverse_transform(Vec3<S>::Zero());
  const Vec3<S> along = b.points[1] - b.points[0];
  const Vec3<S> unit = safe_unit(along);
  const ClosestOnSegment<S> closest = closest_on_segment(center, b.points[0], b.points[1]);
  const FeatureRef feature = axis_feature(Owner::B, closest.parameter, !unit.isZero(S(0)));
  Vec3<S> to_axis = closest.point - center;
  // On a long axis the point is rounded by more than the distance of a near centre.
  if (feature.kind != FeatureKind::Vertex) to_axis = rejected(to_axis, unit);
  const S distance = safe_norm(to_axis);
  const S separation = distance - (a.radius + b.radius);
  if (separation > options.margin) return separation;

  if (distance > rounding_across(center, b)) {
    contact.normal = b_in_a.rotate(safe_unit(to_axis));
  } else {
    const char* geometry = along.isZero(S(0)) ? "coincident centres" : "centre on the axis";
    if (skips_degenerate(geometry, options, recorder)) return separation;
    const Vec3<S> up = rejected(Vec3<S>(options.up.cast<S>()), b_in_a.rotate(unit));
    contact.normal = options.degenerate == Degenerate::Up && up.norm() > kNearlyParallelSine<S>
                         ? safe_unit(up)
                         : b_in_a.rotate(body_perpendicular(along));
  }
  contact.axis = AxisKind::ClosestPoints;
  contact.type = contact_type(FeatureKind::Vertex, feature.kind);
  const FeatureId id = FeatureId::of(vertex_ref(Owner::A, 0), feature);
  add_round_point(Vec3<S>(Vec3<S>::Zero()), a.radius, b_in_a.rotate(to_axis), b.radius,
                  contact.normal, distance, id, contact);
  return separation;
}

template <class S>
S collide_sphere_sphere(const Sphere<S>& a, const Sphere<S>& b, const Pose<S>& b_in_a,
                        const CollideOptions& options, Contact<S>& contact, Recorder<S>* recorder) {
  const Vec3<S>& center_b = b_in_a.position;
  const S distance = safe_norm(center_b);
  const S separation = distance - (a.radius + b.radius);
  if (separation > options.margin) return separation;

  if (distance > S(0)) {
    contact.normal = safe_unit(center_b);
  } else {
    if (skips_degenerate("coincident centres", options, recorder)) return separation;
    contact.normal = options.degenerate == Degenerate::Up ? Vec3<S>(options.up.cast<S>())
                                                          : b_in_a.rotate(Vec3<S>::UnitY());
  }
  contact.axis = AxisKind::ClosestPoints;
  contact.type = ContactType::PointPoint;
  const FeatureId id = FeatureId::of(vertex_ref(Owner::A, 0), vertex_ref(Owner::B, 0));
  add_round_point(Vec3<S>(Vec3<S>::Zero()), a.radius, center_b, b.radius, contact.normal, distance,
                  id, contact);
  return separation;
}

/// Deviation from the talk: faces first. Their distances reject most distant spheres. If the centre
/// projects into the nearest face, that is the closest point, at any height, with all digits of the
/// normal. GJK handles only edges and vertices whose regions are undecided by rounding.
///
/// Steps: 1. distances from all faces; 2. the centre inside, or above a face: that face; 3. the
/// edge or vertex whose region contains it, or GJK's; 4. on it within rounding: the face of step 1.
template <class S>
S collide_sphere_hull(const Sphere<S>& a, const Hull<S>& b, const Pose<S>& b_in_a,
                      const CollideOptions& options, Contact<S>& contact, Recorder<S>* recorder) {
  const Vec3<S> center = b_in_a.inverse_transform(Vec3<S>(Vec3<S>::Zero()));
  const S scale = length_scale(b, b_in_a, S(0));
  const S tie = tie_tolerance(scale);
  const PointFaces<S> faces(b, center);
  if (faces.largest() - a.radius > options.margin) return faces.largest() - a.radius;

  const int face = faces.nearest(tie);
  Touch<S> touch = touch_face(b, face, faces[face]);
  const char* degenerate = nullptr;
  if (touch.distance <= S(0)) {
    const bool tied = faces.is_tied(face, tie, kNearlyParallelSine<S>);
    const bool on_surface = -touch.distance <= touching_distance(scale);
    if (tied)
      degenerate = on_surface ? "centre on an edge or a vertex" : "centre as near to several faces";
  } else if (const int side_edge = outside_side(b, face, center); side_edge >= 0) {
    const Touch<S> closest =
        touch_edge_or_vertex(b, center, face, side_edge, scale, gjk_run(recorder));
    if (recorder) recorder->gjk(b_in_a);
    if (closest.distance > touching_distance(scale)) {
      touch = closest;
    } else if (closest.feature.kind != FeatureKind::Face) {
      degenerate = "centre on an edge or a vertex";
    }
  }
  const S separation = touch.distance - a.radius;
  if (separation > options.margin) return separation;
  if (degenerate != nullptr && skips_degenerate(degenerate, options, recorder)) return separation;

  contact.axis = faces.largest() > S(0) ? AxisKind::ClosestPoints : AxisKind::FaceB;
  contact.type = contact_type(FeatureKind::Vertex, touch.feature.kind);
  contact.normal = -b_in_a.rotate(touch.normal);
  // The centre is the origin of A's frame. For a centre outside, this is the hull's closest point.
  const Vec3<S> position = touch.distance * contact.normal;
  const FeatureId id = FeatureId::of(vertex_ref(Owner::A, 0), touch.feature.ref(Owner::B));
  contact.points.push_back({position, separation, id});
  return separation;
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(collide_sphere_sphere, collide_sphere_capsule, collide_sphere_hull);

}  // namespace contactscope
