#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "geometry/hull.h"

/// Has memory brought into the cache while the caller computes something else. Who comes to a shape
/// that was not seen lately would wait for each of its lists in turn.
namespace contactscope {

/// Of a longer list the beginning: the rest fetches itself as it is gone through.
template <class T>
void prefetch(const std::vector<T>& list) {
  constexpr std::size_t kCacheLine = 64, kMost = 4096;  // bytes
  const auto* bytes = reinterpret_cast<const char*>(list.data());
  const std::size_t size = std::min(list.size() * sizeof(T), kMost);
  for (std::size_t i = 0; i < size; i += kCacheLine) __builtin_prefetch(bytes + i);
}

/// What the queries read of a hull: first its numbers, then how its faces hang together.
template <class S>
void prefetch_lanes(const Hull<S>& hull) {
  prefetch(hull.lanes.vertices);
  prefetch(hull.lanes.normals);
  prefetch(hull.lanes.offsets);
}
template <class S>
void prefetch_topology(const Hull<S>& hull) {
  prefetch(hull.face_edges);
  prefetch(hull.half_edges);
}

}  // namespace contactscope
