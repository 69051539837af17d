#pragma once

#include "reduce/steps.h"
#include "trace/trace.h"

namespace contactscope {

/// Record of a reducer's choices, written by the reducer as it runs: Gregorius 2015, "Contact Point
/// Reduction: 1st Point" to "4th Point (6)" and "AABB (1)" to "(3)". One entry per kept point, in
/// the order of choice, with the measure of every candidate at that step, computed here in double
/// whatever the reducer's scalar. Reducers without such steps record nothing.
class Choices {
 public:
  Candidates<double> points;  // the reducer's input, exactly
  std::vector<trace::Choice> made{};

  /// The farthest point along a unit direction.
  void support(const Vec3d& direction);
  void deepest();
  /// The one of equally deep points, `ties`, with the largest area; `areas` in square metres.
  void equally_deep(std::span<const int> ties, std::span<const double> areas);
  /// The farthest point from a given one.
  void farthest(int from);
  /// The point that makes the largest triangle with two others.
  void triangle(int first, int second);
  /// The point that adds the largest area outside an edge of a ring of kept points,
  /// counter-clockwise seen against the normal; or, `by_distance`, is farthest outside one. Records
  /// each candidate's deciding measure (the least over the edges; negative outside), and for
  /// `chosen` those of all edges, starting at the first kept point.
  void outside(std::span<const int> ring, int first, int chosen, bool by_distance);

 private:
  /// Records value(point), measured against `edge`, for all points except `taken`.
  template <class Value>
  trace::Choice& add(const char* rule, std::initializer_list<int> taken,
                     const std::array<int, 2>& edge, const Value& value);
};

}  // namespace contactscope
