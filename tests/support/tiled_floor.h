#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "geometry/mesh.h"
#include "support/random_geometry.h"

namespace contactscope::test {

/// A flat square of half side `size` around the origin, up along y, cut at random into rectangles of
/// two triangles each. No two rectangles share a vertex: their edges meet in T-junctions, and each
/// vertex is off by up to `crack` metres in each direction.
class TiledFloor {
 public:
  TiledFloor(Random& random, double size, double crack) : random_(random), size_(size) {
    cut({-size, -size}, {size, size}, 4);
    for (Vec3d& vertex : vertices) vertex += random.vector(-crack, crack);
  }

  /// Whether edge k of a triangle is on the outline of the square.
  bool is_outer(int triangle, int k) const {
    const auto corner = [&](int i) -> const Vec3d& {
      const std::array<int, 3>& corners = triangles[static_cast<std::size_t>(triangle)];
      return vertices[static_cast<std::size_t>(corners[static_cast<std::size_t>(i % 3)])];
    };
    const Vec3d sum = corner(k) + corner(k + 1);
    return std::max(std::abs(sum.x()), std::abs(sum.z())) > 1.999 * size_;
  }

  double size() const { return size_; }
  /// Tile i has the vertices 4 i to 4 i + 3, around it.
  int tile_count() const { return static_cast<int>(vertices.size() / 4); }

  std::vector<Vec3d> vertices;
  std::vector<std::array<int, 3>> triangles;

 private:
  using Place = std::array<double, 2>;  // x and z

  void cut(const Place& low, const Place& high, int times) {
    const std::size_t axis = high[0] - low[0] > high[1] - low[1] ? 0 : 1;
    if (times == 0 || high[axis] - low[axis] < 0.3 * size_) return add(low, high);
    Place middle_low = low, middle_high = high;
    middle_low[axis] = middle_high[axis] =
        low[axis] + random_.uniform(0.3, 0.7) * (high[axis] - low[axis]);
    cut(low, middle_high, times - 1);
    cut(middle_low, high, times - 1);
  }

  void add(const Place& low, const Place& high) {
    const int first = static_cast<int>(vertices.size());
    for (const Place& place : {low, Place{low[0], high[1]}, high, Place{high[0], low[1]}})
      vertices.emplace_back(place[0], 0, place[1]);
    const int turn = random_.index(4);
    const auto corner = [&](int i) { return first + (i + turn) % 4; };
    triangles.push_back({corner(0), corner(1), corner(2)});
    triangles.push_back({corner(0), corner(2), corner(3)});
  }

  Random& random_;
  double size_;
};

}  // namespace contactscope::test
