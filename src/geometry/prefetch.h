#pragma once

#include "geometry/hull.h"

/// Prefetches memory while the caller computes something else. Without it, the first query of a
/// shape that is not in the cache would wait for each of its lists in turn.
namespace contactscope {

/// Prefetches only the beginning of a long list: the hardware prefetcher loads the rest.
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

}  // namespace contactscope
