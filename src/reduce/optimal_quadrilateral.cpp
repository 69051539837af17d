#include <algorithm>
#include <limits>

#include "reduce/optimal_ring.h"

namespace contactscope {
namespace {

using lanes::each;
using lanes::load;
using lanes::Pack;
using lanes::store;

/// The diagonal between two corners below 2 count and the farthest corners on both sides of it.
template <class S>
CornerRing<S> ring_across(const Patch<S>& patch, int from, int to, S doubled_area) {
  constexpr int kLanes = Patch<S>::kLanes;
  const int count = patch.count();
  from = from < count ? from : from - count;
  to = to < count ? to : to - count;
  const S dx = patch.x()[to] - patch.x()[from];
  const S dy = patch.y()[to] - patch.y()[from];
  S across[kMaxManifoldPoints + kLanes];
  Pack<S> most = dx * load(patch.y()) - dy * load(patch.x());
  Pack<S> least = most;
  store<S>(most, across);
  for (int i = kLanes; i < count; i += kLanes) {
    const Pack<S> here = dx * load(patch.y() + i) - dy * load(patch.x() + i);
    store<S>(here, across + i);
    most = lanes::larger(most, here);
    least = lanes::smaller(least, here);
  }
  const S leftmost = lanes::largest<S>(most);
  const S rightmost = lanes::smallest<S>(least);
  int left = 0;
  int right = 0;
  for (int i = 0; i < count; ++i) {
    left = across[i] == leftmost ? i : left;
    right = across[i] == rightmost ? i : right;
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
  const int count = patch.count();
  int ends[kMaxManifoldPoints + kLanes];
  S areas[kMaxManifoldPoints + kLanes];
  Pack<S> most = {};
  for (int i = 0; i < count; i += kLanes) {
    const S* edge_x = patch.edge_x() + i;
    const S* edge_y = patch.edge_y() + i;
    const Pack<S> ex = load(edge_x);
    const Pack<S> ey = load(edge_y);
    lanes::Flags<S> ahead = {};
    for (int m = 1; m < count; ++m) ahead -= ex * load(edge_y + m) >= ey * load(edge_x + m);
    int* const end = ends + i;
    for (int lane = 0; lane < kLanes; ++lane) {
      end[lane] = i + lane + 1 + static_cast<int>(ahead[lane]);
    }
    const S* x = patch.x() + i + 1;
    const S* y = patch.y() + i + 1;
    const Pack<S> dx = each<S>([&](int lane) { return patch.x()[end[lane]]; }) - load(x);
    const Pack<S> dy = each<S>([&](int lane) { return patch.y()[end[lane]]; }) - load(y);
    Pack<S> left = dx * load(y) - dy * load(x);
    Pack<S> right = left;
    for (int m = 1; m < count; ++m) {
      const Pack<S> across = dx * load(y + m) - dy * load(x + m);
      left = lanes::larger(left, across);
      right = lanes::smaller(right, across);
    }
    store<S>(left - right, areas + i);
    most = lanes::larger(most, left - right);
  }
  const S largest = lanes::largest<S>(most);
  int best = 0;
  for (int i = 0; i < count; ++i) best = areas[i] == largest ? i : best;
  return ring_across(patch, best + 1, ends[best], largest);
}

/// Only the diagonals that begin at the one corner. Their two sides are not told apart: beyond the
/// ends of a diagonal of a convex polygon there is nothing farther to the right or to the left.
template <class S>
CornerRing<S> best_quadrilateral_through(const Patch<S>& patch, int through) {
  const int count = patch.count();
  const S* x = patch.x() + through;
  const S* y = patch.y() + through;
  S row[kMaxManifoldPoints + Patch<S>::kLanes];
  row[2] = S(0);  // written below, but the compiler does not know that there are four corners
  for (int to = 2; to < count - 1; to += Patch<S>::kLanes) {
    const Pack<S> dx = load(x + to) - x[0];
    const Pack<S> dy = load(y + to) - y[0];
    Pack<S> left = dx * y[0] - dy * x[0];
    Pack<S> right = left;
    for (int m = 1; m < count; ++m) {
      const Pack<S> across = dx * y[m] - dy * x[m];
      left = lanes::larger(left, across);
      right = lanes::smaller(right, across);
    }
    store<S>(left - right, row + to);
  }
  int best = 2;
  for (int to = 3; to < count - 1; ++to) best = row[to] > row[best] ? to : best;
  return ring_across(patch, through, through + best, row[best]);
}

template CornerRing<float> best_quadrilateral(const Patch<float>&);
template CornerRing<double> best_quadrilateral(const Patch<double>&);
template CornerRing<float> best_quadrilateral_through(const Patch<float>&, int);
template CornerRing<double> best_quadrilateral_through(const Patch<double>&, int);

}  // namespace contactscope
