#include "continuous/portal_cast.h"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <optional>

#include "support/random_geometry.h"

namespace contactscope {
namespace {

using test::Random;
using Extended = long double;
using Point = Eigen::Matrix<Extended, 3, 1>;

/// By regions of the plane (the nearest of three segments, or the foot if it is inside).
Extended distance_to_triangle(const Point& p, const std::array<Point, 3>& corners) {
  Extended least = INFINITY;
  for (std::size_t i = 0; i < 3; ++i) {
    const Point from = corners[i], along = corners[(i + 1) % 3] - from;
    const Extended squared = along.squaredNorm();
    const Extended at =
        squared > 0 ? std::clamp<Extended>((p - from).dot(along) / squared, 0, 1) : 0;
    least = std::min(least, (p - from - at * along).norm());
  }
  const Point u = corners[1] - corners[0], v = corners[2] - corners[0], q = p - corners[0];
  const Extended uu = u.dot(u), uv = u.dot(v), vv = v.dot(v), uq = u.dot(q), vq = v.dot(q);
  const Extended determinant = uu * vv - uv * uv;
  if (!(determinant > 0)) return least;
  const Extended s = (vv * uq - uv * vq) / determinant, t = (uu * vq - uv * uq) / determinant;
  if (s >= 0 && t >= 0 && s + t <= 1) least = std::min(least, (q - s * u - t * v).norm());
  return least;
}

struct Case {
  Vec3d start, offset;
  double radius;
  std::array<Vec3d, 3> triangle;
};

/// The first time at which the centre is within `radius`, by steps as long as the distance allows.
std::optional<Extended> marched(const Case& of, Extended radius) {
  std::array<Point, 3> corners;
  for (std::size_t i = 0; i < 3; ++i) corners[i] = of.triangle[i].cast<Extended>();
  const Point start = of.start.cast<Extended>(), offset = of.offset.cast<Extended>();
  const Extended speed = offset.norm();
  Extended time = 0;
  for (int i = 0; i < 100'000; ++i) {
    const Extended gap = distance_to_triangle(start + time * offset, corners) - radius;
    if (gap <= 1e-12L * radius) return time;
    time += gap / speed;
    if (time > 1) return std::nullopt;
  }
  return time;
}

Case random_case(Random& random, double size) {
  Case of;
  const Vec3d place = size * random.vector(-1, 1);
  of.triangle[0] = place;
  const Vec3d along = size * random.unit_vector();
  of.triangle[1] = place + along;
  switch (random.index(6)) {
    case 0:  // a needle
      of.triangle[2] = place + random.uniform(0, 1) * along;
      of.triangle[2] += 1e-6 * size * random.unit_vector();
      break;
    case 1:  // without area
      of.triangle[2] = place + 0.5 * along;
      break;
    default:
      of.triangle[2] = place + size * random.unit_vector();
  }
  of.radius = size * random.decade(-3, 0.5);
  of.start = place + (2 * size + 2 * of.radius) * random.unit_vector();
  const double a = random.uniform(-0.3, 1), b = random.uniform(-0.3, 1);
  const Vec3d aside = of.radius * random.vector(-1.2, 1.2);
  const Vec3d aim = of.triangle[0] + a * (of.triangle[1] - of.triangle[0]) +
                    b * (of.triangle[2] - of.triangle[0]) + aside;
  of.offset = random.decade(-0.5, 1) * (aim - of.start);
  return of;
}

template <class S> void compare_with_marching(double away, double slack) {
  Random random(11);
  int hits[3] = {}, separated = 0;
  for (int i = 0; i < 20'000; ++i) {
    const double size = random.decade(-3, 2);
    Case of = random_case(random, away > 0 ? 1.0 : size);
    const Vec3d by = away * random.unit_vector();
    // The rounded numbers that the function gets.
    const auto rounded = [](const Vec3d& v) { return Vec3<S>(v.cast<S>()); };
    const std::array<Vec3<S>, 3> triangle = {
        rounded(of.triangle[0] + by), rounded(of.triangle[1] + by), rounded(of.triangle[2] + by)};
    const Vec3<S> start = rounded(of.start + by), offset = rounded(of.offset);
    const S radius = static_cast<S>(of.radius);
    for (std::size_t k = 0; k < 3; ++k) of.triangle[k] = triangle[k].template cast<double>();
    of.start = start.template cast<double>();
    of.offset = offset.template cast<double>();
    of.radius = static_cast<double>(radius);

    const SweptSphereHit found = sweep_sphere_triangle(start, offset, radius, triangle);
    // A hit of a slightly smaller ball must be found; a miss of a slightly larger ball must be one.
    const auto surely = marched(of, of.radius * (1 - slack));
    const auto perhaps = marched(of, of.radius * (1 + slack));
    if (surely) {
      ASSERT_EQ(found.status, SweptStatus::Hit) << i;
      EXPECT_LE(found.time, static_cast<double>(*surely) + 1e-9) << i;
    }
    if (!perhaps) {
      ASSERT_EQ(found.status, SweptStatus::Separated) << i;
      EXPECT_EQ(found.time, 1);
    }
    if (found.status == SweptStatus::Hit) {
      ASSERT_TRUE(perhaps) << i;
      EXPECT_GE(found.time, static_cast<double>(*perhaps) - 1e-9) << i;
      const Vec3d point = found.point + of.triangle[0];
      const Vec3d centre = of.start + found.time * of.offset;
      EXPECT_NEAR((centre - point).norm() / of.radius, 1, 1e-6) << i;
      EXPECT_NEAR((centre - point).normalized().dot(found.normal), 1, 1e-6) << i;
      const auto corner = of.triangle[static_cast<std::size_t>(found.index)];
      if (found.feature == TriangleFeature::Vertex) {
        EXPECT_LE((point - corner).norm(), 1e-9 * (1 + away) * (1 + of.radius)) << i;
      }
      ++hits[static_cast<int>(found.feature)];
    } else {
      ++separated;
    }
  }
  for (const int count : hits) EXPECT_GT(count, 500);
  EXPECT_GT(separated, 500);
}

TEST(SweptSphere, SlowMatchesMarching) {
  compare_with_marching<double>(0, 1e-9);
  compare_with_marching<float>(0, 1e-9);
}

TEST(SweptSphere, SlowIsRightAKilometreFromTheOrigin) { compare_with_marching<float>(1000, 1e-9); }

TEST(SweptSphere, DistinguishesInitialOverlapFromAHit) {
  const std::array<Vec3d, 3> triangle = {Vec3d(0, 0, 0), Vec3d(1, 0, 0), Vec3d(0, 1, 0)};
  const Vec3d down(0, 0, -1);
  EXPECT_EQ(sweep_sphere_triangle(Vec3d(0.2, 0.2, 0.1), down, 0.2, triangle).status,
            SweptStatus::Overlapping);
  EXPECT_EQ(sweep_sphere_triangle(Vec3d(-0.1, 0.2, 0), down, 0.2, triangle).status,
            SweptStatus::Overlapping);
  const SweptSphereHit hit = sweep_sphere_triangle(Vec3d(0.2, 0.2, 0.7), down, 0.2, triangle);
  EXPECT_EQ(hit.status, SweptStatus::Hit);
  EXPECT_EQ(hit.feature, TriangleFeature::Face);
  EXPECT_NEAR(hit.time, 0.5, 1e-15);
  // From below it is the same triangle.
  const SweptSphereHit below =
      sweep_sphere_triangle(Vec3d(0.2, 0.2, -0.7), Vec3d(0, 0, 1), 0.2, triangle);
  EXPECT_EQ(below.feature, TriangleFeature::Face);
  EXPECT_NEAR(below.time, 0.5, 1e-15);
  EXPECT_NEAR(below.normal.z(), -1, 1e-15);
}

TEST(SweptSphere, NamesFeaturesByTheCallersNumbersFromBothSides) {
  const std::array<Vec3d, 3> triangle = {Vec3d(0, 0, 0), Vec3d(2, 0, 0), Vec3d(0, 2, 0)};
  for (const double side : {1.0, -1.0}) {
    const Vec3d offset(0, 0, -side);
    const auto fall = [&](double x, double y) {
      return sweep_sphere_triangle(Vec3d(x, y, side), offset, 0.25, triangle);
    };
    const std::array<Vec3d, 3> outside_edges = {Vec3d(1, -0.1, 0), Vec3d(1.1, 1.1, 0),
                                                Vec3d(-0.1, 1, 0)};
    const std::array<Vec3d, 3> outside_vertices = {Vec3d(-0.1, -0.1, 0), Vec3d(2.2, 0, 0),
                                                   Vec3d(0, 2.2, 0)};
    for (int i = 0; i < 3; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const SweptSphereHit edge = fall(outside_edges[k].x(), outside_edges[k].y());
      EXPECT_EQ(edge.feature, TriangleFeature::Edge);
      EXPECT_EQ(edge.index, i);
      const SweptSphereHit vertex = fall(outside_vertices[k].x(), outside_vertices[k].y());
      EXPECT_EQ(vertex.feature, TriangleFeature::Vertex);
      EXPECT_EQ(vertex.index, i);
    }
  }
}

}  // namespace
}  // namespace contactscope
