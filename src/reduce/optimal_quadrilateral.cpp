#include "reduce/optimal_ring.h"

namespace contactscope {
namespace {

using lanes::store;
using widest::each;
using widest::load;
using widest::Pack;

/// The first corner after `after`, counter-clockwise seen against the normal, for which holds(packs
/// of `values`); at the latest `after` itself. Where rounding could choose between several, the
/// result does not depend on the order of the points.
template <class S, class Holds>
int next_round(const Patch<S>& patch, const S* values, int after, const Holds& holds) {
  const int count = patch.count;
  const auto below = [count](int i) { return i < count ? i : i - count; };
  constexpr int kHalf = 16;  // corners; two rounds of them fit into a word
  if (count <= kHalf) {
    std::uint32_t bits = 0;
    for (int i = 0; i < count; i += Patch<S>::kLanes)
      bits |= lanes::bits<S>(holds(load(values + i))) << i;
    bits &= (1U << count) - 1;
    bits |= bits << count;
    if (patch.is_mirrored()) {
      bits = (bits & ((1U << (after + count)) - 1)) | 1U << after;
      return below(31 - std::countl_zero(bits));
    }
    return below(after + 1 + std::countr_zero(bits >> (after + 1) | 1U << (count - 1)));
  }
  const int step = patch.is_mirrored() ? count - 1 : 1;
  for (int i = below(after + step); i != after; i = below(i + step)) {
    const int first = i / Patch<S>::kLanes * Patch<S>::kLanes;
    if ((lanes::bits<S>(holds(load(values + first))) >> (i - first) & 1U) != 0) return i;
  }
  return after;
}

/// The diagonal between two corners and the first farthest corners on both sides, from `from` on.
template <class S>
CornerRing<S> ring_across(const Patch<S>& patch, int from, int to, S doubled_area) {
  constexpr int kLanes = Patch<S>::kLanes;
  const int count = patch.count;
  const S dx = patch.xs[to] - patch.xs[from];
  const S dy = patch.ys[to] - patch.ys[from];
  S across[kMaxManifoldPoints];
  Pack<S> most = dx * load(patch.ys) - dy * load(patch.xs);  // the patch repeats at least twice
  Pack<S> least = most;
  store<S>(most, across);
  for (int i = kLanes; i < count; i += kLanes) {
    const Pack<S> here = dx * load(patch.ys + i) - dy * load(patch.xs + i);
    store<S>(here, across + i);
    most = lanes::larger(most, here);
    least = lanes::smaller(least, here);
  }
  most = lanes::largest<S>(most) - patch.tie;
  least = lanes::smallest<S>(least) + patch.tie;
  // The right side is between the first corner and the second, the left one on the return.
  const bool back = patch.is_mirrored();
  const int right =
      next_round(patch, across, back ? to : from, [&](const Pack<S>& c) { return c <= least; });
  const int left =
      next_round(patch, across, back ? from : to, [&](const Pack<S>& c) { return c >= most; });
  CornerRing<S> ring;
  ring.doubled_area = doubled_area;
  ring.corners.push_back(from);
  // On a side that is straight up to rounding, an end may come out farthest.
  if (right != from && right != to) ring.corners.push_back(right);
  if (to != from) ring.corners.push_back(to);  // areas are NaN if S overflows
  if (left != from && left != to) ring.corners.push_back(left);
  return ring;
}

constexpr int kEight = 8;

/// Diagonals from each corner i of eight to i + kSteps, one lane each: the area with the farthest
/// corners on both sides, for `kCount` of them.
template <class S, int kSteps, int kCount>
inline void areas_of_eight(const Pack<S> (&x)[kEight], const Pack<S> (&y)[kEight], Pack<S>& most) {
  for (int i = 0; i < kCount; i += Patch<S>::kLanes) {
    const auto at = [i](int m) { return (i + m) % kEight; };
    const Pack<S> dx = x[at(kSteps)] - x[i];
    const Pack<S> dy = y[at(kSteps)] - y[i];
    const auto across = [&](int m) -> Pack<S> { return dx * y[at(m)] - dy * x[at(m)]; };
    Pack<S> right = across(1);
    for (int m = 2; m < kSteps; ++m) right = lanes::smaller(right, across(m));
    Pack<S> left = across(kSteps + 1);
    for (int m = kSteps + 2; m < kEight; ++m) left = lanes::larger(left, across(m));
    most = lanes::larger(most, left - right);
  }
}

/// The area of corners i to i + 3 for each i of eight, a lane each: cross product of diagonals.
template <class S>
inline void areas_of_neighbours(const Pack<S> (&x)[kEight], const Pack<S> (&y)[kEight],
                                Pack<S>& most) {
  for (int i = 0; i < kEight; i += Patch<S>::kLanes) {
    const auto at = [i](int m) { return (i + m) % kEight; };
    const Pack<S> dx = x[at(2)] - x[i];
    const Pack<S> dy = y[at(2)] - y[i];
    most = lanes::larger(most, dx * (y[at(3)] - y[at(1)]) - dy * (x[at(3)] - x[at(1)]));
  }
}

/// For five to eight corners: tries every diagonal that skips at least two corners. Quadrilaterals
/// without such a diagonal are four neighbours. With fewer than eight corners the first ones repeat
/// after the last. Some diagonals then have corners on the wrong side and give too small an area;
/// but each quadrilateral also occurs with all corners in place: a path of two, three or four steps
/// from an end of a diagonal does not cross the seam, or crosses it while staying at a corner.
template <class S, int... kFirst>
S best_of_eight(const Patch<S>& patch, std::integer_sequence<int, kFirst...>) {
  constexpr int kLanes = Patch<S>::kLanes;
  const auto starting = [](const S* values, auto first) {
    constexpr int kPack = first / kLanes;
    constexpr int kNext = (kPack + 1) * kLanes % kEight;
    return lanes::straddle<S, first % kLanes>(load(values + kPack * kLanes), load(values + kNext));
  };
  const Pack<S> x[] = {starting(patch.xs, std::integral_constant<int, kFirst>{})...};
  const Pack<S> y[] = {starting(patch.ys, std::integral_constant<int, kFirst>{})...};
  Pack<S> most = {};
  areas_of_neighbours<S>(x, y, most);
  areas_of_eight<S, 3, kEight>(x, y, most);
  areas_of_eight<S, 4, kEight / 2>(x, y, most);  // half of the longest diagonals are enough
  return lanes::largest<S>(most)[0];
}

/// Steps of area_of_best_quadrilateral() for `kPacks` packs of edges from edge i on.
template <class S, int kPacks>
inline void roll(const Patch<S>& patch, const S* edge_x, const S* edge_y, int i, Pack<S>& most) {
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
    const auto end = [&](int lane) { return first + lane + static_cast<int>(ahead[p][lane]); };
    x[p] = each<S>([&](int lane) { return patch.xs[end(lane)]; }) - load(patch.xs + first + 1);
    y[p] = each<S>([&](int lane) { return patch.ys[end(lane)]; }) - load(patch.ys + first + 1);
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
  for (int p = 0; p < kPacks; ++p) most = lanes::larger(most, left[p] - right[p]);
}

}  // namespace

/// In the largest quadrilateral a b c d, a and c are the farthest corners on both sides of the
/// diagonal b d; otherwise it would not be the largest. So they are an antipodal pair (two parallel
/// lines through them have all corners between them), and so are b and d. A line that rolls round a
/// convex polygon of n corners meets n such pairs (Shamos 1978, "Computational Geometry"), so only
/// n diagonals need testing instead of n(n - 3) / 2.
///
///          to ___          The line rolls over corner i and lies on the edge from i to i + 1. Its
///        ---/-   \---      parallel on the other side touches `to`, the farthest corner from that
///          |      |        edge. As it rolls on, i + 1 and `to` are a pair. If the parallel lies
///        ---\__ _/---      on an edge as well, `to` is the later corner of that edge, because the
///          i   i+1         parallel rolls on, too.
///
/// Steps: for each edge, count the edges ahead that do not lead back to it, up to the farthest
/// corner; take the farthest corners on both sides of the diagonal from there to the end of the
/// edge. Rotating calipers need O(n) steps for the pairs, but each waits for the previous one.
/// O(n^2) parallel steps without branches are faster for the sizes of manifolds.
template <class S> S area_of_best_quadrilateral(const Patch<S>& patch) {
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
  Pack<S> most = {};
  int i = 0;
  for (; i + kLanes < count; i += 2 * kLanes) roll<S, 2>(patch, edge_x, edge_y, i, most);
  if (i < count) roll<S, 1>(patch, edge_x, edge_y, i, most);
  return lanes::largest<S>(most)[0];
}

/// Tests only the diagonals at this corner, because a quadrilateral has a diagonal at each corner;
/// among equals the first in order from there. The two sides need not be distinguished: beyond the
/// ends of a diagonal of a convex polygon nothing is farther to the right or left.
template <class S> CornerRing<S> best_quadrilateral_through(const Patch<S>& patch, int through) {
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
  const Pack<S> enough = most - patch.tie;
  const int to =
      next_round(patch, areas, through, [&](const Pack<S>& area) { return area >= enough; });
  return ring_across(patch, through, to, most[0]);
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(area_of_best_quadrilateral, best_quadrilateral_through);

}  // namespace contactscope
