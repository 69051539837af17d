#pragma once

#include <initializer_list>
#include <span>
#include <vector>

#include "reduce/steps.h"
#include "trace/trace.h"

namespace contactscope {

/// Record of how a reducer chooses, told by the reducer as it does: Gregorius 2015, "Contact Point
/// Reduction: 1st Point" to "4th Point (6)" and "AABB (1)" to "(3)". One entry for each point that
/// was kept, in the order of choice, with what every candidate was worth at that step. Measured here
/// in double, whatever the reducer computes with. Reducers that do not choose in such steps tell
/// nothing.
class Choices {
 public:
  Candidates<double> points;  // what the reducer gets, exactly
  std::vector<trace::Choice> made{};

  /// The farthest point along a unit direction.
  void support(const Vec3d& direction);
  void deepest();
  /// Of equally deep points, `ties`, the one from which the steps keep the largest area; `areas` in square
  /// metres.
  void equally_deep(std::span<const int> ties, std::span<const double> areas);
  /// The farthest from a point.
  void farthest(int from);
  /// What makes the largest triangle with two points.
  void triangle(int first, int second);
  /// What adds the largest area outside an edge of a ring of kept points, counter-clockwise seen
  /// against the normal; or, `by_distance`, lies farthest outside of one. Of each candidate the
  /// measure of the edge that decides (the least; negative outside), and of the `chosen` one those
  /// of all edges, from the first kept point on.
  void outside(std::span<const int> ring, int first, int chosen, bool by_distance);

 private:
  /// Of all points but those `taken` what value(point) is, measured against `edge`.
  template <class Value>
  trace::Choice& add(const char* rule, std::initializer_list<int> taken,
                     const std::array<int, 2>& edge, const Value& value);
};

}  // namespace contactscope
