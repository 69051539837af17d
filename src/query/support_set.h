#pragma once

#include "geometry/hull.h"

namespace contactscope {

/// Prefetches memory while the caller computes something else: else the first query of a shape that is
/// not in the cache would wait for each of its lists in turn. Of a long list only the beginning: the hardware prefetcher loads the rest.
template <class T> void prefetch(const std::vector<T>& list) {
  constexpr std::size_t kCacheLine = 64, kMax = 4096;  // bytes
  const auto* bytes = reinterpret_cast<const char*>(list.data());
  const std::size_t size = std::min(list.size() * sizeof(T), kMax);
  for (std::size_t i = 0; i < size; i += kCacheLine) __builtin_prefetch(bytes + i);
}

/// Data that queries read from a hull: first the numbers, then the topology.
template <class S> void prefetch_lanes(const Hull<S>& hull) {
  prefetch(hull.lanes.vertices);
  prefetch(hull.lanes.normals);
  prefetch(hull.lanes.offsets);
}
template <class S> void prefetch_topology(const Hull<S>& hull) {
  prefetch(hull.face_edges);
  prefetch(hull.half_edges);
}

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
