#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <vector>

#include "core/static_vector.h"
#include "manifold/incremental_query.h"
#include "query/tolerance.h"

namespace contactscope {

/// Most corners of the patch on which two cores are closest that are looked at.
inline constexpr std::size_t kMaxPatchPoints = 128;
template <class S>
using CorePatch = StaticVector<CoreContact<S>, kMaxPatchPoints>;

template <class S>
using PatchVec2 = Eigen::Matrix<S, 2, 1>;

template <class S>
S turn(const PatchVec2<S>& a, const PatchVec2<S>& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// A vertex of a core, placed in A's frame and seen along the normal.
template <class S>
struct PatchCorner {
  int vertex;
  Vec3<S> place;
  PatchVec2<S> seen;
};

/// The vertices of a core that are as far along a direction as any, within rounding: the corners of
/// its support feature in order, one, two, or more counter-clockwise.
template <class S>
using SupportFeature = std::vector<PatchCorner<S>>;

/// Orthonormal with the normal; `origin` keeps coordinates small.
template <class S>
struct PatchFrame {
  Vec3<S> origin, u, v;

  PatchFrame(const Vec3<S>& at, const Vec3<S>& normal)
      : origin(at), u(any_perpendicular(normal)), v(normal.cross(u)) {}
  PatchVec2<S> seen(const Vec3<S>& place) const {
    const Vec3<S> offset = place - origin;
    return {u.dot(offset), v.dot(offset)};
  }
};

/// Andrew's monotone chain, without points on edges.
template <class S>
SupportFeature<S> corners_in_order(SupportFeature<S> points, S tolerance) {
  std::ranges::sort(points, [](const PatchCorner<S>& one, const PatchCorner<S>& other) {
    return std::tie(one.seen.x(), one.seen.y()) < std::tie(other.seen.x(), other.seen.y());
  });
  SupportFeature<S> corners;
  const auto chain = [&](auto from, auto to) {
    const std::size_t start = corners.size();
    for (auto point = from; point != to; ++point) {
      while (corners.size() >= start + 2) {
        const PatchVec2<S> edge = corners.back().seen - corners[corners.size() - 2].seen;
        const PatchVec2<S> next = point->seen - corners.back().seen;
        if (turn(edge, next) > tolerance * edge.norm()) break;
        corners.pop_back();
      }
      corners.push_back(*point);
    }
    corners.pop_back();  // the other chain begins with it
  };
  chain(points.begin(), points.end());
  chain(points.rbegin(), points.rend());
  return corners;
}

/// `towards` is unit, in A's frame; `core_in_a` places the core there.
template <class S>
SupportFeature<S> support_feature(const ShapeCore<S>& core, const Pose<S>& core_in_a,
                                  const Vec3<S>& towards, const PatchFrame<S>& frame, S tie) {
  const Vec3<S> local = core_in_a.inverse_rotate(towards);
  const S farthest = local.dot(core.vertex(support_index(core.support(), local)));
  SupportFeature<S> feature;
  for (int i = 0; i < core.count(); ++i) {
    if (local.dot(core.vertex(i)) < farthest - tie) continue;
    const Vec3<S> place = core_in_a.transform(core.vertex(i));
    feature.push_back({i, place, frame.seen(place)});
  }
  return feature.size() > 2 ? corners_in_order(feature, tie) : feature;
}

/// The edges of a support feature: none of a vertex, one of an edge.
template <class S>
std::size_t edge_count(const SupportFeature<S>& feature) {
  return feature.size() > 2 ? feature.size() : feature.size() - 1;
}

template <class S>
S distance_from_segment(const PatchVec2<S>& point, const PatchVec2<S>& from,
                        const PatchVec2<S>& to) {
  const PatchVec2<S> along = to - from;
  const PatchVec2<S> offset = point - from;
  const S squared = along.squaredNorm();
  const S t = squared > S(0) ? std::clamp(offset.dot(along) / squared, S(0), S(1)) : S(0);
  return PatchVec2<S>(offset - t * along).norm();
}

/// Within `tolerance` of the feature, seen along the normal.
template <class S>
bool holds(const SupportFeature<S>& feature, const PatchVec2<S>& point, S tolerance) {
  if (feature.size() == 1) return PatchVec2<S>(point - feature[0].seen).norm() <= tolerance;
  if (feature.size() == 2)
    return distance_from_segment(point, feature[0].seen, feature[1].seen) <= tolerance;
  for (std::size_t i = 0; i < feature.size(); ++i) {
    const PatchVec2<S>& from = feature[i].seen;
    const PatchVec2<S> along = feature[(i + 1) % feature.size()].seen - from;
    const PatchVec2<S> offset = point - from;
    if (turn(along, offset) < -tolerance * along.norm()) return false;
  }
  return true;
}

/// The edge of a hull between two of its vertices, half-edge / 2; -1 where there is none.
template <class S>
int edge_between(const Hull<S>& hull, int one, int other) {
  for (const int edge : hull.around_vertex(one)) {
    if (at(hull.half_edges, Hull<S>::twin(edge)).origin == other) return edge / 2;
  }
  return -1;
}

/// The feature of the core that two or more corners of it span. `outward` in the core's frame.
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

/// The edge from corner `i` to the next; its own number, or that of the whole where it has none.
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

/// Collects places that are not the same, seen along the normal.
template <class S>
class PatchBuilder {
 public:
  PatchBuilder(const PatchFrame<S>& frame, S tolerance) : frame_(frame), tolerance_(tolerance) {}

  void add(const Vec3<S>& on_a, const Vec3<S>& on_b, const CoreFeature& of_a,
           const CoreFeature& of_b) {
    if (patch_.size() == patch_.capacity()) return;
    const CoreContact<S> contact{on_a, on_b, of_a, of_b};
    for (const CoreContact<S>& known : patch_) {
      const PatchVec2<S> way = frame_.seen(known.on_a) - frame_.seen(on_a);
      if (way.norm() <= tolerance_ || order_of(known) == order_of(contact)) return;
    }
    patch_.push_back(contact);
  }
  CorePatch<S> sorted() const {
    CorePatch<S> result = patch_;
    std::ranges::sort(result, {}, order_of<S>);
    return result;
  }
  bool empty() const { return patch_.empty(); }

 private:
  PatchFrame<S> frame_;
  S tolerance_;
  CorePatch<S> patch_;
};

/// Where the edges of both features cross, seen along the normal.
template <class S>
void add_crossings(const ShapeCore<S>& a, const SupportFeature<S>& on_a, const CoreFeature& whole_a,
                   const ShapeCore<S>& b, const SupportFeature<S>& on_b, const CoreFeature& whole_b,
                   const CoreQuery<S>& query, S tolerance, PatchBuilder<S>& builder) {
  for (std::size_t i = 0; i < edge_count(on_a); ++i) {
    const PatchCorner<S>& from = on_a[i];
    const PatchCorner<S>& to = on_a[(i + 1) % on_a.size()];
    const PatchVec2<S> along_a = to.seen - from.seen;
    for (std::size_t j = 0; j < edge_count(on_b); ++j) {
      const PatchVec2<S>& start = on_b[j].seen;
      const PatchVec2<S> along_b = on_b[(j + 1) % on_b.size()].seen - start;
      const S determinant = turn(along_a, along_b);
      const S rounding = tolerance * std::max(along_a.norm(), along_b.norm());
      if (!(std::abs(determinant) > rounding)) continue;  // parallel: their ends say it all
      const PatchVec2<S> between = start - from.seen;
      const S t = turn(between, along_b) / determinant;
      const S s = turn(between, along_a) / determinant;
      if (t < S(0) || t > S(1) || s < S(0) || s > S(1)) continue;
      const Vec3<S> place = from.place + t * Vec3<S>(to.place - from.place);
      builder.add(place, place + query.distance * query.normal, edge_of(a, on_a, i, whole_a),
                  edge_of(b, on_b, j, whole_b));
    }
  }
}

/// All places where the cores are as close as in `query`, within rounding: of parallel features the
/// corners of the patch that they share, seen along the normal; otherwise one. Each is named by the
/// two features whose meeting it is, so no two have the same. At least one; sorted by features.
template <class S>
CorePatch<S> closest_patch(const ShapeCore<S>& a, const ShapeCore<S>& b, const Pose<S>& b_in_a,
                           const CoreQuery<S>& query) {
  // Four ties: both normals and both poses have been rounded.
  const S tie = S(4) * tie_tolerance(query.scale);
  const Vec3<S> way = query.distance * query.normal;
  const PatchFrame<S> frame(query.closest.on_a, query.normal);
  PatchBuilder<S> builder(frame, S(4) * tie);
  const SupportFeature<S> on_a = support_feature(a, Pose<S>(), query.normal, frame, tie);
  if (b.kind == ShapeKind::Plane) {
    for (const PatchCorner<S>& corner : on_a)
      builder.add(corner.place, corner.place + way, {FeatureKind::Vertex, corner.vertex},
                  {FeatureKind::Face, 0});
    return builder.sorted();
  }
  const Vec3<S> against = -query.normal;
  const SupportFeature<S> on_b = support_feature(b, b_in_a, against, frame, tie);
  const CoreFeature whole_a = spanned(a, on_a, query.normal);
  const CoreFeature whole_b = spanned(b, on_b, Vec3<S>(b_in_a.inverse_rotate(against)));
  const S aside = S(4) * tie;
  for (const PatchCorner<S>& corner : on_a) {
    if (!holds(on_b, corner.seen, aside)) continue;
    builder.add(corner.place, corner.place + way, {FeatureKind::Vertex, corner.vertex}, whole_b);
  }
  for (const PatchCorner<S>& corner : on_b) {
    if (!holds(on_a, corner.seen, aside)) continue;
    builder.add(corner.place - way, corner.place, whole_a, {FeatureKind::Vertex, corner.vertex});
  }
  add_crossings(a, on_a, whole_a, b, on_b, whole_b, query, aside, builder);
  if (builder.empty())
    builder.add(query.closest.on_a, query.closest.on_b, query.closest.feature_a,
                query.closest.feature_b);
  return builder.sorted();
}

}  // namespace contactscope
