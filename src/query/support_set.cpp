#include "query/support_set.h"

#include "core/pack.h"
#include "geometry/lanes.h"

namespace contactscope {
namespace {

static_assert(kLaneWidth % lanes::kWidth<float> == 0 && kLaneWidth % lanes::kWidth<double> == 0);

/// Linear scan in packs of lanes; compilers do not vectorize an argmax themselves. Not a walk over
/// the hull's adjacency: in single precision, from a vertex 0.4 rad off, the walk takes twice as
/// long with 32 vertices and equally long with 256.
///
/// Lane k holds the best of the vertices kWidth * n + k. Two packs are compared with each other
/// before the best, because every step waits for the best.
template <class S> int support_in_lanes(const VectorLanes<S>& vertices, const Vec3<S>& direction) {
  using lanes::Flags;
  using lanes::load;
  using lanes::Pack;
  constexpr int kWidth = lanes::kWidth<S>;
  const S dx = direction.x(), dy = direction.y(), dz = direction.z();
  const auto distances_from = [&](int i) {
    return (dx * load(vertices.x() + i) + dy * load(vertices.y() + i)) +
           dz * load(vertices.z() + i);
  };
  Flags<S> block{}, best_block{};
  Pack<S> best = distances_from(0);
  const int whole = vertices.count() & ~(kWidth - 1);  // excludes the padding
  int i = kWidth;
  for (; i + kWidth < whole; i += 2 * kWidth) {
    const Pack<S> first = distances_from(i);
    const Pack<S> second = distances_from(i + kWidth);
    const Flags<S> is_second = second > first;
    const Pack<S> distances = is_second ? second : first;
    const Flags<S> farther = distances > best;
    best = farther ? distances : best;
    block += 2 * kWidth;
    best_block = farther ? block - (~is_second & kWidth) : best_block;
  }
  if (i < whole) {
    const Pack<S> distances = distances_from(i);
    const Flags<S> farther = distances > best;
    best = farther ? distances : best;
    best_block = farther ? block + kWidth : best_block;
  }
  // Branchless, because the winning lane is unpredictable. The first on a tie; any for NaN.
  const Pack<S> most = lanes::largest<S>(best);
  const std::uint32_t winners = lanes::bits<S>(best == most);
  const int place = std::countr_zero(winners | (1U << kWidth)) & (kWidth - 1);
  int result = static_cast<int>(best_block[place]) + place;
  S farthest = most[0];
  for (i = whole; i < vertices.count(); ++i) {
    const S distance = dot(dx, dy, dz, vertices.x()[i], vertices.y()[i], vertices.z()[i]);
    if (distance > farthest) {
      farthest = distance;
      result = i;
    }
  }
  return result;
}

}  // namespace

template <class S> int support_index(const SupportSet<S>& set, const Vec3<S>& direction) {
  // A triangle does not fill a pack of floats, and the padding is not a vertex.
  if (set.hull != nullptr && set.count >= lanes::kWidth<S>)
    return support_in_lanes<S>({set.hull->lanes.vertices.data(), set.count}, direction);
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

template <class S> Vec3<S> middle_of(const SupportSet<S>& set) {
  if (set.hull != nullptr) return set.hull->centroid;
  return S(0.5) * (set.points[0] + set.points[set.count - 1]);
}

template <class S> S reach_of(const SupportSet<S>& set) {
  if (set.hull != nullptr) return set.hull->centroid.norm() + set.hull->radius;
  S squared = 0;
  for (int i = 0; i < set.count; ++i) squared = std::max(squared, set.points[i].squaredNorm());
  return std::sqrt(squared);
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(support_index, middle_of, reach_of);

}  // namespace contactscope
