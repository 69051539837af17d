#include "query/support_set.h"

#include <algorithm>
#include <cmath>

#include "geometry/lanes.h"

namespace contactscope {
namespace {

static_assert(kLaneWidth == 4);

/// One of the lanes' places keeps the best of the vertices 4 k + place: four searches that run in
/// one vector register. Every comparison is strict, so each keeps its first; the index is held in S,
/// which holds every index below 2^24 exactly.
template <class S>
int support_in_lanes(const VectorLanes<S>& lanes, const Vec3<S>& direction) {
  const S dx = direction.x(), dy = direction.y(), dz = direction.z();
  const S* __restrict x = lanes.x();
  const S* __restrict y = lanes.y();
  const S* __restrict z = lanes.z();
  S best[kLaneWidth], index[kLaneWidth];
  for (int k = 0; k < kLaneWidth; ++k) {
    best[k] = dot(dx, dy, dz, x[k], y[k], z[k]);
    index[k] = static_cast<S>(k);
  }
  const int whole = lanes.count() & ~(kLaneWidth - 1);  // the padding is no vertex
  for (int i = kLaneWidth; i < whole; i += kLaneWidth) {
    for (int k = 0; k < kLaneWidth; ++k) {
      const S distance = dot(dx, dy, dz, x[i + k], y[i + k], z[i + k]);
      index[k] = distance > best[k] ? static_cast<S>(i + k) : index[k];
      best[k] = distance > best[k] ? distance : best[k];
    }
  }
  int result = static_cast<int>(index[0]);
  S farthest = best[0];
  for (int k = 1; k < kLaneWidth; ++k) {
    if (best[k] > farthest) {
      farthest = best[k];
      result = static_cast<int>(index[k]);
    }
  }
  for (int i = whole; i < lanes.count(); ++i) {
    const S distance = dot(dx, dy, dz, x[i], y[i], z[i]);
    if (distance > farthest) {
      farthest = distance;
      result = i;
    }
  }
  return result;
}

}  // namespace

template <class S>
int support_index(const SupportSet<S>& set, const Vec3<S>& direction) {
  if (set.hull != nullptr) {
    return support_in_lanes<S>({set.hull->lanes.vertices.data(), set.count}, direction);
  }
  int best = 0;
  S farthest = direction.dot(set.points[0]);
  for (int i = 1; i < set.count; ++i) {
    const S distance = direction.dot(set.points[i]);
    if (distance > farthest) {
      farthest = distance;
      best = i;
    }
  }
  return best;
}

template <class S>
Vec3<S> middle_of(const SupportSet<S>& set) {
  if (set.hull != nullptr) return set.hull->centroid;
  return S(0.5) * (set.points[0] + set.points[set.count - 1]);
}

template <class S>
S reach_of(const SupportSet<S>& set) {
  if (set.hull != nullptr) return set.hull->centroid.norm() + set.hull->radius;
  S squared = 0;
  for (int i = 0; i < set.count; ++i) squared = std::max(squared, set.points[i].squaredNorm());
  return std::sqrt(squared);
}

template int support_index(const SupportSet<float>&, const Vec3<float>&);
template int support_index(const SupportSet<double>&, const Vec3<double>&);
template Vec3<float> middle_of(const SupportSet<float>&);
template Vec3<double> middle_of(const SupportSet<double>&);
template float reach_of(const SupportSet<float>&);
template double reach_of(const SupportSet<double>&);

}  // namespace contactscope
