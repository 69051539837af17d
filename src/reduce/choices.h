#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "core/manifold.h"
#include "trace/trace.h"

namespace contactscope {

/// Record of how a reducer chooses, told by the reducer as it does: Gregorius 2015, "Contact Point
/// Reduction: 1st Point" to "4th Point (6)" and "AABB (1)" to "(3)". One entry for each point that
/// was kept, in the order of choice, with what every candidate was worth at that step. Measured here
/// in double, whatever the reducer computes with. Reducers that do not choose in such steps tell
/// nothing.
class Choices {
 public:
  using Points = std::span<const ContactPoint<double>>;

  /// What the reducer gets, exactly. `points` must outlive this.
  Choices(Points points, const Vec3d& normal) : points_(points), normal_(normal) {}

  const Vec3d& normal() const { return normal_; }
  const std::vector<trace::Choice>& made() const { return made_; }

  /// The farthest point along a unit direction.
  void support(const Vec3d& direction);
  void deepest();
  /// The farthest from a point.
  void farthest(int from);
  /// What makes the largest triangle with two points.
  void triangle(int first, int second);
  /// What adds the largest area outside an edge of a ring of kept points, counter-clockwise seen
  /// against the normal; or, `by_distance`, lies farthest outside of one. Of each candidate the
  /// measure of the edge that decides (the least; negative outside), and of the `chosen` one those
  /// of all edges, from the first kept point on.
  void outside(std::span<const int> ring, int first, int chosen, bool by_distance);
  /// A choice is taken back: only the first `count` stand.
  void keep(std::size_t count) { made_.resize(std::min(count, made_.size())); }

 private:
  const Vec3d& at(int point) const { return points_[static_cast<std::size_t>(point)].position; }
  int count() const { return static_cast<int>(points_.size()); }
  double signed_area(int q, int a, int b) const;
  trace::Choice& add(const char* rule);

  Points points_;
  Vec3d normal_;
  std::vector<trace::Choice> made_;
};

}  // namespace contactscope
