#pragma once

#include "core/convex_polygon.h"
#include "manifold/incremental.h"
#include "query/hull_feature.h"
#include "query/penetration.h"
#include "query/tolerance.h"

namespace contactscope {

/// The core of a shape, own frame. Sphere: the centre; capsule: the segment; for both the margin is
/// the radius. Hull: the result of core_hull(). A half-space is its own core, margin 0.
template <class S> struct ShapeCore {
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
template <class S> struct CoreContact {
  Vec3<S> on_a, on_b;
  CoreFeature feature_a, feature_b;  // the smallest features that contain the points
};

/// Result for two cores in one frame. In A's frame.
template <class S> struct CoreQuery {
  bool overlap = false;               // the cores meet; `method` measured the depth
  Vec3<S> normal = Vec3<S>::UnitX();  // unit, from A to B
  S distance = 0;                     // metres, of the cores along the normal; negative in overlap
  AxisKind axis = AxisKind::ClosestPoints;
  CoreContact<S> closest;     // one of the closest
  S scale = 1;                // metres: upper bound of the coordinates
  PenetrationResult<S> deep;  // result of `method`, for cores that meet
};

/// Beyond this angle from a face's normal, a normal is a different one, whatever the rounding.
template <class S> constexpr S kLargestSnap = S(0.01);

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
template <class S> int core_face_along(const Hull<S>& hull, const Vec3<S>& direction, S sine) {
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
  const SupportSet<S> set_a = a.support(), set_b = b.support();
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

/// Maximum number of corners of the patch on which two cores are closest.
inline constexpr std::size_t kMaxPatchPoints = 128;
template <class S> using CorePatch = StaticVector<CoreContact<S>, kMaxPatchPoints>;

/// A vertex of a core, in A's frame and projected along the normal.
template <class S> struct PatchCorner {
  int vertex;
  Vec3<S> place;
  Vec2<S> seen;
};

/// The vertices of a core that are farthest along a direction, within rounding: the corners of its
/// support feature in order: one, two, or more counter-clockwise; without points on edges.
template <class S> using SupportFeature = std::vector<PatchCorner<S>>;

/// `towards` is unit, in A's frame; `core_in_a` places the core there.
template <class S>
SupportFeature<S> support_feature(const ShapeCore<S>& core, const Pose<S>& core_in_a,
                                  const Vec3<S>& towards, const PlaneFrame<S>& frame, S tie) {
  const Vec3<S> local = core_in_a.inverse_rotate(towards);
  const S farthest = local.dot(core.vertex(support_index(core.support(), local)));
  SupportFeature<S> feature;
  for (int i = 0; i < core.count(); ++i) {
    if (local.dot(core.vertex(i)) < farthest - tie) continue;
    const Vec3<S> place = core_in_a.transform(core.vertex(i));
    feature.push_back({i, place, frame.seen(place)});
  }
  if (feature.size() <= 2) return feature;
  using Corner = PatchCorner<S>;
  std::ranges::sort(feature, {}, [](const Corner& corner) {
    return std::tuple(corner.seen.x(), corner.seen.y());
  });
  return convex_chain(feature, [tie](const Corner& a, const Corner& b, const Corner& c) {
    const Vec2<S> edge = b.seen - a.seen;
    return cross(edge, c.seen - b.seen) > tie * edge.norm();
  });
}

/// The number of edges of a support feature: none for a vertex, one for an edge.
template <class S> std::size_t edge_count(const SupportFeature<S>& feature) {
  return feature.size() > 2 ? feature.size() : feature.size() / 2;
}

/// Whether a point is within `tolerance` of the feature, projected along the normal.
template <class S> bool holds(const SupportFeature<S>& feature, const Vec2<S>& point, S tolerance) {
  const Vec2<S> from_first = point - feature[0].seen;
  if (feature.size() == 1) return from_first.norm() <= tolerance;
  if (feature.size() == 2) {
    const Vec2<S> along = feature[1].seen - feature[0].seen;
    const S squared = along.squaredNorm();
    const S t = squared > S(0) ? std::clamp(from_first.dot(along) / squared, S(0), S(1)) : S(0);
    return Vec2<S>(from_first - t * along).norm() <= tolerance;
  }
  for (std::size_t i = 0; i < feature.size(); ++i) {
    const Vec2<S>& from = feature[i].seen;
    const Vec2<S> along = feature[(i + 1) % feature.size()].seen - from;
    if (cross(along, point - from) < -tolerance * along.norm()) return false;
  }
  return true;
}

/// The edge of a hull between two of its vertices, half-edge / 2; -1 if there is none.
template <class S> int edge_between(const Hull<S>& hull, int one, int other) {
  for (const int edge : hull.around_vertex(one))
    if (at(hull.half_edges, Hull<S>::twin(edge)).origin == other) return edge / 2;
  return -1;
}

/// The core's feature spanned by these corners. `outward` in the core's frame.
template <class S>
CoreFeature spanned(const ShapeCore<S>& core, const SupportFeature<S>& feature,
                    const Vec3<S>& outward) {
  if (feature.size() == 1) return {FeatureKind::Vertex, feature[0].vertex};
  if (core.kind != ShapeKind::Hull) return {FeatureKind::Edge, 0};
  if (feature.size() == 2) {
    const int edge = edge_between(core.hull, feature[0].vertex, feature[1].vertex);
    if (edge >= 0) return {FeatureKind::Edge, edge};
  }
  int best = 0;
  for (int face = 1; face < core.hull.face_count(); ++face) {
    const auto along = [&](int i) { return at(core.hull.planes, i).normal.dot(outward); };
    if (along(face) > along(best)) best = face;
  }
  return {FeatureKind::Face, best};
}

/// The edge from corner `i` to the next: its own index, or `whole` if it has none.
template <class S>
CoreFeature edge_of(const ShapeCore<S>& core, const SupportFeature<S>& feature, std::size_t i,
                    const CoreFeature& whole) {
  if (core.kind != ShapeKind::Hull) return {FeatureKind::Edge, 0};
  const int edge =
      edge_between(core.hull, feature[i].vertex, feature[(i + 1) % feature.size()].vertex);
  return edge >= 0 ? CoreFeature{FeatureKind::Edge, edge} : whole;
}

template <class S> auto order_of(const CoreContact<S>& contact) {
  return std::tuple(contact.feature_a.kind, contact.feature_a.index, contact.feature_b.kind,
                    contact.feature_b.index);
}

/// Calls visit(place, i, j) where A's edge i crosses B's edge j, projected along the normal.
template <class S, class Visit>
void for_each_crossing(const SupportFeature<S>& on_a, const SupportFeature<S>& on_b, S tolerance,
                       const Visit& visit) {
  for (std::size_t i = 0; i < edge_count(on_a); ++i) {
    const PatchCorner<S>& from = on_a[i];
    const PatchCorner<S>& to = on_a[(i + 1) % on_a.size()];
    const Vec2<S> along_a = to.seen - from.seen;
    for (std::size_t j = 0; j < edge_count(on_b); ++j) {
      const Vec2<S>& start = on_b[j].seen;
      const Vec2<S> along_b = on_b[(j + 1) % on_b.size()].seen - start;
      const S determinant = cross(along_a, along_b);
      const S rounding = tolerance * std::max(along_a.norm(), along_b.norm());
      if (!(std::abs(determinant) > rounding)) continue;  // parallel: their ends suffice
      const Vec2<S> between = start - from.seen;
      const S t = cross(between, along_b) / determinant, s = cross(between, along_a) / determinant;
      if (t < S(0) || t > S(1) || s < S(0) || s > S(1)) continue;
      visit(Vec3<S>(from.place + t * Vec3<S>(to.place - from.place)), i, j);
    }
  }
}

/// All points where the cores are as close as in `query`, within rounding: for parallel features
/// the corners of the shared patch, projected along the normal; otherwise one. Each is identified
/// by the two features that meet there, which are unique. At least one; sorted by features.
template <class S>
CorePatch<S> closest_patch(const ShapeCore<S>& a, const ShapeCore<S>& b, const Pose<S>& b_in_a,
                           const CoreQuery<S>& query) {
  // Four ties: both normals and both poses have been rounded.
  const S tie = S(4) * tie_tolerance(query.scale);
  const S aside = S(4) * tie;
  const Vec3<S> offset = query.distance * query.normal;
  const PlaneFrame<S> frame(query.closest.on_a, query.normal);
  CorePatch<S> patch;
  const auto add = [&](const CoreContact<S>& contact) {
    const bool is_known = std::ranges::any_of(patch, [&](const CoreContact<S>& known) {
      const Vec2<S> separation = frame.seen(known.on_a) - frame.seen(contact.on_a);
      return separation.norm() <= aside || order_of(known) == order_of(contact);
    });
    if (!is_known && patch.size() < patch.capacity()) patch.push_back(contact);
  };

  const bool on_plane = b.kind == ShapeKind::Plane;
  const Vec3<S> against = -query.normal;
  const SupportFeature<S> on_a = support_feature(a, Pose<S>(), query.normal, frame, tie);
  const SupportFeature<S> on_b =
      on_plane ? SupportFeature<S>() : support_feature(b, b_in_a, against, frame, tie);
  const CoreFeature whole_a = spanned(a, on_a, query.normal);
  const CoreFeature whole_b = on_plane ? CoreFeature{FeatureKind::Face, 0}
                                       : spanned(b, on_b, b_in_a.inverse_rotate(against));
  for (const PatchCorner<S>& corner : on_a)
    if (on_plane || holds(on_b, corner.seen, aside))
      add({corner.place, corner.place + offset, {FeatureKind::Vertex, corner.vertex}, whole_b});
  for (const PatchCorner<S>& corner : on_b)
    if (holds(on_a, corner.seen, aside))
      add({corner.place - offset, corner.place, whole_a, {FeatureKind::Vertex, corner.vertex}});
  for_each_crossing(on_a, on_b, aside, [&](const Vec3<S>& place, std::size_t i, std::size_t j) {
    add({place, place + offset, edge_of(a, on_a, i, whole_a), edge_of(b, on_b, j, whole_b)});
  });
  if (patch.empty()) add(query.closest);
  std::ranges::sort(patch, {}, order_of<S>);
  return patch;
}

}  // namespace contactscope
