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

/// The largest doubled area that `edges` edges in a row and the line back enclose.
template <class S>
S largest_chain(const Patch<S>& patch, int edges) {
  Lanes<S> most = Lanes<S>::Zero();
  for (int i = 0; i < patch.count(); i += Patch<S>::kLanes) {
    const S* x = patch.x() + i;
    const S* y = patch.y() + i;
    const Lanes<S> back = load(x + edges) * load(y) - load(y + edges) * load(x);
    most = most.max(load(patch.swept() + i + edges) - load(patch.swept() + i) + back);
  }
  return most.maxCoeff();
}

/// The corner in (first, last) that is farthest along `sign` times the normal of the diagonal.
template <class S>
int farthest_across(const Patch<S>& patch, const PlanePoint<S>& diagonal, S sign, int first,
                    int last) {
  int best = first + 1;
  S most = -std::numeric_limits<S>::infinity();
  for (int m = first + 1; m < last; ++m) {
    const S across = sign * cross(diagonal, patch.corner(m));
    best = across > most ? m : best;
    most = std::max(most, across);
  }
  return best;
}

}  // namespace

/// Over every diagonal, the farthest corner on each side of it: O(n^3), but four diagonals at once
/// and without a branch, which for the sizes of manifolds is faster than the O(n^2) of rotating
/// calipers. Both diagonals of a quadrilateral find it, so the shorter ones, counted in edges, are
/// often not needed.
///
///        i___            Let both diagonals span at most g edges. Going round, the gaps between
///       /    \.          the corners are a, b, c, d edges with a + b <= g and b + c <= g (say; d
///       is
///      |       l         the long one), so a + b + c <= 2g - b <= 2g - 1: all four corners are on
///      a k      /          chain of 2g - 1 edges, and the quadrilateral is no larger than what
///      such
///       \__ j            a chain encloses.
///
/// Steps: go from the longest diagonals to shorter ones; stop when no chain encloses more than the
/// best so far; find the two corners beside the best diagonal again.
template <class S>
CornerRing<S> best_quadrilateral(const Patch<S>& patch) {
  const int count = patch.count();
  Lanes<S> most = Lanes<S>::Constant(-std::numeric_limits<S>::infinity());
  // Which diagonal, as gap * 2 count + start: exact in float, for it is below 2^24.
  Lanes<S> which = Lanes<S>::Zero();
  const Lanes<S> lane = Lanes<S>::LinSpaced(S(0), S(Patch<S>::kLanes - 1));
  for (int gap = count / 2; gap >= 2; --gap) {
    const int chain = 2 * gap - 1;
    if (chain + 2 <= count && largest_chain(patch, chain) <= most.maxCoeff()) break;
    const int starts = 2 * gap == count ? gap : count;
    for (int i = 0; i < starts; i += Patch<S>::kLanes) {
      const Lanes<S> area = largest_across(patch, i, gap);
      which = (area > most).select(lane + S(gap * 2 * count + i), which);
      most = most.max(area);
    }
  }
  Eigen::Index best = 0;
  CornerRing<S> ring;
  ring.doubled_area = most.maxCoeff(&best);
  const int code = static_cast<int>(which[best]);
  const int from = code % (2 * count);
  const int to = from + code / (2 * count);
  const PlanePoint<S> a = patch.corner(from);
  const PlanePoint<S> b = patch.corner(to);
  const PlanePoint<S> diagonal = {b.x - a.x, b.y - a.y};
  const int right = farthest_across(patch, diagonal, S(-1), from, to);
  const int left = farthest_across(patch, diagonal, S(1), to, from + count);
  for (const int corner : {from, right, to, left}) {
    ring.corners.push_back(
        corner >= count ? (corner >= 2 * count ? corner - 2 * count : corner - count) : corner);
  }
  return ring;
}

template CornerRing<float> best_quadrilateral(const Patch<float>&);
template CornerRing<double> best_quadrilateral(const Patch<double>&);

}  // namespace contactscope
