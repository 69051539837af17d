#include "geometry/triangulate_polygon.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <limits>

#include "core/convex_polygon.h"

namespace contactscope {
namespace {

/// The corners seen along the coordinate axis that the polygon's normal leans on most, so that it
/// runs counter-clockwise. Dropping a coordinate rounds nothing: corners on a line stay on it.
std::vector<Vec2d> flattened(std::span<const Vec3d> corners) {
  Vec3d normal = Vec3d::Zero();
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    const Vec3d one = corners[i] - corners[0];
    const Vec3d other = corners[i + 1] - corners[0];
    normal += one.cross(other);
  }
  int axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  int u = (axis + 1) % 3;
  int v = (axis + 2) % 3;
  if (normal[axis] < 0) std::swap(u, v);
  std::vector<Vec2d> flat;
  for (const Vec3d& corner : corners) flat.emplace_back(corner[u], corner[v]);
  return flat;
}

double turn(const Vec2d& a, const Vec2d& b, const Vec2d& c) {
  return cross(Vec2d(b - a), Vec2d(c - a));
}

/// What rounding of the coordinates makes of a turn that is 0. Corners that were written on a line
/// are off it by some of these, and should not be taken for a bend.
double rounding_of_turns(const std::vector<Vec2d>& corners) {
  double coordinate = 0;
  double length = 0;
  for (const Vec2d& corner : corners) {
    coordinate = std::max(coordinate, corner.cwiseAbs().maxCoeff());
    length = std::max(length, (corner - corners[0]).cwiseAbs().maxCoeff());
  }
  return 8 * std::numeric_limits<double>::epsilon() * coordinate * length;
}

/// Ear clipping. An ear is a corner that turns left and whose triangle holds no other corner, its
/// rim included. Deviation: of all ears the least flat one goes first, which makes fewer slivers
/// than cutting in order, and leaves corners on a line until they are no longer. Steps: rate all
/// corners; cut the best ear; rate its two neighbours anew, which are the only ones that the cut
/// can change; go on until three are left.
class EarClipper {
 public:
  explicit EarClipper(std::vector<Vec2d> corners)
      : corners_(std::move(corners)), rounding_(rounding_of_turns(corners_)) {
    const int count = static_cast<int>(corners_.size());
    for (int i = 0; i < count; ++i) loop_.push_back(i);
    for (std::size_t at = 0; at < loop_.size(); ++at) flatness_.push_back(flatness(at));
  }

  std::vector<std::array<int, 3>> run() {
    std::vector<std::array<int, 3>> triangles;
    while (loop_.size() > 3) {
      // Where no ear is left, because the polygon crosses itself, all are equally bad.
      const std::size_t at = static_cast<std::size_t>(
          std::min_element(flatness_.begin(), flatness_.end()) - flatness_.begin());
      triangles.push_back({loop_[before(at)], loop_[at], loop_[after(at)]});
      loop_.erase(loop_.begin() + static_cast<std::ptrdiff_t>(at));
      flatness_.erase(flatness_.begin() + static_cast<std::ptrdiff_t>(at));
      const std::size_t next = at % loop_.size();
      flatness_[next] = flatness(next);
      flatness_[before(next)] = flatness(before(next));
    }
    triangles.push_back({loop_[0], loop_[1], loop_[2]});
    return triangles;
  }

 private:
  std::size_t before(std::size_t at) const { return at == 0 ? loop_.size() - 1 : at - 1; }
  std::size_t after(std::size_t at) const { return at + 1 == loop_.size() ? 0 : at + 1; }
  const Vec2d& corner(std::size_t at) const {
    return corners_[static_cast<std::size_t>(loop_[at])];
  }

  /// Length of the cut that takes the corner off over its distance from it; infinite where it is
  /// no ear.
  double flatness(std::size_t at) const {
    constexpr double kNoEar = std::numeric_limits<double>::infinity();
    const Vec2d& a = corner(before(at));
    const Vec2d& b = corner(at);
    const Vec2d& c = corner(after(at));
    const double area = turn(a, b, c);  // twice the triangle's
    if (!(area > rounding_)) return kNoEar;
    for (const int i : loop_) {
      const Vec2d& p = corners_[static_cast<std::size_t>(i)];
      // Also other corners in the same place: outlines of holes are often joined by a double edge.
      if (p == a || p == b || p == c) continue;
      if (std::min({turn(a, b, p), turn(b, c, p), turn(c, a, p)}) >= -rounding_) return kNoEar;
    }
    return (c - a).squaredNorm() / area;
  }

  std::vector<Vec2d> corners_;
  double rounding_;
  std::vector<int> loop_;         // what is left, in order
  std::vector<double> flatness_;  // of each of loop_
};

}  // namespace

std::vector<std::array<int, 3>> triangulate_polygon(std::span<const Vec3d> corners) {
  assert(corners.size() >= 3);
  return EarClipper(flattened(corners)).run();
}

}  // namespace contactscope
