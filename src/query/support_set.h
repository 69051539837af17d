#pragma once

#include "geometry/prefetch.h"

namespace contactscope {

/// The core of a convex shape for GJK: points whose convex hull it is, own frame, metres. One for a
/// sphere's centre, two for a capsule's segment. Refers to its source.
template <class S> struct SupportSet {
  const Vec3<S>* points;
  int count;            // > 0
  const Hull<S>* hull;  // the hull that owns the points; null for points and segments
};

template <class S> SupportSet<S> support_set(const Hull<S>& hull) {
  return {hull.vertices.data(), hull.vertex_count(), &hull};
}
template <class S> SupportSet<S> support_set(const Vec3<S>& point) { return {&point, 1, nullptr}; }
/// `ends` are the ends of a segment and may coincide.
template <class S> SupportSet<S> support_set(const Vec3<S> (&ends)[2]) {
  return {ends, 2, nullptr};
}

/// Index of a farthest point along `direction` (any length > 0, the set's own frame).
template <class S> int support_index(const SupportSet<S>& set, const Vec3<S>& direction);

/// Prefetches a hull's points while the caller computes something else: otherwise the first support
/// point of a hull that is not in the cache waits for memory.
template <class S> void prefetch_points(const SupportSet<S>& set) {
  if (set.hull != nullptr) prefetch(set.hull->lanes.vertices);
}

template <class S> Vec3<S> middle_of(const SupportSet<S>& set);

/// Upper bound of the coordinates of the set's points, metres.
template <class S> S reach_of(const SupportSet<S>& set);

}  // namespace contactscope
