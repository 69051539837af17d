#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>

#include "reduce/optimal_ring.h"

namespace contactscope {
namespace {

using lanes::store;
using widest::each;
using widest::load;
using widest::Pack;

/// The last of the first `count` stored numbers that equals one of them, which stands in all lanes.
template <class S>
int last_equal(const S* values, int count, const Pack<S>& wanted) {
  int last = 0;
  for (int base = 0; base < count; base += 32) {
    std::uint32_t equal = 0;
    const int end = std::min(count - base, 32);
    for (int i = 0; i < end; i += Patch<S>::kLanes) {
      equal |= lanes::bits<S>(load(values + base + i) == wanted) << i;
    }
    equal &= ~std::uint32_t{0} >> (32 - end);
    if (equal != 0) last = base + 31 - std::countl_zero(equal);
  }
  return last;
}

constexpr int kSmall = 16;  // corners: ring_across() keeps what it found in as many bits

/// The diagonal between two corners and the farthest corners on both sides of it. `kMost` corners
/// at most.
template <int kMost, class S>
CornerRing<S> ring_across(const Patch<S>& patch, int from, int to, S doubled_area) {
  constexpr int kLanes = Patch<S>::kLanes;
  const int count = patch.count;
  const int end = kMost <= kSmall ? kMost : count;  // a patch goes round twice at least
  const S dx = patch.xs[to] - patch.xs[from];
  const S dy = patch.ys[to] - patch.ys[from];
  S across[kMost];
  Pack<S> most = dx * load(patch.ys) - dy * load(patch.xs);
  Pack<S> least = most;
  store<S>(most, across);
  for (int i = kLanes; i < end; i += kLanes) {
    const Pack<S> here = dx * load(patch.ys + i) - dy * load(patch.xs + i);
    store<S>(here, across + i);
    most = lanes::larger(most, here);
    least = lanes::smaller(least, here);
  }
  most = lanes::largest<S>(most);
  least = lanes::smallest<S>(least);
  int left;
  int right;
  if constexpr (kMost <= kSmall) {
    std::uint32_t is_left = 0;
    std::uint32_t is_right = 0;
    for (int i = 0; i < kMost; i += kLanes) {
      is_left |= lanes::bits<S>(load(across + i) == most) << i;
      is_right |= lanes::bits<S>(load(across + i) == least) << i;
    }
    const std::uint32_t corners = (1U << count) - 1;
    left = 31 - std::countl_zero((is_left & corners) | 1);
    right = 31 - std::countl_zero((is_right & corners) | 1);
  } else {
    left = last_equal(across, count, most);
    right = last_equal(across, count, least);
  }
  CornerRing<S> ring;
  ring.doubled_area = doubled_area;
  ring.corners.push_back(from);
  // On a side where all is straight but for rounding an end may come out farthest.
  if (right != from && right != to) ring.corners.push_back(right);
  ring.corners.push_back(to);
  if (left != from && left != to) ring.corners.push_back(left);
  return ring;
}

constexpr int kEight = 8;

/// Diagonals from every corner i of eight to i + kSteps, a lane each: the area of the farthest
/// corners on both sides. Stores `kCount` of them.
template <int kSteps, int kCount, class S>
inline void areas_of_eight(const Pack<S> (&x)[kEight], const Pack<S> (&y)[kEight], S* areas,
                           Pack<S>& most) {
  for (int i = 0; i < kCount; i += Patch<S>::kLanes) {
    const auto at = [i](int m) { return (i + m) % kEight; };
    const Pack<S> dx = x[at(kSteps)] - x[i];
    const Pack<S> dy = y[at(kSteps)] - y[i];
    const auto across = [&](int m) -> Pack<S> { return dx * y[at(m)] - dy * x[at(m)]; };
    Pack<S> right = across(1);
    for (int m = 2; m < kSteps; ++m) right = lanes::smaller(right, across(m));
    Pack<S> left = across(kSteps + 1);
    for (int m = kSteps + 2; m < kEight; ++m) left = lanes::larger(left, across(m));
    store<S>(left - right, areas + i);
    most = lanes::larger(most, left - right);
  }
}

/// The area of corners i to i + 3 for every corner i of eight, a lane each: cross product of their
/// diagonals. Stores eight of them.
template <class S>
inline void areas_of_neighbours(const Pack<S> (&x)[kEight], const Pack<S> (&y)[kEight], S* areas,
                                Pack<S>& most) {
  for (int i = 0; i < kEight; i += Patch<S>::kLanes) {
    const auto at = [i](int m) { return (i + m) % kEight; };
    const Pack<S> dx = x[at(2)] - x[i];
    const Pack<S> dy = y[at(2)] - y[i];
    const Pack<S> area = dx * (y[at(3)] - y[at(1)]) - dy * (x[at(3)] - x[at(1)]);
    store<S>(area, areas + i);
    most = lanes::larger(most, area);
  }
}

/// Five to eight corners: every diagonal over two others or more is tried, which needs no search for
/// its other end. Quadrilaterals with none such are four neighbours. With fewer than eight the first
/// corners come again after the last. So some diagonals are looked at with corners on the wrong side,
/// and come out too small; but each quadrilateral is also there with all corners in place, because a
/// way of two, three or four steps from an end of a diagonal does not cross the seam or crosses it
/// where it only stays at a corner.
template <class S, int... kFirst>
CornerRing<S> best_of_eight(const Patch<S>& patch, std::integer_sequence<int, kFirst...>) {
  constexpr int kLanes = Patch<S>::kLanes;
  const auto starting = [](const S* values, auto first) {
    constexpr int kPack = first / kLanes;
    constexpr int kNext = (kPack + 1) * kLanes % kEight;
    return lanes::straddle<S, first % kLanes>(load(values + kPack * kLanes), load(values + kNext));
  };
  const Pack<S> x[] = {starting(patch.xs, std::integral_constant<int, kFirst>{})...};
  const Pack<S> y[] = {starting(patch.ys, std::integral_constant<int, kFirst>{})...};
  // Of the longest diagonals half are enough; where a pack holds all eight, they come twice.
  constexpr int kAreas = std::max(kEight / 2 * 5, 2 * kEight + kLanes);
  S areas[kAreas];
  Pack<S> most = {};
  areas_of_neighbours(x, y, areas, most);
  areas_of_eight<3, kEight>(x, y, areas + kEight, most);
  areas_of_eight<4, kEight / 2>(x, y, areas + 2 * kEight, most);
  most = lanes::largest<S>(most);
  std::uint32_t equal = 0;
  for (int i = 0; i < kAreas; i += kLanes) {
    equal |= lanes::bits<S>(load(areas + i) == most) << i;
  }
  equal |= 1U << (kAreas - 1);  // when areas are too large for S
  const int best = std::countr_zero(equal);
  const auto corner = [&](int i) {
    i %= kEight;
    return i - (patch.count & -static_cast<int>(i >= patch.count));
  };
  return ring_across<kEight>(patch, corner(best), corner(best + 2 + best / kEight), most[0]);
}

/// Steps of best_quadrilateral() for `kPacks` packs of edges from edge i on. The corner of a
/// comparison with all is read once for all packs.
template <int kPacks, class S>
inline void roll(const Patch<S>& patch, const S* edge_x, const S* edge_y, int i, int* ends,
                 S* areas, Pack<S>& most) {
  constexpr int kLanes = Patch<S>::kLanes;
  const int count = patch.count;
  Pack<S> x[kPacks];
  Pack<S> y[kPacks];
  widest::Flags<S> ahead[kPacks];
  for (int p = 0; p < kPacks; ++p) {
    x[p] = load(edge_x + i + p * kLanes);
    y[p] = load(edge_y + i + p * kLanes);
    ahead[p] = widest::Flags<S>{};
  }
  for (int m = 0; m < count; ++m) {
    const Pack<S> mx = widest::all(edge_x[m]);
    const Pack<S> my = widest::all(edge_y[m]);
    for (int p = 0; p < kPacks; ++p) ahead[p] -= x[p] * my >= y[p] * mx;
  }
  for (int p = 0; p < kPacks; ++p) {
    const int first = i + p * kLanes;
    int* const end = ends + first;
    for (int lane = 0; lane < kLanes; ++lane) {
      end[lane] = first + lane + static_cast<int>(ahead[p][lane]);
    }
    x[p] = each<S>([&](int lane) { return patch.xs[end[lane]]; }) - load(patch.xs + first + 1);
    y[p] = each<S>([&](int lane) { return patch.ys[end[lane]]; }) - load(patch.ys + first + 1);
  }
  Pack<S> left[kPacks];
  Pack<S> right[kPacks];
  for (int p = 0; p < kPacks; ++p) {
    left[p] = x[p] * patch.ys[0] - y[p] * patch.xs[0];
    right[p] = left[p];
  }
  for (int m = 1; m < count; ++m) {
    const Pack<S> mx = widest::all(patch.xs[m]);
    const Pack<S> my = widest::all(patch.ys[m]);
    for (int p = 0; p < kPacks; ++p) {
      const Pack<S> across = x[p] * my - y[p] * mx;
      left[p] = lanes::larger(left[p], across);
      right[p] = lanes::smaller(right[p], across);
    }
  }
  for (int p = 0; p < kPacks; ++p) {
    store<S>(left[p] - right[p], areas + i + p * kLanes);
    most = lanes::larger(most, left[p] - right[p]);
  }
}

}  // namespace

/// The largest quadrilateral a b c d: a and c are the farthest corners on both sides of the diagonal
/// b d, or it were not the largest, so they are an antipodal pair (two parallel lines through them
/// have all corners between them); and so are b and d. A line that rolls round a convex polygon of
/// n corners meets n such pairs (Shamos 1978, "Computational Geometry"), so only n diagonals are
/// tried instead of n(n - 3) / 2.
///
///          to ___          The line rolls over corner i and lies on the edge from i to i + 1; its
///        ---/-   \---      parallel on the other side touches `to`, the farthest corner from that
///          |      |        edge. As it rolls on, i + 1 and `to` are a pair. When the parallel lies
///        ---\__ _/---      on an edge as well, `to` is the later corner of that, because it rolls
///          i   i+1         on, too.
///
/// Steps: for each edge, count the edges ahead that do not lead back to it, up to the farthest
/// corner; take the farthest corners on both sides of the diagonal from there to the end of the
/// edge; find those of the best diagonal again. Rotating calipers need O(n) steps for the pairs,
/// but each waits for the one before: O(n^2) steps side by side and without a branch are faster for
/// the sizes of manifolds.
template <class S>
CornerRing<S> best_quadrilateral(const Patch<S>& patch) {
  constexpr int kLanes = Patch<S>::kLanes;
  const int count = patch.count;
  if (count <= kEight) return best_of_eight(patch, std::make_integer_sequence<int, kEight>{});
  S edge_x[kMaxManifoldPoints];
  S edge_y[kMaxManifoldPoints];
  Pack<S> x = load(patch.xs);
  Pack<S> y = load(patch.ys);
  for (int i = 0; i < count; i += kLanes) {
    const Pack<S> after_x = load(patch.xs + i + kLanes);
    const Pack<S> after_y = load(patch.ys + i + kLanes);
    store<S>(lanes::straddle<S, 1>(x, after_x) - x, edge_x + i);
    store<S>(lanes::straddle<S, 1>(y, after_y) - y, edge_y + i);
    x = after_x;
    y = after_y;
  }
  int ends[kMaxManifoldPoints];
  S areas[kMaxManifoldPoints];
  Pack<S> most = {};
  int i = 0;
  for (; i + kLanes < count; i += 2 * kLanes) {
    roll<2>(patch, edge_x, edge_y, i, ends, areas, most);
  }
  if (i < count) roll<1>(patch, edge_x, edge_y, i, ends, areas, most);
  most = lanes::largest<S>(most);
  const int best = last_equal(areas, count, most);
  const auto corner = [&](int at) { return at < count ? at : at - count; };
  const int from = corner(best + 1);
  const int to = corner(ends[best]);
  if (count <= kSmall) return ring_across<kSmall>(patch, from, to, most[0]);
  return ring_across<kMaxManifoldPoints>(patch, from, to, most[0]);
}

/// Only the diagonals that begin at the one corner, which a quadrilateral with it has at an end of a
/// diagonal. Their two sides are not told apart: beyond the
/// ends of a diagonal of a convex polygon there is nothing farther to the right or to the left.
template <class S>
CornerRing<S> best_quadrilateral_through(const Patch<S>& patch, int through) {
  const int count = patch.count;
  const S* x = patch.xs;
  const S* y = patch.ys;
  S areas[kMaxManifoldPoints];
  Pack<S> most = {};
  for (int to = 0; to < count; to += Patch<S>::kLanes) {
    const Pack<S> dx = load(x + to) - x[through];
    const Pack<S> dy = load(y + to) - y[through];
    Pack<S> left = dx * y[0] - dy * x[0];
    Pack<S> right = left;
    for (int m = 1; m < count; ++m) {
      const Pack<S> across = dx * y[m] - dy * x[m];
      left = lanes::larger(left, across);
      right = lanes::smaller(right, across);
    }
    store<S>(left - right, areas + to);
    most = lanes::larger(most, left - right);
  }
  most = lanes::largest<S>(most);
  return ring_across<kMaxManifoldPoints>(patch, through, last_equal(areas, count, most), most[0]);
}

template decltype(best_quadrilateral<float>) best_quadrilateral<float>;
template decltype(best_quadrilateral<double>) best_quadrilateral<double>;
template decltype(best_quadrilateral_through<float>) best_quadrilateral_through<float>;
template decltype(best_quadrilateral_through<double>) best_quadrilateral_through<double>;

}  // namespace contactscope
