#pragma once

#include "reduce/choices.h"

namespace contactscope::steps {

/// The measure that the fourth and later points maximise.
enum class Added {
  Area,      // of the triangle that they add outside an edge
  Distance,  // from an edge
};

/// The point outside a ring of kept points that adds most, and its position in the ring.
struct Addition {
  int index = -1;  // -1: no point is outside
  std::size_t place = 0;
};

template <Added added, class S>
Addition largest_addition(const Candidates<S>& points, const KeptIndices& ring, S negligible,
                          S handicap) {
  Addition best;
  S most = S(0);
  for (int q = 0; q < points.count(); ++q) {
    if (contains(ring, q)) continue;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const int a = ring[k], b = ring[(k + 1) % ring.size()];
      const S area = -points.doubled_area(q, a, b);
      if (area <= negligible) continue;
      S value = area;
      if constexpr (added == Added::Distance) value /= (points[b] - points[a]).norm();
      if (handicap * value > most) {
        most = value;
        best = {q, k + 1};
      }
    }
  }
  return best;
}

/// Gregorius 2015, "Contact Point Reduction: 3rd Point" to "4th Point (5)", from two different
/// points on. The third makes the largest triangle, the fourth and later ones add most outside,
/// until none adds area. Returns false and adds nothing if all points are on one line. Deviations:
/// the third maximises the absolute area, so that winding does not hide half of the points, and
/// fixes the winding of the triangle; areas within rounding of zero count as zero.
template <Added added, class S>
bool grow(const Candidates<S>& points, KeptIndices& kept, const ReduceOptions& options,
          S handicap = S(1)) {
  const int first = kept[0], second = kept[1];
  const S negligible = points.negligible_area(first, second);
  const int third = points.highest(
      [&](int q) { return std::abs(points.doubled_area(q, first, second)); }, negligible, handicap);
  if (third < 0) return false;
  if (options.max_points == 2) return true;
  kept.push_back(third);
  if (options.choices != nullptr) [[unlikely]]
    options.choices->triangle(first, second);

  const bool left = points.doubled_area(third, first, second) > S(0);
  KeptIndices ring;  // the polygon kept so far, counter-clockwise
  // One by one: a loop over a list of the three waits for its stores, a tenth of the time.
  ring.push_back(third);
  ring.push_back(left ? first : second);
  ring.push_back(left ? second : first);
  while (count_of(kept) < options.max_points) {
    const Addition next = largest_addition<added>(points, ring, negligible, handicap);
    if (next.index < 0) break;
    if (options.choices != nullptr) [[unlikely]]
      options.choices->outside({ring.begin(), ring.end()}, first, next.index,
                               added == Added::Distance);
    kept.push_back(next.index);
    ring.push_back(next.index);
    std::rotate(ring.begin() + next.place, ring.end() - 1, ring.end());
  }
  return true;
}

}  // namespace contactscope::steps
