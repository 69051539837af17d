#pragma once

#include "reduce/reducer.h"

namespace contactscope {
namespace steps {

/// Index below `count` of the highest score above `more_than`, -1 if none; the earliest among
/// equals. A later one must win by the factor 1 / `handicap`, and by more than `tie`.
template <class Score, class S = std::invoke_result_t<Score, int>>
int highest(int count, const Score& score, S more_than = -std::numeric_limits<S>::infinity(),
            S handicap = S(1), S tie = S(0)) {
  int best = -1;
  S most = more_than;
  for (int i = 0; i < count; ++i) {
    const S value = score(i);
    if (handicap * value > most + tie) {
      most = value;
      best = i;
    }
  }
  return best;
}

/// The farthest two, lower index first; 0 twice if all coincide. `tie`: square metres.
template <class S, class SquaredDistance>
std::array<int, 2> farthest_two(int count, const SquaredDistance& squared_distance, S tie = S(0)) {
  std::array<int, 2> best = {0, 0};
  S most = S(0);
  for (int i = 0; i < count; ++i) {
    for (int k = i + 1; k < count; ++k) {
      const S distance = squared_distance(i, k);
      if (distance > most + tie) {
        most = distance;
        best = {i, k};
      }
    }
  }
  return best;
}

/// Among the first `count` with holds(i), the next after `after` in the order of id(i), then index;
/// the first of all after -1. -1: none.
template <class Id, class Holds>
int next_by_id(int count, const Id& id, int after, const Holds& holds) {
  const auto is_before = [&](int i, int j) {
    const auto order = id(i) <=> id(j);
    return order < 0 || (order == 0 && i < j);
  };
  int next = -1;
  for (int i = 0; i < count; ++i)
    if (holds(i) && (after < 0 || is_before(after, i)) && (next < 0 || is_before(i, next)))
      next = i;
  return next;
}

/// A direction in the plane with unit `normal` that depends on it alone; not of unit length. It
/// avoids the coordinate axes of boxes and floors: two corners of an aligned box would be equally
/// far along an axis, and rounding would choose between them again in every frame.
template <class S> Vec3<S> fixed_direction(const Vec3<S>& normal) {
  const Vec3<S> one(S(0.76), S(0.31), S(0.57));
  const Vec3<S> two(S(-0.57), S(0.76), S(0.31));
  // The steeper one would have a short projection and swing with the smallest change of the normal.
  const Vec3<S>& chosen = std::abs(normal.dot(one)) <= S(0.9) ? one : two;
  return chosen - normal.dot(chosen) * normal;
}

/// 0, 1, 2 ...
inline KeptIndices numbers_up_to(int count) {
  KeptIndices numbers;
  for (int i = 0; i < count; ++i) numbers.push_back(i);
  return numbers;
}

inline bool contains(const KeptIndices& kept, int index) {
  return std::find(kept.begin(), kept.end(), index) != kept.end();
}

/// Appends a choice unless it is -1 or already contained.
inline void add_once(KeptIndices& kept, int index) {
  if (index >= 0 && !contains(kept, index)) kept.push_back(index);
}

inline KeptIndices first_of(KeptIndices choices, const ReduceOptions& options) {
  choices.truncate(std::min(choices.size(), static_cast<std::size_t>(options.max_points)));
  return choices;
}

}  // namespace steps

/// The points that a reducer chooses from, and the steps that several reducers share. All use
/// positions relative to one of the points, so that a place far from the origin loses no digits.
template <class S> struct Candidates {
  ContactPoints<S> points;
  const Vec3<S>& normal;  // unit
  int count() const { return count_of(points); }
  const Vec3<S>& operator[](int i) const { return at(points, i).position; }
  S separation(int i) const { return at(points, i).separation; }
  const FeatureId& id(int i) const { return at(points, i).id; }

  /// See steps::highest().
  template <class Score>
  int highest(const Score& score, S more_than = -std::numeric_limits<S>::infinity(),
              S handicap = S(1)) const {
    return steps::highest(count(), score, more_than, handicap);
  }
  int farthest_along(const Vec3<S>& direction) const {
    return highest([&](int i) { return direction.dot(Vec3<S>((*this)[i] - (*this)[0])); });
  }
  int deepest() const {
    return highest([&](int i) { return -separation(i); });
  }
  /// Separations this close, metres, are equally deep: rounding would choose among them.
  S depth_tie(const ReduceOptions& options) const {
    S scale = static_cast<S>(options.scale);
    if (!(scale > S(0)))
      for (int i = 0; i < count(); ++i)
        scale = std::max(
            {scale, ((*this)[i] - (*this)[0]).cwiseAbs().maxCoeff(), std::abs(separation(i))});
    // A separation is a sum of four products of unit vectors and coordinates, after a rotation of
    // as many: eight roundings of half an ulp (tie_tolerance()); two separations are compared.
    return S(8) * std::numeric_limits<S>::epsilon() * scale;
  }
  /// `from` itself if all points coincide.
  int farthest_from(int from, S handicap = S(1)) const {
    const auto distance = [&](int i) { return ((*this)[i] - (*this)[from]).squaredNorm(); };
    const int farthest = highest(distance, S(0), handicap);
    return farthest < 0 ? from : farthest;
  }
  /// See steps::next_by_id().
  template <class Holds> int next_by_id(int after, const Holds& holds) const {
    return steps::next_by_id(
        count(), [&](int i) { return id(i); }, after, holds);
  }
  /// The points with the previous frame's ids, in their order; equal ids by their order.
  KeptIndices kept_before(const ReduceOptions& options) const {
    KeptIndices found;
    for (const FeatureId& before : options.previous) {
      for (int i = 0; i < count(); ++i) {
        if (id(i) == before && !steps::contains(found, i)) {
          found.push_back(i);
          break;
        }
      }
    }
    return found;
  }
  Vec3<S> centre() const {
    Vec3<S> sum = Vec3<S>::Zero();
    for (int i = 1; i < count(); ++i) sum += (*this)[i] - (*this)[0];
    return (*this)[0] + sum / S(count());
  }
  /// Twice the signed area of the triangle q, a, b; positive if counter-clockwise seen against the
  /// normal. The talk's 0.5 (QA x QB) . n without the factor.
  S doubled_area(int q, int a, int b) const {
    const Vec3<S> qa = (*this)[a] - (*this)[q];
    const Vec3<S> qb = (*this)[b] - (*this)[q];
    return qa.cross(qb).dot(normal);
  }
  /// Doubled areas up to this, over an edge from a to b, may be rounding: a coordinate, and a
  /// difference of two, has an error of half an ulp; an area that times the length of the edge.
  S negligible_area(int a, int b) const {
    const S length = ((*this)[b] - (*this)[a]).norm();
    const S coordinate = (*this)[a].cwiseAbs().maxCoeff() + length;
    return S(8) * std::numeric_limits<S>::epsilon() * coordinate * length;
  }
  /// The points farthest from the line through a and b on its left and right; -1 if there is none.
  std::array<int, 2> both_sides(int a, int b) const {
    const S negligible = negligible_area(a, b);
    return {highest([&](int q) { return doubled_area(q, a, b); }, negligible),
            highest([&](int q) { return -doubled_area(q, a, b); }, negligible)};
  }
  /// Two points and the farthest on either side of their line; fewer if a side is empty.
  KeptIndices two_and_both_sides(int first, int second, const ReduceOptions& options) const {
    const auto [left, right] = both_sides(first, second);
    KeptIndices choices;
    for (const int index : {first, second, left, right}) steps::add_once(choices, index);
    return steps::first_of(choices, options);
  }
};

/// The row of a reducer: a stateless function object that takes candidates in either scalar.
template <class Reduce>
ReducerInfo listed(std::string name, std::string summary, const Reduce&, bool remembers = false) {
  const auto run = []<class S>(ContactPoints<S> points, const Vec3<S>& normal,
                               const ReduceOptions& options) {
    return Reduce{}(Candidates<S>{points, normal}, options);
  };
  return {std::move(name), std::move(summary), run, run, remembers};
}

/// The result of `area` for five to eight points, keeping four, without a record: the same
/// points in the same order, with each score measured for all points at once. Most manifolds have
/// no more points: two boxes with face contact have at most eight.
///
/// Returns false and keeps nothing if all points are on a line, or if squared lengths leave the
/// range of S. The reducer then proceeds point by point.
template <class S> bool area_of_eight(const Candidates<S>& points, KeptIndices& kept);

}  // namespace contactscope
