#pragma once

#include "core/vec3.h"
#include "geometry/hull.h"
#include "geometry/prefetch.h"

namespace contactscope {

/// The core of a convex shape, as GJK sees it: the points whose convex hull it is, in the shape's
/// own frame, metres. One point is a sphere's centre, two are a capsule's segment. Refers to what
/// it was made from, which must outlive it.
template <class S>
struct SupportSet {
  const Vec3<S>* points;
  int count;            // > 0
  const Hull<S>* hull;  // the hull whose vertices the points are; nullptr for points and segments
};

template <class S>
SupportSet<S> support_set(const Hull<S>& hull) {
  return {hull.vertices.data(), hull.vertex_count(), &hull};
}
template <class S>
SupportSet<S> support_set(const Vec3<S>& point) {
  return {&point, 1, nullptr};
}
/// `ends` are the two ends of a segment, which may coincide.
template <class S>
SupportSet<S> support_set(const Vec3<S> (&ends)[2]) {
  return {ends, 2, nullptr};
}

/// Index of a point farthest along `direction` (any length > 0, the set's own frame).
template <class S>
int support_index(const SupportSet<S>& set, const Vec3<S>& direction);

/// Has a hull's points brought into the cache while the caller computes something else: the first
/// support point of a hull that was not seen lately waits for memory.
template <class S>
void prefetch_points(const SupportSet<S>& set) {
  if (set.hull != nullptr) prefetch(set.hull->lanes.vertices);
}

/// Some point in the middle of the set.
template <class S>
Vec3<S> middle_of(const SupportSet<S>& set);

/// No coordinate of the set's points is larger than this, metres.
template <class S>
S reach_of(const SupportSet<S>& set);

}  // namespace contactscope
