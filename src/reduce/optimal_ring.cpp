#include "reduce/optimal_ring.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace contactscope {
namespace {

/// The best chains of corners that begin at one corner: row r, column j holds the largest area of
/// r + 1 corners that end at j, doubled. Small ones need no heap.
template <class S>
class Table {
 public:
  Table(int rows, int columns) : columns_(columns) {
    const int size = rows * columns;
    if (size > kInline) heap_.resize(static_cast<std::size_t>(size));
    data_ = size > kInline ? heap_.data() : inline_;
  }
  Table(const Table&) = delete;
  Table& operator=(const Table&) = delete;

  S* row(int r) { return data_ + r * columns_; }

 private:
  static constexpr int kInline = 5 * 64;

  int columns_;
  S* data_;
  S inline_[kInline];
  std::vector<S> heap_;
};

/// The part of the area between corners i and j that `centre` sees. Nothing when it sees the edge
/// from behind: then `centre` is outside of the ring there, and its hull with the ring has no such
/// edge.
template <class S>
S seen(const Patch<S>& patch, const PlanePoint<S>& centre, int i, int j) {
  const PlanePoint<S> a = patch.corner(i);
  const PlanePoint<S> b = patch.corner(j);
  return std::max(S(0),
                  cross<S>({a.x - centre.x, a.y - centre.y}, {b.x - centre.x, b.y - centre.y}));
}

/// The best ring that begins at corner `first` and uses no corner after `last`, which may be in the
/// second round. Replaces `best` when it is larger. `most` >= 2.
template <class S>
void improve_from(const Patch<S>& patch, const PlanePoint<S>& centre, int first, int last, int most,
                  Table<S>& chains, CornerRing<S>& best) {
  constexpr S kNone = -std::numeric_limits<S>::infinity();
  const int columns = last - first + 1;
  for (int r = 0; r < most; ++r) std::fill_n(chains.row(r), columns, kNone);
  chains.row(0)[0] = S(0);
  S area[kMaxManifoldPoints];
  for (int i = 0; i + 1 < columns; ++i) {
    for (int j = i + 1; j < columns; ++j) area[j] = seen(patch, centre, first + i, first + j);
    for (int r = 0; r + 1 < most; ++r) {
      const S before = chains.row(r)[i];
      S* next = chains.row(r + 1);
      for (int j = i + 1; j < columns; ++j) next[j] = std::max(next[j], before + area[j]);
    }
  }

  S largest = best.doubled_area;
  int row = 0;
  int end = -1;
  for (int j = 1; j < columns; ++j) {
    const S closing = seen(patch, centre, first + j, first);
    for (int r = 1; r < most; ++r) {
      if (chains.row(r)[j] + closing > largest) {
        largest = chains.row(r)[j] + closing;
        row = r;
        end = j;
      }
    }
  }
  if (end < 0) return;
  best.doubled_area = largest;
  best.corners.clear();
  best.corners.push_back((first + end) % patch.count());
  for (; row > 0; --row) {
    int from = 0;
    S along = kNone;
    for (int i = 0; i < end; ++i) {
      const S area_along = chains.row(row - 1)[i] + seen(patch, centre, first + i, first + end);
      if (area_along > along) {
        along = area_along;
        from = i;
      }
    }
    end = from;
    best.corners.push_back((first + end) % patch.count());
  }
  std::reverse(best.corners.begin(), best.corners.end());
}

template <class S>
CornerRing<S> every_corner(const Patch<S>& patch) {
  CornerRing<S> ring;
  for (int i = 0; i < patch.count(); ++i) ring.corners.push_back(i);
  ring.doubled_area = patch.doubled_area();
  return ring;
}

}  // namespace

/// The area of a polygon is the sum of the triangles that its edges make with one fixed point, and
/// the best one has only corners of the convex hull: a longest path round the hull, by dynamic
/// programming for each first corner. O(most n^3).
template <class S>
CornerRing<S> best_ring(const Patch<S>& patch, int most) {
  if (patch.count() <= most) return every_corner(patch);
  if (most == 4) return best_quadrilateral(patch);
  CornerRing<S> best;
  Table<S> chains(most, patch.count());
  for (int first = 0; first < patch.count(); ++first) {
    improve_from(patch, patch.corner(first), first, patch.count() - 1, most, chains, best);
  }
  return best;
}

/// The same with only one first corner. O(most n^2).
template <class S>
CornerRing<S> best_ring_through(const Patch<S>& patch, int through, int most) {
  if (patch.count() <= most) return every_corner(patch);
  if (most == 4) return best_quadrilateral_through(patch, through);
  CornerRing<S> best;
  Table<S> chains(most, patch.count());
  improve_from(patch, patch.corner(through), through, through + patch.count() - 1, most, chains,
               best);
  return best;
}

/// The hull of a ring and a point is made of the triangles between the point and those edges of the
/// ring that it sees from within. O(most n^3).
template <class S>
CornerRing<S> best_ring_around(const Patch<S>& patch, const PlanePoint<S>& inner, int most) {
  if (patch.count() <= most) return every_corner(patch);
  CornerRing<S> best;
  Table<S> chains(most, patch.count());
  for (int first = 0; first < patch.count(); ++first) {
    improve_from(patch, inner, first, patch.count() - 1, most, chains, best);
  }
  return best;
}

template <class S>
int farthest_from(const Patch<S>& patch, const PlanePoint<S>& place) {
  int best = 0;
  S most = S(-1);
  for (int i = 0; i < patch.count(); ++i) {
    const S distance = squared_distance(place, patch.corner(i));
    if (distance > most) {
      most = distance;
      best = i;
    }
  }
  return best;
}

template <class S>
CornerRing<S> farthest_pair(const Patch<S>& patch) {
  int first = 0;
  int second = 0;
  S most = S(0);
  for (int i = 0; i < patch.count(); ++i) {
    for (int j = i + 1; j < patch.count(); ++j) {
      const S distance = squared_distance(patch.corner(i), patch.corner(j));
      if (distance > most) {
        most = distance;
        first = i;
        second = j;
      }
    }
  }
  CornerRing<S> ring;
  ring.corners.push_back(first);
  if (!patch.coincide(patch.corner(first), patch.corner(second))) ring.corners.push_back(second);
  return ring;
}

#define CONTACTSCOPE_INSTANTIATE(S)                                                    \
  template CornerRing<S> best_ring(const Patch<S>&, int);                              \
  template CornerRing<S> best_ring_through(const Patch<S>&, int, int);                 \
  template CornerRing<S> best_ring_around(const Patch<S>&, const PlanePoint<S>&, int); \
  template CornerRing<S> farthest_pair(const Patch<S>&);                               \
  template int farthest_from(const Patch<S>&, const PlanePoint<S>&);
CONTACTSCOPE_INSTANTIATE(float)
CONTACTSCOPE_INSTANTIATE(double)
#undef CONTACTSCOPE_INSTANTIATE

}  // namespace contactscope
