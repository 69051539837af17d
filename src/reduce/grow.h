#pragma once

#include <cmath>

#include "reduce/choices.h"
#include "reduce/steps.h"

namespace contactscope::steps {

/// What the fourth and later points maximise.
enum class Added {
  Area,      // of the triangle that they add outside an edge
  Distance,  // from an edge
};

/// The polygon kept so far, counter-clockwise, as indices into the points.
using Ring = KeptIndices;

inline void insert(Ring& ring, std::size_t position, int index) {
  ring.push_back(index);
  std::rotate(ring.begin() + position, ring.end() - 1, ring.end());
}

/// The point outside the ring that adds most, and the edge that it goes behind.
struct Addition {
  int index = -1;  // -1: no point is outside
  std::size_t after = 0;
};

template <Added added, class S>
Addition largest_addition(ContactPoints<S> points, const Vec3<S>& normal, const Ring& ring,
                          S negligible, S handicap) {
  Addition best;
  S most = S(0);
  for (int q = 0; q < count_of(points); ++q) {
    if (contains(ring, q)) continue;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Vec3<S>& a = position(points, ring[k]);
      const Vec3<S>& b = position(points, ring[(k + 1) % ring.size()]);
      const S area = -doubled_area(position(points, q), a, b, normal);
      if (area <= negligible) continue;
      S value = area;
      if constexpr (added == Added::Distance) value /= (b - a).norm();
      if (handicap * value > most) {
        most = value;
        best = {q, k};
      }
    }
  }
  return best;
}

/// Gregorius 2015, "Contact Point Reduction: 3rd Point" to "4th Point (5)", from two different
/// points on. The third makes the largest triangle, the fourth adds most outside, further ones go
/// on as the fourth until none adds area. False, and nothing added, when all points lie on one
/// line. Deviations: the third maximises the absolute area, so that winding does not hide half of
/// the points, and fixes the winding of the triangle; areas within rounding of zero count as zero.
/// `choices`: record of each choice, null when nobody watches.
template <Added added, class S>
bool grow(ContactPoints<S> points, const Vec3<S>& normal, int max_points, KeptIndices& kept,
          S handicap = S(1), Choices* choices = nullptr) {
  const int first = kept[0];
  const int second = kept[1];
  const S negligible = negligible_area(points, first, second);
  const auto area = [&](int q) {
    return doubled_area(position(points, q), position(points, first), position(points, second),
                        normal);
  };
  const int third = highest(
      points, negligible, [&](int q) { return std::abs(area(q)); }, handicap);
  if (third < 0) return false;
  if (max_points == 2) return true;
  kept.push_back(third);
  if (choices != nullptr) [[unlikely]]
    choices->triangle(first, second);

  const bool left = area(third) > S(0);
  Ring ring;
  ring.push_back(third);
  ring.push_back(left ? first : second);
  ring.push_back(left ? second : first);
  while (count_of(kept) < max_points) {
    const Addition next = largest_addition<added>(points, normal, ring, negligible, handicap);
    if (next.index < 0) break;
    if (choices != nullptr) [[unlikely]]
      choices->outside({ring.begin(), ring.end()}, first, next.index, added == Added::Distance);
    kept.push_back(next.index);
    insert(ring, next.after + 1, next.index);
  }
  return true;
}

/// What happens to a first point that lies between the extremes of points on one line.
enum class OnALine {
  ExchangeFirst,  // for the other extreme: two points
  KeepFirst,      // with both extremes
};

/// The whole of "Contact Point Reduction" from a first point on. One point when all coincide. How the
/// first was chosen has been told already where somebody watches.
template <Added added, class S>
KeptIndices grow_from(ContactPoints<S> points, const Vec3<S>& normal, int first, OnALine on_a_line,
                      const ReduceOptions& options) {
  const int max_points = options.max_points;
  Choices* const choices = options.choices;
  KeptIndices kept;
  kept.push_back(first);
  const int second = farthest_from(points, first);
  if (max_points == 1 || second == first) return kept;
  kept.push_back(second);
  if (choices != nullptr) [[unlikely]]
    choices->farthest(first);
  if (grow<added>(points, normal, max_points, kept, S(1), choices)) return kept;
  const int other = farthest_from(points, second);
  if (on_a_line == OnALine::ExchangeFirst) {
    kept[0] = other;
    if (choices != nullptr) [[unlikely]] {
      choices->keep(1);
      choices->farthest(other);
    }
  } else if (max_points > 2 && position(points, other) != position(points, first)) {
    kept.push_back(other);
    if (choices != nullptr) [[unlikely]]
      choices->triangle(first, second);
  }
  return kept;
}

}  // namespace contactscope::steps
