#include "geometry/point_sets.h"

#include <array>
#include <cmath>
#include <numbers>
#include <set>

namespace contactscope::test {
namespace {

double uniform(Generator& random) { return std::uniform_real_distribution<double>(-1, 1)(random); }

}  // namespace

Points in_box(Generator& random, int count, const Vec3d& half_extents) {
  Points points;
  for (int i = 0; i < count; ++i) {
    const double x = uniform(random);
    const double y = uniform(random);
    const double z = uniform(random);
    points.emplace_back(half_extents.cwiseProduct(Vec3d(x, y, z)));
  }
  return points;
}

Points in_ball(Generator& random, int count) {
  Points points;
  while (static_cast<int>(points.size()) < count) {
    const Vec3d point = in_box(random, 1, Vec3d::Ones())[0];
    if (point.norm() <= 1) points.push_back(point);
  }
  return points;
}

Points gaussian(Generator& random, int count) {
  std::normal_distribution<double> normal(0, 0.3);
  Points points;
  for (int i = 0; i < count; ++i) {
    const double x = normal(random);
    const double y = normal(random);
    const double z = normal(random);
    points.emplace_back(x, y, z);
  }
  return points;
}

Points on_sphere(Generator& random, int count) {
  Points points = gaussian(random, count);
  for (Vec3d& point : points) point.normalize();
  return points;
}

Points box_grid(int cells) {
  Points points;
  for (int i = 0; i <= cells; ++i) {
    for (int j = 0; j <= cells; ++j) {
      for (int k = 0; k <= cells; ++k) points.emplace_back(Vec3d(i, j, k) / cells);
    }
  }
  for (Vec3d& point : points) point.array() -= 0.5;
  return points;
}

Points prism(int segments) {
  Points points;
  for (int i = 0; i < segments; ++i) {
    const double angle = 2 * std::numbers::pi * i / segments;
    points.emplace_back(0.5 * std::cos(angle), -0.5, 0.5 * std::sin(angle));
    points.emplace_back(0.5 * std::cos(angle), 0.5, 0.5 * std::sin(angle));
  }
  return points;
}

Points globe(int rings, int segments) {
  Points points = {Vec3d(0, 1, 0), Vec3d(0, -1, 0)};
  for (int i = 1; i < rings; ++i) {
    const double polar = std::numbers::pi * i / rings;
    for (int j = 0; j < segments; ++j) {
      const double angle = 2 * std::numbers::pi * j / segments;
      points.emplace_back(std::sin(polar) * std::cos(angle), std::cos(polar),
                          std::sin(polar) * std::sin(angle));
    }
  }
  return points;
}

Mat3<double> random_rotation(Generator& random) {
  const Points columns = on_sphere(random, 2);
  Quat<double> rotation = Quat<double>::FromTwoVectors(columns[0], columns[1]);
  rotation = rotation * Eigen::AngleAxisd(std::numbers::pi * uniform(random), columns[0]);
  return rotation.normalized().toRotationMatrix();
}

Points transformed(const Points& points, const Mat3<double>& rotation, double scale,
                   const Vec3d& offset) {
  Points moved;
  for (const Vec3d& point : points) moved.emplace_back(scale * (rotation * point) + offset);
  return moved;
}

Points rounded_to_float(const Points& points) {
  Points rounded;
  for (const Vec3d& point : points) rounded.emplace_back(point.cast<float>().cast<double>());
  return rounded;
}

Points rounded_to_decimals(const Points& points, int digits) {
  const double unit = std::pow(10.0, digits);
  Points rounded;
  for (const Vec3d& point : points) {
    rounded.emplace_back((unit * point).array().round().matrix() / unit);
  }
  return rounded;
}

Points without_repeats(const Points& points) {
  std::set<std::array<double, 3>> seen;
  Points distinct;
  for (const Vec3d& point : points) {
    if (seen.insert({point.x(), point.y(), point.z()}).second) distinct.push_back(point);
  }
  return distinct;
}

}  // namespace contactscope::test
