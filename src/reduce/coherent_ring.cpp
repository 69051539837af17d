#include "reduce/coherent_ring.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace contactscope {
namespace {

/// The best chain of so many corners, so many of them old, with or without a deep one, that ends at
/// a corner.
template <class S>
class Chains {
 public:
  Chains(const Patch<S>& patch, const CoherentWish<S>& wish)
      : patch_(patch), wish_(wish), columns_(patch.count()) {
    const auto size = static_cast<std::size_t>(wish.most * (wish.most + 1) * 2 * columns_);
    area_.resize(size);
    before_.resize(size);
  }

  /// Over all rings that begin at corner `first`, once round.
  void improve_from(int first, CoherentRing<S>& best) {
    centre_ = wish_.beside.value_or(patch_.corner(first));
    extend_from(first);
    S largest = best.ring.doubled_area;
    int best_state = -1;
    int best_end = 0;
    for (int used = 1; used < wish_.most; ++used) {
      for (int old = std::max(1, best.old); old <= used + 1; ++old) {
        for (int end = 1; end < columns_; ++end) {
          const S area = area_[at(state(used, old, true), end)] + seen(first + end, first);
          const bool is_better =
              old > best.old ? area >= wish_.least_doubled_area : old == best.old && area > largest;
          if (!is_better) continue;
          best.old = old;
          largest = area;
          best_state = state(used, old, true);
          best_end = end;
        }
      }
    }
    if (best_state >= 0) best.ring = ring_of(first, best_state, best_end, largest);
  }

 private:
  int state(int used, int old, bool deep) const {
    return (used * (wish_.most + 1) + old) * 2 + static_cast<int>(deep);
  }
  std::size_t at(int s, int column) const {
    return static_cast<std::size_t>(s * columns_ + column);
  }

  /// The triangle that the centre, which is the first corner or the point beside the ring, makes
  /// with the edge between two corners, if it sees its inside.
  S seen(int i, int j) const {
    const PlanePoint<S> a = patch_.corner(i);
    const PlanePoint<S> b = patch_.corner(j);
    const PlanePoint<S>& c = centre_;
    return std::max(S(0), cross<S>({a.x - c.x, a.y - c.y}, {b.x - c.x, b.y - c.y}));
  }

  void extend_from(int first) {
    std::fill(area_.begin(), area_.end(), -std::numeric_limits<S>::infinity());
    const auto is_old = [&](int i) { return wish_.is_old[(first + i) % columns_]; };
    const auto is_deep = [&](int i) {
      return wish_.beside.has_value() || wish_.is_deep[(first + i) % columns_];
    };
    area_[at(state(0, static_cast<int>(is_old(0)), is_deep(0)), 0)] = S(0);
    for (int from = 0; from + 1 < columns_; ++from) {
      for (int to = from + 1; to < columns_; ++to) {
        const S triangle = seen(first + from, first + to);
        for (int used = 0; used + 1 < wish_.most; ++used) {
          for (int old = 0; old <= used + 1; ++old) {
            for (const bool deep : {false, true}) {
              const int before = state(used, old, deep);
              const S area = area_[at(before, from)] + triangle;
              const std::size_t next =
                  at(state(used + 1, old + static_cast<int>(is_old(to)), deep || is_deep(to)), to);
              if (area > area_[next]) {
                area_[next] = area;
                before_[next] = before * columns_ + from;
              }
            }
          }
        }
      }
    }
  }

  CornerRing<S> ring_of(int first, int last_state, int end, S area) const {
    CornerRing<S> ring;
    ring.doubled_area = area;
    std::size_t chain = at(last_state, end);
    for (int column = end; column > 0; column = static_cast<int>(chain) % columns_) {
      ring.corners.push_back((first + column) % columns_);
      chain = static_cast<std::size_t>(before_[chain]);
    }
    ring.corners.push_back(first);
    std::reverse(ring.corners.begin(), ring.corners.end());
    return ring;
  }

  const Patch<S>& patch_;
  const CoherentWish<S>& wish_;
  int columns_;
  PlanePoint<S> centre_ = {};
  std::vector<S> area_;
  std::vector<int> before_;  // state * columns + column
};

}  // namespace

/// The dynamic programming of best_ring(), with the number of old corners and whether a deep one is
/// among them in the state. A ring with an old corner can begin there.
template <class S>
CoherentRing<S> most_coherent_ring(const Patch<S>& patch, const CoherentWish<S>& wish) {
  CoherentRing<S> best;
  Chains<S> chains(patch, wish);
  for (int first = 0; first < patch.count(); ++first) {
    if (wish.is_old[first]) chains.improve_from(first, best);
  }
  return best;
}

template CoherentRing<float> most_coherent_ring(const Patch<float>&, const CoherentWish<float>&);
template CoherentRing<double> most_coherent_ring(const Patch<double>&, const CoherentWish<double>&);

}  // namespace contactscope
