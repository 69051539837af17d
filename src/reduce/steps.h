#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/at.h"
#include "reduce/reducer.h"

/// Steps that several reducers take. All of them look at the points as given, relative to one of
/// them, so that a place far from the origin costs no digits; among equals the earliest wins.
namespace contactscope::steps {

template <class S>
const Vec3<S>& position(ContactPoints<S> points, int i) {
  return at(points, i).position;
}

/// A direction in the plane with unit `normal` that depends on it alone; not of unit length. It
/// leans on no coordinate axis, because boxes and floors do, and two corners of an aligned box would
/// be equally far along an axis: rounding would then choose between them anew in every frame.
template <class S>
Vec3<S> fixed_direction(const Vec3<S>& normal) {
  const Vec3<S> one(S(0.76), S(0.31), S(0.57));
  const Vec3<S> two(S(-0.57), S(0.76), S(0.31));
  // The steeper one would have a short projection, and swing with the smallest change of normal.
  const Vec3<S>& chosen = std::abs(normal.dot(one)) <= S(0.9) ? one : two;
  return chosen - normal.dot(chosen) * normal;
}

/// Which of `count` has the highest score above `more_than`, -1 when none has. A later one must win
/// by the factor 1 / `handicap`.
template <class S, class Score>
int highest(int count, S more_than, const Score& score, S handicap = S(1)) {
  int best = -1;
  S most = more_than;
  for (int i = 0; i < count; ++i) {
    const S value = score(i);
    if (handicap * value > most) {
      most = value;
      best = i;
    }
  }
  return best;
}
template <class S, class Score>
int highest(ContactPoints<S> points, S more_than, const Score& score, S handicap = S(1)) {
  return highest(count_of(points), more_than, score, handicap);
}

template <class S>
int support_point(ContactPoints<S> points, const Vec3<S>& direction) {
  const auto along = [&](int i) {
    return direction.dot(Vec3<S>(position(points, i) - position(points, 0)));
  };
  return highest(points, -std::numeric_limits<S>::infinity(), along);
}

template <class S>
int deepest_point(ContactPoints<S> points) {
  return highest(points, -std::numeric_limits<S>::infinity(),
                 [&](int i) { return -at(points, i).separation; });
}

/// `from` itself when all points coincide.
template <class S>
int farthest_from(ContactPoints<S> points, int from, S handicap = S(1)) {
  const auto distance = [&](int i) {
    return (position(points, i) - position(points, from)).squaredNorm();
  };
  const int farthest = highest(points, S(0), distance, handicap);
  return farthest < 0 ? from : farthest;
}

/// The farthest two of `count`, lower index first; 0 twice when no two are apart.
template <class S, class SquaredDistance>
std::array<int, 2> farthest_two(int count, const SquaredDistance& squared_distance) {
  std::array<int, 2> best = {0, 0};
  S most = S(0);
  for (int i = 0; i < count; ++i) {
    for (int k = i + 1; k < count; ++k) {
      const S distance = squared_distance(i, k);
      if (distance > most) {
        most = distance;
        best = {i, k};
      }
    }
  }
  return best;
}

/// Mean of the positions.
template <class S>
Vec3<S> centre(ContactPoints<S> points) {
  Vec3<S> sum = Vec3<S>::Zero();
  for (int i = 1; i < count_of(points); ++i) sum += position(points, i) - position(points, 0);
  return position(points, 0) + sum / S(count_of(points));
}

/// Twice the signed area of the triangle q, a, b; counter-clockwise seen against `normal` is
/// positive. The talk's 0.5 (QA x QB) . n without the factor.
template <class S>
S doubled_area(const Vec3<S>& q, const Vec3<S>& a, const Vec3<S>& b, const Vec3<S>& normal) {
  const Vec3<S> qa = a - q;
  const Vec3<S> qb = b - q;
  return qa.cross(qb).dot(normal);
}

/// Doubled areas up to here, over an edge as long as that from a to b, may be rounding. A
/// coordinate carries an error of half an ulp of its own size, so a difference of two of them does
/// too however small it is itself, and an area that error times the length of the edge.
template <class S>
S negligible_area(ContactPoints<S> points, int a, int b) {
  const S length = (position(points, b) - position(points, a)).norm();
  const S coordinate = position(points, a).cwiseAbs().maxCoeff() + length;
  return S(8) * std::numeric_limits<S>::epsilon() * coordinate * length;
}

/// The points farthest from the line through a and b on its left and right, -1 where none is.
template <class S>
std::array<int, 2> both_sides(ContactPoints<S> points, const Vec3<S>& normal, int a, int b) {
  const S negligible = negligible_area(points, a, b);
  const auto left = [&](int q) {
    return doubled_area(position(points, q), position(points, a), position(points, b), normal);
  };
  return {highest(points, negligible, left),
          highest(points, negligible, [&](int q) { return -left(q); })};
}

inline bool contains(const KeptIndices& kept, int index) {
  return std::find(kept.begin(), kept.end(), index) != kept.end();
}

/// Appends a choice unless it is none (-1) or was made before.
inline void add_once(KeptIndices& kept, int index) {
  if (index >= 0 && !contains(kept, index)) kept.push_back(index);
}

/// The first max_points choices.
inline KeptIndices first_of(KeptIndices choices, const ReduceOptions& options) {
  choices.truncate(std::min(choices.size(), static_cast<std::size_t>(options.max_points)));
  return choices;
}

/// Two points and the farthest on either side of the line through them; fewer where a side
/// is empty, or the two are one.
template <class S>
KeptIndices two_and_both_sides(ContactPoints<S> points, const Vec3<S>& normal, int first,
                               int second, const ReduceOptions& options) {
  const auto [left, right] = both_sides(points, normal, first, second);
  KeptIndices choices;
  for (const int index : {first, second, left, right}) add_once(choices, index);
  return first_of(choices, options);
}

}  // namespace contactscope::steps
