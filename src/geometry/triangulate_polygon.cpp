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

/// Ear clipping. An ear is a corner that turns left and whose triangle holds no other corner, its
/// rim included. Deviation: of all ears the one with the shortest cut goes first, which makes fewer
/// slivers than cutting in order. Steps: rate all corners; cut the best ear; rate its two
/// neighbours anew, which are the only ones that the cut can change; go on until three are left.
class EarClipper {
 public:
  explicit EarClipper(std::vector<Vec2d> corners) : corners_(std::move(corners)) {
    const int count = static_cast<int>(corners_.size());
    for (int i = 0; i < count; ++i) loop_.push_back(i);
    for (std::size_t at = 0; at < loop_.size(); ++at) cuts_.push_back(cut_length(at));
  }

  std::vector<std::array<int, 3>> run() {
    std::vector<std::array<int, 3>> triangles;
    while (loop_.size() > 3) {
      // Where no ear is left, because the polygon crosses itself, all are equally bad.
      const std::size_t at =
          static_cast<std::size_t>(std::min_element(cuts_.begin(), cuts_.end()) - cuts_.begin());
      triangles.push_back({loop_[before(at)], loop_[at], loop_[after(at)]});
      loop_.erase(loop_.begin() + static_cast<std::ptrdiff_t>(at));
      cuts_.erase(cuts_.begin() + static_cast<std::ptrdiff_t>(at));
      const std::size_t next = at % loop_.size();
      cuts_[next] = cut_length(next);
      cuts_[before(next)] = cut_length(before(next));
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

  /// Square of the length of the cut that takes the corner off; infinite where it is no ear.
  double cut_length(std::size_t at) const {
    constexpr double kNoEar = std::numeric_limits<double>::infinity();
    const Vec2d& a = corner(before(at));
    const Vec2d& b = corner(at);
    const Vec2d& c = corner(after(at));
    if (!(turn(a, b, c) > 0)) return kNoEar;
    for (const int i : loop_) {
      const Vec2d& p = corners_[static_cast<std::size_t>(i)];
      // Also other corners in the same place: outlines of holes are often joined by a double edge.
      if (p == a || p == b || p == c) continue;
      if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return kNoEar;
    }
    return (c - a).squaredNorm();
  }

  std::vector<Vec2d> corners_;
  std::vector<int> loop_;     // what is left, in order
  std::vector<double> cuts_;  // for each of loop_
};

}  // namespace

std::vector<std::array<int, 3>> triangulate_polygon(std::span<const Vec3d> corners) {
  assert(corners.size() >= 3);
  return EarClipper(flattened(corners)).run();
}

}  // namespace contactscope
