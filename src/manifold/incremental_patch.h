#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <vector>

#include "core/convex_polygon.h"
#include "core/static_vector.h"
#include "manifold/incremental_query.h"

namespace contactscope {

/// Maximum number of corners of the patch on which two cores are closest.
inline constexpr std::size_t kMaxPatchPoints = 128;
template <class S>
using CorePatch = StaticVector<CoreContact<S>, kMaxPatchPoints>;

/// A vertex of a core, in A's frame and projected along the normal.
template <class S>
struct PatchCorner {
  int vertex;
  Vec3<S> place;
  Vec2<S> seen;
};

/// The vertices of a core that are farthest along a direction, within rounding: the corners of its
/// support feature in order: one, two, or more counter-clockwise; without points on edges.
template <class S>
using SupportFeature = std::vector<PatchCorner<S>>;

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
template <class S>
std::size_t edge_count(const SupportFeature<S>& feature) {
  return feature.size() > 2 ? feature.size() : feature.size() / 2;
}

/// Whether a point is within `tolerance` of the feature, projected along the normal.
template <class S>
bool holds(const SupportFeature<S>& feature, const Vec2<S>& point, S tolerance) {
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
template <class S>
int edge_between(const Hull<S>& hull, int one, int other) {
  for (const int edge : hull.around_vertex(one)) {
    if (at(hull.half_edges, Hull<S>::twin(edge)).origin == other) return edge / 2;
  }
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

template <class S>
auto order_of(const CoreContact<S>& contact) {
  return std::tuple(contact.feature_a.kind, contact.feature_a.index, contact.feature_b.kind,
                    contact.feature_b.index);
}

/// Calls visit(place, i, j) where edge i of A's feature crosses edge j of B's, projected along the
/// normal.
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
      const S t = cross(between, along_b) / determinant;
      const S s = cross(between, along_a) / determinant;
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
  for (const PatchCorner<S>& corner : on_a) {
    if (on_plane || holds(on_b, corner.seen, aside))
      add({corner.place, corner.place + offset, {FeatureKind::Vertex, corner.vertex}, whole_b});
  }
  for (const PatchCorner<S>& corner : on_b) {
    if (holds(on_a, corner.seen, aside))
      add({corner.place - offset, corner.place, whole_a, {FeatureKind::Vertex, corner.vertex}});
  }
  for_each_crossing(on_a, on_b, aside, [&](const Vec3<S>& place, std::size_t i, std::size_t j) {
    add({place, place + offset, edge_of(a, on_a, i, whole_a), edge_of(b, on_b, j, whole_b)});
  });
  if (patch.empty()) add(query.closest);
  std::ranges::sort(patch, {}, order_of<S>);
  return patch;
}

}  // namespace contactscope
