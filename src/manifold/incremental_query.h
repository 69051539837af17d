#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "manifold/incremental.h"
#include "query/gjk.h"
#include "query/hull_feature.h"
#include "query/penetration.h"
#include "query/tolerance.h"

namespace contactscope {

/// The core of a shape, own frame. Sphere: the centre; capsule: the segment; for both the margin is
/// the radius. Hull: the result of core_hull(). A half-space is its own core, margin 0.
template <class S>
struct ShapeCore {
  ShapeKind kind = ShapeKind::Sphere;
  S margin = 0;                            // metres
  Vec3<S> points[2];                       // for spheres (one) and capsules
  Hull<S> hull;                            // for hulls
  std::vector<FeatureRef> vertices{};      // features of the shape for those of `hull`
  std::vector<FeatureRef> edges{};         // likewise
  std::vector<FeatureRef> faces{};         // likewise
  Plane<S> plane{Vec3<S>::UnitX(), S(0)};  // for half-spaces

  /// Number of vertices; 0 for a half-space.
  int count() const {
    if (kind == ShapeKind::Hull) return hull.vertex_count();
    return kind == ShapeKind::Sphere ? 1 : kind == ShapeKind::Capsule ? 2 : 0;
  }
  const Vec3<S>& vertex(int index) const {
    return kind == ShapeKind::Hull ? at(hull.vertices, index) : points[index];
  }
  /// Not for half-spaces.
  SupportSet<S> support() const {
    if (kind == ShapeKind::Hull) return support_set(hull);
    return kind == ShapeKind::Capsule ? support_set(points) : support_set(points[0]);
  }
  /// Upper bound of the core's coordinates, metres; for a half-space the offset.
  S reach() const {
    return kind == ShapeKind::Plane ? std::abs(plane.offset) : reach_of(support());
  }
  /// The shape's feature for a feature of the core.
  FeatureRef ref(Owner owner, const CoreFeature& feature) const {
    if (kind != ShapeKind::Hull)
      return {owner, feature.kind, static_cast<std::uint32_t>(feature.index)};
    const auto& refs = feature.kind == FeatureKind::Vertex ? vertices
                       : feature.kind == FeatureKind::Edge ? edges
                                                           : faces;
    FeatureRef result = at(refs, feature.index);
    result.owner = owner;
    return result;
  }
};

/// The closest (or, of overlapping cores, deepest) points of two cores, in A's frame, metres.
template <class S>
struct CoreContact {
  Vec3<S> on_a, on_b;
  CoreFeature feature_a, feature_b;  // the smallest features that contain the points
};

/// Result for two cores in one frame. In A's frame.
template <class S>
struct CoreQuery {
  bool overlap = false;               // the cores meet; `method` measured the depth
  Vec3<S> normal = Vec3<S>::UnitX();  // unit, from A to B
  S distance = 0;                     // metres, of the cores along the normal; negative in overlap
  AxisKind axis = AxisKind::ClosestPoints;
  CoreContact<S> closest;     // one of the closest
  S scale = 1;                // metres: upper bound of the coordinates
  PenetrationResult<S> deep;  // result of `method`, for cores that meet
};

/// Beyond this angle from a face's normal, a normal is a different one, whatever the rounding.
template <class S>
constexpr S kLargestSnap = S(0.01);

template <class S>
S scale_of_cores(const ShapeCore<S>& a, const ShapeCore<S>& b, const Pose<S>& b_in_a) {
  return a.reach() + b.reach() + b_in_a.position.norm();
}

/// The smallest feature of a core that contains all of the simplex's points. `of_b`: which side.
template <class S>
CoreFeature simplex_feature(const ShapeCore<S>& core, const GjkSimplex<S>& simplex, bool of_b) {
  GjkSimplex<S> own = simplex;  // with the core's indices where feature_of_b reads them
  if (!of_b)
    for (GjkVertex<S>& vertex : own.vertices) std::swap(vertex.index_a, vertex.index_b);
  const GjkVertex<S>& vertex_0 = simplex.vertices[0];
  const int first = of_b ? vertex_0.index_b : vertex_0.index_a;
  if (core.kind != ShapeKind::Hull) {
    const bool is_vertex = std::ranges::all_of(
        own.vertices, [&](const GjkVertex<S>& vertex) { return vertex.index_b == first; });
    return is_vertex ? CoreFeature{FeatureKind::Vertex, first} : CoreFeature{FeatureKind::Edge, 0};
  }
  const HullFeature feature = feature_of_b(core.hull, own);
  if (feature.index < 0) return {FeatureKind::Vertex, first};
  return {feature.kind, feature.kind == FeatureKind::Edge ? feature.index / 2 : feature.index};
}

/// The face of a hull whose outward normal is within `sine` of `direction` (unit, own frame).
template <class S>
int core_face_along(const Hull<S>& hull, const Vec3<S>& direction, S sine) {
  int best = -1;
  S least = sine;
  for (int face = 0; face < hull.face_count(); ++face) {
    const Vec3<S>& normal = at(hull.planes, face).normal;
    if (!(normal.dot(direction) > S(0))) continue;
    const S off = normal.cross(direction).norm();
    if (off < least) {
      least = off;
      best = face;
    }
  }
  return best;
}

template <class S>
void snap_to_face(const ShapeCore<S>& a, const ShapeCore<S>& b, const Pose<S>& b_in_a,
                  CoreQuery<S>& query) {
  const S rounding = S(4) * tie_tolerance(query.scale);
  const S sine = std::min(kLargestSnap<S>, rounding / std::max(std::abs(query.distance), rounding) +
                                               S(4) * tie_tolerance(S(1)));
  int face = -1;
  if (a.kind == ShapeKind::Hull) face = core_face_along(a.hull, query.normal, sine);
  if (face >= 0) {
    query.normal = at(a.hull.planes, face).normal;
    if (query.overlap) query.axis = AxisKind::FaceA;
    return;
  }
  if (b.kind == ShapeKind::Hull)
    face = core_face_along(b.hull, Vec3<S>(-b_in_a.inverse_rotate(query.normal)), sine);
  if (face < 0) return;
  query.normal = -b_in_a.rotate(at(b.hull.planes, face).normal);
  if (query.overlap) query.axis = AxisKind::FaceB;
}

template <class S>
CoreQuery<S> query_half_space(const ShapeCore<S>& a, const ShapeCore<S>& b, const Pose<S>& b_in_a) {
  CoreQuery<S> query;
  query.scale = scale_of_cores(a, b, b_in_a);
  query.normal = -b_in_a.rotate(b.plane.normal);
  query.axis = AxisKind::FaceB;
  const int lowest = support_index(a.support(), query.normal);
  const Vec3<S>& on_a = a.vertex(lowest);
  query.distance = b.plane.distance(b_in_a.inverse_transform(on_a));
  query.closest = {on_a,
                   on_a + query.distance * query.normal,
                   {FeatureKind::Vertex, lowest},
                   {FeatureKind::Face, 0}};
  return query;
}

/// Gregorius 2015, "Building Incremental Manifolds (1)": GJK on the cores; if they overlap or
/// touch, `method`. `b` may be a half-space, which needs neither: its distance is exact at every
/// depth, and it never overlaps. `run` and `steps`: records of GJK and of `method`, or null. Empty
/// if there is no result, for example for coordinates that are not finite.
///
/// A normal within rounding of a face's is replaced by that face's. GJK computes it from points
/// near each other and loses digits in the ratio of the shapes' size to that distance.
template <class S>
std::optional<CoreQuery<S>> query_cores(const ShapeCore<S>& a, const ShapeCore<S>& b,
                                        const Pose<S>& b_in_a, PenetrationMethod method,
                                        GjkRun<S>* run, PenetrationSteps<S>* steps) {
  if (!b_in_a.position.allFinite() || !b_in_a.rotation.coeffs().allFinite()) return std::nullopt;
  if (b.kind == ShapeKind::Plane) return query_half_space(a, b, b_in_a);
  const SupportSet<S> set_a = a.support();
  const SupportSet<S> set_b = b.support();
  const GjkResult<S> result = gjk<S>(set_a, set_b, b_in_a, nullptr, run);

  CoreQuery<S> query;
  query.scale = scale_of_cores(a, b, b_in_a);
  query.normal = result.normal;
  query.distance = result.distance;
  query.closest = {result.on_a, result.on_b, simplex_feature(a, result.simplex, false),
                   simplex_feature(b, result.simplex, true)};
  if (result.status == GjkStatus::Touching || result.status == GjkStatus::Overlap) {
    const PenetrationResult<S> deep =
        penetration(method, set_a, set_b, b_in_a, PenetrationOptions<S>(), &result.simplex, steps);
    if (deep.status == PenetrationStatus::NotFinite) return std::nullopt;
    if (has_depth(deep.status)) {
      query.overlap = true;
      query.deep = deep;
      query.axis = AxisKind::EdgeEdge;  // may become a face's below
      query.normal = deep.normal;
      query.distance = -deep.depth;
      query.closest.on_a = deep.on_a;
      query.closest.on_b = deep.on_b;
    }
  }
  snap_to_face(a, b, b_in_a, query);
  return query;
}

}  // namespace contactscope
