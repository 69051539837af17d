#include "query/support_set.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "geometry/lanes.h"

namespace contactscope {
namespace {

/// As many lanes as fill a vector register of every processor. The compiler makes no such loop of a
/// search for the index of a maximum by itself.
template <class S>
constexpr int kRegisterWidth = static_cast<int>(16 / sizeof(S));
template <class S>
using Register [[gnu::vector_size(16)]] = S;
static_assert(kLaneWidth % kRegisterWidth<float> == 0 && kLaneWidth % kRegisterWidth<double> == 0);

template <class S>
Register<S> load(const S* from) {
  Register<S> result;
  std::memcpy(&result, from, sizeof(result));
  return result;
}

/// A scan, not a walk over the hull's adjacency: measured in single precision, from a vertex that
/// lies 0.4 rad off the walk takes twice as long with 32 vertices and as long with 256.
///
/// Place k of the register keeps the best of the vertices kWidth * n + k. Two registers meet each
/// other before the best, which every step waits for.
template <class S>
int support_in_lanes(const VectorLanes<S>& lanes, const Vec3<S>& direction) {
  constexpr int kWidth = kRegisterWidth<S>;
  const S dx = direction.x(), dy = direction.y(), dz = direction.z();
  const auto distances_from = [&](int i) {
    return (dx * load(lanes.x() + i) + dy * load(lanes.y() + i)) + dz * load(lanes.z() + i);
  };
  using Indices = decltype(Register<S>{} > Register<S>{});
  Indices block{}, best_block{};
  Register<S> best = distances_from(0);
  const int whole = lanes.count() & ~(kWidth - 1);  // the padding is no vertex
  int i = kWidth;
  for (; i + kWidth < whole; i += 2 * kWidth) {
    const Register<S> first = distances_from(i);
    const Register<S> second = distances_from(i + kWidth);
    const Indices is_second = second > first;
    const Register<S> distances = is_second ? second : first;
    const Indices farther = distances > best;
    best = farther ? distances : best;
    block += 2 * kWidth;
    best_block = farther ? block - (~is_second & kWidth) : best_block;
  }
  if (i < whole) {
    const Register<S> distances = distances_from(i);
    const Indices farther = distances > best;
    best = farther ? distances : best;
    best_block = farther ? block + kWidth : best_block;
  }
  // A tournament without branches: which place wins is anybody's guess.
  int place = best[1] > best[0] ? 1 : 0;
  if constexpr (kWidth == 4) {
    const int other = best[3] > best[2] ? 3 : 2;
    place = best[other] > best[place] ? other : place;
  }
  int result = static_cast<int>(best_block[place]) + place;
  S farthest = best[place];
  for (i = whole; i < lanes.count(); ++i) {
    const S distance = dot(dx, dy, dz, lanes.x()[i], lanes.y()[i], lanes.z()[i]);
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
  // A triangle does not fill a register of floats, and the padding is no vertex.
  if (set.hull != nullptr && set.count >= kRegisterWidth<S>) {
    return support_in_lanes<S>({set.hull->lanes.vertices.data(), set.count}, direction);
  }
  if (set.count == 1) return 0;
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
