#include "field/distance_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/input_error.h"
#include "geometry/primitives.h"
#include "support/random_geometry.h"
#include "support/sphere_mesh.h"
#include "support/surface_oracle.h"

namespace contactscope {
namespace {

using test::Random;
using test::SurfaceOracle;

/// Distance to the surface of a box about the origin.
double box_distance(const Vec3d& half, const Vec3d& p) {
  const Vec3d beyond = p.cwiseAbs() - half;
  const Vec3d outside = beyond.cwiseMax(0.0);
  return outside.norm() + std::min(beyond.maxCoeff(), 0.0);
}

double capsule_distance(const Capsule<double>& c, const Vec3d& p) {
  const Vec3d along = c.points[1] - c.points[0];
  const double t =
      std::clamp(along.dot(p - c.points[0]) / std::max(along.squaredNorm(), 1e-300), 0.0, 1.0);
  return (p - c.points[0] - t * along).norm() - c.radius;
}

TEST(DistanceField, ExactDistancesOfRoundShapesAndBoxesAtEveryScale) {
  Random random(1);
  for (int i = 0; i < 12; ++i) {
    const double size = random.decade(-4, 4);
    const Vec3d half = size * Vec3d(1, random.uniform(0.2, 1), random.uniform(0.2, 1));
    const Capsule<double> capsule{{random.vector(-size, size), random.vector(-size, size)},
                                  0.3 * size};
    const PlacedField of_box = build_distance_field(make_box(half), {.cells = 16});
    const PlacedField of_capsule = build_distance_field(capsule, {.cells = 16});
    const PlacedField of_sphere = build_distance_field(Sphere<double>{size}, {.cells = 16});
    for (int k = 0; k < 200; ++k) {
      const Vec3d p = random.vector(-1.6 * size, 1.6 * size);
      EXPECT_NEAR(of_box.exact(p).distance, box_distance(half, p), 1e-13 * size);
      EXPECT_NEAR(of_capsule.exact(p).distance, capsule_distance(capsule, p), 1e-13 * size);
      EXPECT_NEAR(of_sphere.exact(p).distance, p.norm() - size, 1e-13 * size);
    }
  }
}

TEST(DistanceField, SamplesOfABoxAreExactAtItsSurfaceAndCloseInTheBand) {
  const Vec3d half(0.5, 0.3, 0.2);
  const PlacedField field = build_distance_field(make_box(half), {.cells = 32});
  Random random(2);
  int exact = 0, fine = 0, coarse = 0;
  for (int k = 0; k < 20000; ++k) {
    const Vec3d p = random.vector(-0.6, 0.6);
    const FieldSample sample = field.sample(p);
    const double error = std::abs(sample.distance - box_distance(half, p));
    if (sample.source == FieldSample::Source::Exact) {
      ++exact;
      ASSERT_LE(error, 1e-14) << p.transpose();
      ASSERT_NEAR(sample.gradient.norm(), 1, 1e-12);
    } else if (sample.source == FieldSample::Source::Fine) {
      ++fine;
      ASSERT_LE(error, 0.33 * field.cell) << p.transpose();
    } else {
      ++coarse;
      ASSERT_LE(error, 0.33 * 4 * field.cell) << p.transpose();
    }
  }
  EXPECT_GT(exact, 1000);
  EXPECT_GT(fine, 1000);
  EXPECT_GT(coarse, 1000);
}

TEST(DistanceField, CubicBlendsConvergeFasterThanTrilinearOnes) {
  const auto worst = [](int cells, FieldInterpolation interpolation) {
    const PlacedField field = build_distance_field(
        Sphere<double>{1},
        {.cells = cells, .band = 0, .interpolation = interpolation, .exact = false});
    Random random(3);
    double worst_error = 0;
    for (int k = 0; k < 4000; ++k) {
      const Vec3d p = random.uniform(0.6, 1.05) * random.unit_vector();
      worst_error = std::max(worst_error, std::abs(field.sample(p).distance - (p.norm() - 1)));
    }
    return worst_error;
  };
  using enum FieldInterpolation;
  const double linear = worst(16, Trilinear) / worst(32, Trilinear);
  // Finer lattices show the nodes' rounding, 2^-16 of the lattice, more than the blend's error.
  const double cubic = worst(4, Cubic) / worst(8, Cubic);
  EXPECT_NEAR(std::log2(linear), 2, 0.4);
  EXPECT_GT(std::log2(cubic), 3.3);
  EXPECT_LT(worst(16, Cubic), 0.02 * worst(16, Trilinear));
}

TEST(DistanceField, SlowAgreesWithExhaustionOnMeshesUnderAnyMotion) {
  Random random(4);
  for (int i = 0; i < 30; ++i) {
    const double size = random.decade(-4, 4);
    test::SphereMesh sphere = test::sphere_mesh(size, 12, 9, 0.3);
    // As far from the origin as a scene is large, or much farther.
    const Pose<double> pose = random.pose(random.chance(0.5) ? size : 1e4 * size);
    for (Vec3d& vertex : sphere.vertices) vertex = pose.transform(vertex);
    if (i % 3 == 0)
      for (std::array<int, 3>& triangle : sphere.triangles) std::swap(triangle[0], triangle[1]);
    const SurfaceOracle oracle(sphere.vertices, sphere.triangles);
    const FieldSettings settings{.cells = 10 + i, .band = i % 4};
    const PlacedField field = build_distance_field(test::built(sphere), settings);
    for (int k = 0; k < 200; ++k) {
      const Vec3d p = pose.position + random.vector(-1.5 * size, 1.5 * size);
      const auto truth = static_cast<double>(oracle.signed_distance(p));
      const double rounding = 1e-13 * size + 4e-16 * pose.position.norm();
      ASSERT_NEAR(field.exact(p).distance, truth, rounding) << i;
      const FieldSample sample = field.sample(p);
      if (sample.source == FieldSample::Source::Exact) {
        ASSERT_NEAR(sample.distance, truth, rounding);
      }
      const FieldBounds bounds = field.bounds(p);
      ASSERT_LE(bounds.lower, truth + rounding) << i;
      ASSERT_GE(bounds.upper, truth - rounding) << i;
    }
  }
}

TEST(DistanceField, SlowSurfacesThatCrossThemselvesAreInsideWhereTheyGoAroundAPoint) {
  Random random(28);
  for (int i = 0; i < 16; ++i) {
    // A ball and a thin fin through its skin; each ends inside the other, and both are watertight.
    const double size = random.decade(-4, 4);
    const Pose<double> pose = random.pose(size);
    test::SphereMesh surface = test::sphere_mesh(0.4 * size, 20, 13, 0.1);
    const Hull<double> fin =
        make_box(size * Vec3d(0.25, 0.5 * random.decade(-3, -1), random.uniform(0.02, 0.2)));
    const int first = count_of(surface.vertices);
    for (const Vec3d& vertex : fin.vertices)
      surface.vertices.emplace_back(vertex + size * Vec3d(0.45, 0, 0));
    for (Vec3d& vertex : surface.vertices) vertex = pose.transform(vertex);
    for (int face = 0; face < fin.face_count(); ++face) {
      const std::vector<int> around = face_vertices(fin, face);
      for (int k = 2; k < count_of(around); ++k)
        surface.triangles.push_back(
            {first + around[0], first + at(around, k - 1), first + at(around, k)});
    }
    const SurfaceOracle oracle(surface.vertices, surface.triangles);
    const PlacedField field = build_distance_field(
        test::built(surface), {.cells = 16 + 3 * i, .smooth = i % 2 == 0 ? 0 : kSmoothPart});
    for (int k = 0; k < 300; ++k) {
      const Vec3d spread(0.3, 0.03, 0.2);
      const Vec3d p =
          pose.transform(size * (Vec3d(0.4, 0, 0) + spread.cwiseProduct(random.vector(-1, 1))));
      const auto truth = static_cast<double>(oracle.signed_distance(p));
      ASSERT_NEAR(field.exact(p).distance, truth, 1e-13 * size) << i;
      const FieldBounds bounds = field.bounds(p);
      ASSERT_LE(bounds.lower, truth + 1e-13 * size) << i;
      ASSERT_GE(bounds.upper, truth - 1e-13 * size) << i;
    }
  }
}

TEST(DistanceField, GradientsPointAwayFromTheSurface) {
  const test::SphereMesh sphere = test::sphere_mesh(1, 40, 19, 0.1);
  const PlacedField field = build_distance_field(test::built(sphere), {.cells = 32});
  Random random(5);
  for (int k = 0; k < 2000; ++k) {
    const Vec3d p = random.uniform(0.9, 1.1) * random.unit_vector();
    const FieldSample sample = field.sample(p);
    const FieldSample truth = field.exact(p);
    if (std::abs(truth.distance) > 0.06) continue;
    // Near this surface, the nearest point jumps only on a few lines.
    ASSERT_GT(sample.gradient.normalized().dot(truth.gradient), 0.9) << p.transpose();
    // One step down the exact gradient ends on the surface.
    ASSERT_NEAR(field.exact(p - truth.distance * truth.gradient).distance, 0, 1e-12);
  }
}

TEST(DistanceField, FarPointsGetTheDistanceToTheLattice) {
  const PlacedField field = build_distance_field(make_box(Vec3d(1, 1, 1)), {.cells = 8});
  EXPECT_NEAR(field.exact(Vec3d(100, 0, 0)).distance, 99, 1e-12);
  EXPECT_NEAR(field.sample(Vec3d(100, 0, 0)).distance, 99, field.cell);
  EXPECT_NEAR(field.sample(Vec3d(100, 0, 0)).gradient.x(), 1, 0.01);
  EXPECT_LE(field.bounds(Vec3d(1e6, 1e6, 0)).lower, Vec3d(1e6 - 1, 1e6 - 1, 0).norm());
  EXPECT_GE(field.bounds(Vec3d(1e6, 1e6, 0)).lower, 0.999 * Vec3d(1e6, 1e6, 0).norm());
}

std::string refusal_of(const Shape<double>& shape, const FieldSettings& settings) {
  try {
    build_distance_field(shape, settings);
  } catch (const ShapeError& error) {
    return error.what();
  }
  return "none";
}

TEST(DistanceField, RefusesMoreBytesThanAllowedAndReportsHowMany) {
  const Shape<double> ball = Sphere<double>{1};
  // 4096 cells and a rim of 8: 1026 blocks a side, 1027^3 nodes of 16 bytes, 1026^3 numbers of 4.
  EXPECT_NE(refusal_of(ball, {.cells = 4096}).find("(21651489232 bytes)"), std::string::npos)
      << refusal_of(ball, {.cells = 4096});
  EXPECT_NE(refusal_of(ball, {.band = 0, .most_bytes = 1 << 20}).find("1 MiB are allowed"),
            std::string::npos);
  EXPECT_EQ(refusal_of(ball, {.band = 0, .most_bytes = 1 << 25}), "none");
  // A band of the same lattice takes less.
  const PlacedField band = build_distance_field(ball, {.cells = 96, .band = 1});
  const PlacedField dense = build_distance_field(ball, {.cells = 96, .band = 0});
  EXPECT_LT(2 * band.field->bytes(), dense.field->bytes());
}

TEST(DistanceField, RefusesWhatHasNoInside) {
  EXPECT_NE(refusal_of(HalfSpace<double>{{Vec3d::UnitY(), 0}}, {}).find("plane"),
            std::string::npos);
  EXPECT_NE(refusal_of(Sphere<double>{1}, {.cells = 1}).find("2 to 4096"), std::string::npos);
  EXPECT_NE(refusal_of(Sphere<double>{1}, {.band = -1}).find("band"), std::string::npos);
}

}  // namespace
}  // namespace contactscope
