#include <algorithm>
#include <limits>

#include "reduce/optimal_ring.h"

namespace contactscope {
namespace {

template <class S>
using Lanes = Eigen::Array<S, Patch<S>::kLanes, 1>;

template <class S>
Lanes<S> load(const S* from) {
  return Eigen::Map<const Lanes<S>>(from);
}

constexpr int kFewCorners = 10;

/// For the diagonals from corners i, i + 1, ... to the corners `gap` further on: the doubled areas
/// of the largest quadrilaterals that they split. As d x p_l - d x p_k, for the corner k farthest
/// to the right of a diagonal d and the corner l farthest to its left.
template <class S>
Lanes<S> largest_across(const Patch<S>& patch, int i, int gap) {
  const S* x = patch.x() + i;
  const S* y = patch.y() + i;
  const Lanes<S> dx = load(x + gap) - load(x);
  const Lanes<S> dy = load(y + gap) - load(y);
  const auto across = [&](int m) -> Lanes<S> { return dx * load(y + m) - dy * load(x + m); };
  Lanes<S> right = across(1);
  for (int m = 2; m < gap; ++m) right = right.min(across(m));
  Lanes<S> left = across(gap + 1);
  for (int m = gap + 2; m < patch.count(); ++m) left = left.max(across(m));
  return left - right;
}

/// Doubled areas of the triangles that the first point makes with the edges up to a corner, over two
/// rounds. swept[j] - swept[i] and the triangle back are what the chain from i to j encloses.
template <class S>
void sweep(const Patch<S>& patch, S* swept) {
  const int count = patch.count();
  swept[0] = S(0);
  for (int i = 0; i < count; ++i) {
    swept[i + 1] = swept[i] + cross(patch.corner(i), patch.corner(i + 1));
  }
  const S round = swept[count];
  for (int i = 0; i < count + Patch<S>::kLanes; i += Patch<S>::kLanes) {
    Eigen::Map<Lanes<S>> second_round(swept + count + i);
    second_round = round + load(swept + i);
  }
}

/// The largest doubled area that `edges` edges in a row and the line back enclose.
template <class S>
S largest_chain(const Patch<S>& patch, const S* swept, int edges) {
  Lanes<S> most = Lanes<S>::Zero();
  for (int i = 0; i < patch.count(); i += Patch<S>::kLanes) {
    const S* x = patch.x() + i;
    const S* y = patch.y() + i;
    const Lanes<S> back = load(x + edges) * load(y) - load(y + edges) * load(x);
    most = most.max(load(swept + i + edges) - load(swept + i) + back);
  }
  return most.maxCoeff();
}

/// The diagonal from corner `from` < count to corner `to` < 2 count and the farthest corners on both
/// sides of it.
template <class S>
CornerRing<S> ring_across(const Patch<S>& patch, int from, int to, S doubled_area) {
  const int count = patch.count();
  if (to >= count) to -= count;
  const PlanePoint<S> a = patch.corner(from);
  const PlanePoint<S> b = patch.corner(to);
  const PlanePoint<S> diagonal = {b.x - a.x, b.y - a.y};
  int right = 0;
  int left = 0;
  S least = cross(diagonal, patch.corner(0));
  S most = least;
  for (int m = 1; m < count; ++m) {
    const S across = cross(diagonal, patch.corner(m));
    right = across < least ? m : right;
    left = across > most ? m : left;
    least = std::min(least, across);
    most = std::max(most, across);
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

/// Over every diagonal, the farthest corner on each side of it: O(n^3), but four diagonals at once
/// and without a branch, which for the sizes of manifolds is faster than the O(n^2) of rotating
/// calipers. Both diagonals of a quadrilateral find it, so the shorter ones, counted in edges, are
/// often not needed.
///
///        i___            Let both diagonals span at most g edges. Going round, the gaps between
///       /    \.          the corners are a, b, c, d edges with a + b <= g and b + c <= g (say; d is
///      |       l         the long one), so a + b + c <= 2g - b <= 2g - 1: all four corners are on a
///      k      /          chain of 2g - 1 edges, and the quadrilateral is no larger than what such
///       \__ j            a chain encloses.
///
/// Steps: go from the longest diagonals to shorter ones; stop when no chain encloses more than the
/// best so far; find the two corners beside the best diagonal again.
template <class S>
CornerRing<S> best_quadrilateral(const Patch<S>& patch) {
  const int count = patch.count();
  S most = S(0);
  int best_gap = count / 2;
  // Of the diagonals of one gap, and of the best gap. Not initialised.
  S rows[2][kMaxManifoldPoints + Patch<S>::kLanes];
  S swept[2 * (kMaxManifoldPoints + Patch<S>::kLanes)];
  S* row = rows[0];
  S* best_row = rows[1];
  best_row[0] = S(0);
  if (count >= kFewCorners) sweep(patch, swept);
  for (int gap = count / 2; gap >= 2; --gap) {
    // What bounds the shorter diagonals, asked for before it is needed, so that the processor can
    // work on it beside the diagonals. Only where it pays: on a circle the best quadrilateral is as
    // large as a chain of 57% of the edges, and a few diagonals are faster tried than avoided.
    const int chain = 2 * gap - 3;
    const bool may_stop = count >= kFewCorners && 5 * chain <= 3 * count;
    const S enclosed = may_stop ? largest_chain(patch, swept, chain) : S(0);
    const int starts = 2 * gap == count ? gap : count;
    Lanes<S> most_of_gap = Lanes<S>::Zero();
    for (int i = 0; i < starts; i += Patch<S>::kLanes) {
      const Lanes<S> area = largest_across(patch, i, gap);
      Eigen::Map<Lanes<S>> stored(row + i);
      stored = area;
      most_of_gap = most_of_gap.max(area);
    }
    const S largest = most_of_gap.maxCoeff();
    // Selected, not branched on: nothing could foresee it.
    const bool improves = largest > most;
    S* const written = row;
    row = improves ? best_row : written;
    best_row = improves ? written : best_row;
    best_gap = improves ? gap : best_gap;
    most = improves ? largest : most;
    if (may_stop && enclosed <= most) break;
  }
  int from = 0;
  while (best_row[from] != most) ++from;
  if (from >= count) from -= count;
  return ring_across(patch, from, from + best_gap, most);
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
    const Lanes<S> dx = load(x + to) - x[0];
    const Lanes<S> dy = load(y + to) - y[0];
    Lanes<S> left = dx * y[0] - dy * x[0];
    Lanes<S> right = left;
    for (int m = 1; m < count; ++m) {
      const Lanes<S> across = dx * y[m] - dy * x[m];
      left = left.max(across);
      right = right.min(across);
    }
    Eigen::Map<Lanes<S>> stored(row + to);
    stored = left - right;
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
