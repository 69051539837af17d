#include "support/random_triangles.h"

#include <cmath>

namespace contactscope::test {
namespace {

Vec3d in_cube(Random& random) {
  return {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
}
Vec3d on_grid(Random& random, int side) {
  return {1.0 * random.index(side), 1.0 * random.index(side), 1.0 * random.index(side)};
}

Triangle<double> random_triangle(Random& random) {
  return {in_cube(random), in_cube(random), in_cube(random)};
}
Triangle<double> grid_triangle(Random& random) {
  return {on_grid(random, 4), on_grid(random, 4), on_grid(random, 4)};
}
Triangle<double> degenerate_triangle(Random& random) {
  Triangle<double> t = grid_triangle(random);
  t[2] = 2 * t[1] - t[0];
  if (random.chance(0.3)) t[1] = t[0];
  if (random.chance(0.2)) t[2] = t[1];
  std::swap(t[1], at(t, random.index(3)));
  return t;
}

/// A point in the plane of a triangle, on an edge, or in its area.
Vec3d point_of(Random& random, const Triangle<double>& t, double least, double most, bool on_edge) {
  const double u = random.uniform(least, most);
  const double v = on_edge ? 0 : random.uniform(least, most) * (1 - u);
  return t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]);
}

Vec3d nudged(Random& random, const Vec3d& point, double unit) {
  return point + unit * Vec3d(random.index(5) - 2, random.index(5) - 2, random.index(5) - 2);
}

TrianglePair coplanar(Random& random) {
  if (random.chance(0.5)) {
    TrianglePair pair{random_triangle(random), random_triangle(random)};
    const int axis = random.index(3);
    const double height = random.uniform(-1, 1);
    for (Triangle<double>* t : {&pair.first, &pair.second})
      for (Vec3d& corner : *t) corner[axis] = height;
    return pair;
  }
  // Corners o + i u + j v with small integers, exact in float.
  const Vec3d o = on_grid(random, 64), u = on_grid(random, 64), v = on_grid(random, 64);
  const auto corner = [&]() -> Vec3d {
    return (o + (random.index(9) - 4) * u + (random.index(9) - 4) * v) / 256;
  };
  return {{corner(), corner(), corner()}, {corner(), corner(), corner()}};
}

TrianglePair touching(Random& random) {
  TrianglePair pair{random_triangle(random), random_triangle(random)};
  auto& [a, b] = pair;
  for (Vec3d& corner : a) corner = (corner * 1024).array().round() / 1024;
  at(b, random.index(3)) = a[0];
  if (random.chance(0.4)) at(b, random.index(3)) = a[1];
  if (random.chance(0.3)) b[0] = (a[0] + a[1]) / 2;
  if (random.chance(0.3)) b[0] = (2 * a[0] + a[1] + a[2]) / 4;
  return pair;
}

TrianglePair unscaled(Random& random, TrianglePairs how, double unit) {
  using enum TrianglePairs;
  switch (how) {
    case Random:
      break;
    case Coplanar:
      return coplanar(random);
    case Touching:
      return touching(random);
    case Grid:
      return {grid_triangle(random), grid_triangle(random)};
    case Degenerate: {
      TrianglePair pair{degenerate_triangle(random), grid_triangle(random)};
      if (random.chance(0.3)) pair.second = degenerate_triangle(random);
      if (random.chance(0.5)) std::swap(pair.first, pair.second);
      return pair;
    }
    case NearlyCoplanar: {
      TrianglePair pair{random_triangle(random), {}};
      for (Vec3d& corner : pair.second)
        corner = nudged(random, point_of(random, pair.first, -1, 2, false), unit);
      return pair;
    }
    case NearlyTouching: {
      TrianglePair pair{random_triangle(random), random_triangle(random)};
      at(pair.second, random.index(3)) =
          nudged(random, point_of(random, pair.first, 0, 1, random.chance(0.5)), unit);
      return pair;
    }
  }
  return {random_triangle(random), random_triangle(random)};
}

}  // namespace

TrianglePair random_triangle_pair(Random& random, TrianglePairs how, double size,
                                  const Vec3d& center, bool in_float) {
  TrianglePair pair = unscaled(random, how, in_float ? 0x1p-23 : 0x1p-52);
  for (Triangle<double>* t : {&pair.first, &pair.second}) {
    for (Vec3d& corner : *t) {
      corner = center + size * corner;
      if (in_float) corner = corner.cast<float>().cast<double>();
    }
  }
  return pair;
}

TrianglePairs draw_from_mix(Random& random) {
  const double chosen = random.uniform(0, 100);
  if (chosen < 3.5) return TrianglePairs::Coplanar;
  if (chosen < 7) return TrianglePairs::Touching;
  return chosen < 8 ? TrianglePairs::NearlyCoplanar : TrianglePairs::Random;
}

}  // namespace contactscope::test
