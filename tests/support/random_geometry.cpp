#include "support/random_geometry.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "geometry/hull_builder.h"
#include "geometry/primitives.h"

namespace contactscope::test {

double Random::uniform(double low, double high) {
  const double unit = static_cast<double>(engine_() >> 11) * 0x1p-53;
  return low + (high - low) * unit;
}

double Random::decade(double low_exponent, double high_exponent) {
  return std::pow(10.0, uniform(low_exponent, high_exponent));
}

int Random::index(int count) { return static_cast<int>(uniform(0, count)); }

Vec3d Random::vector(double low, double high) {
  const double z = uniform(low, high), y = uniform(low, high);
  return {uniform(low, high), y, z};
}

Vec3d Random::level(double reach, double y) {
  const double z = uniform(-reach, reach);
  return {uniform(-reach, reach), y, z};
}

Vec3d Random::unit_vector() {
  for (;;) {
    const Vec3d v = vector(-1, 1);
    const double squared = v.squaredNorm();
    if (squared > 0.01 && squared < 1) return v / std::sqrt(squared);
  }
}

Quatd Random::rotation() {
  // Shoemake, "Uniform Random Rotations", Graphics Gems III, 1992.
  const double split = uniform(0, 1);
  const double first = uniform(0, 2 * std::numbers::pi);
  const double second = uniform(0, 2 * std::numbers::pi);
  const double inner = std::sqrt(1 - split);
  const double outer = std::sqrt(split);
  return Quatd(outer * std::cos(second), inner * std::sin(first), inner * std::cos(first),
               outer * std::sin(second))
      .normalized();
}

Quatd Random::rotation_by(double angle) { return Quatd(Eigen::AngleAxisd(angle, unit_vector())); }

Pose<double> Random::pose(double radius) {
  const Quatd turned = rotation();
  const Vec3d direction = unit_vector();
  return {turned, radius * std::cbrt(uniform(0, 1)) * direction};
}

namespace {

Vec3d random_axes(Random& random, double size, double aspect) {
  const double decades = std::log10(aspect);
  return {size * random.decade(-decades, 0), size * random.decade(-decades, 0),
          size * random.decade(-decades, 0)};
}

}  // namespace

Hull<double> random_box(Random& random, double size, double aspect) {
  return make_box(random_axes(random, size, aspect));
}

Hull<double> random_hull(Random& random, int vertices, double size, double aspect) {
  const Vec3d axes = random_axes(random, size, aspect);
  const Quatd turn = random.rotation();
  std::vector<Vec3d> points;
  for (int i = 0; i < vertices; ++i) {
    points.push_back(turn * Vec3d(axes.cwiseProduct(random.unit_vector())));
  }
  return build_hull(points);
}

}  // namespace contactscope::test
