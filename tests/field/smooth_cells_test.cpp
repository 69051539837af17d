#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "field/distance_field.h"
#include "geometry/primitives.h"
#include "support/random_geometry.h"
#include "support/sphere_mesh.h"
#include "support/surface_oracle.h"

// Cells that the surface crosses and that still blend their nodes.

namespace contactscope {
namespace {

using test::Random;

/// A wavy ball with a fin of `thickness` metres next to it, 1 m large, turned at random.
test::SphereMesh ball_with_fin(Random& random, double thickness) {
  test::SphereMesh surface = test::sphere_mesh(0.4, 40, 25, 0.1);
  const Pose<double> pose = random.pose(0);
  const Hull<double> fin = make_box(Vec3d(0.5, 0.5 * thickness, 0.3));
  const int first = count_of(surface.vertices);
  for (const Vec3d& vertex : fin.vertices)
    surface.vertices.emplace_back(pose.transform(vertex + Vec3d(0.96, 0, 0)));
  for (Vec3d& vertex : surface.vertices) vertex = pose.transform(vertex);
  for (int face = 0; face < fin.face_count(); ++face) {
    const std::vector<int> around = face_vertices(fin, face);
    for (int k = 2; k < count_of(around); ++k)
      surface.triangles.push_back(
          {first + around[0], first + at(around, k - 1), first + at(around, k)});
  }
  return surface;
}

Vec3d middle_of_cell(const Vec3d& point) {
  return point.array().floor().matrix() + Vec3d::Constant(0.5);
}

TEST(SmoothCells, SlowHaveNoOpposedNormals) {
  Random random(24);
  for (int i = 0; i < 12; ++i) {
    const test::SphereMesh surface = ball_with_fin(random, 0.04 * random.decade(-3, 0));
    const Mesh<double> mesh = test::built(surface);
    const PlacedField field = build_distance_field(mesh, {.cells = 40 + i, .smooth = kSmoothPart});
    std::vector<test::SurfaceOracle> triangles;
    for (const std::array<int, 3>& corners : mesh.triangles)
      triangles.emplace_back(mesh.vertices, std::vector{corners});
    int smooth = 0, querying = 0;
    for (int k = 0; k < 60000 && smooth < 60; ++k) {
      const Vec3d p = random.vector(-0.6, 1.5);
      const Vec3d in_lattice = field.in_lattice(p);
      if (!field.field->at_surface(in_lattice)) continue;
      if (field.sample(p).source == FieldSample::Source::Exact) {
        ++querying;
        continue;
      }
      ++smooth;
      // Triangles that enter the inscribed ball of the cell.
      const Vec3d middle = field.origin + field.cell * middle_of_cell(in_lattice);
      std::vector<Vec3d> normals;
      for (int t = 0; t < mesh.triangle_count(); ++t)
        if (at(triangles, t).distance(middle) <= 0.5L * static_cast<long double>(field.cell))
          normals.push_back(mesh.normal(t));
      for (const Vec3d& one : normals)
        for (const Vec3d& other : normals) ASSERT_GT(one.dot(other), -0.5 - 1e-9);
    }
    EXPECT_GE(smooth, 60);
    EXPECT_GT(querying, 0);
  }
}

TEST(SmoothCells, SlowBlendWithinTheirPartOfACellNearlyEverywhere) {
  Random random(25);
  for (const auto interpolation : {FieldInterpolation::Trilinear, FieldInterpolation::Cubic}) {
    for (const double smooth : {1.0 / 16, 1.0 / 32, 1.0 / 128}) {
      const double size = random.decade(-4, 4);
      const Mesh<double> mesh = test::built(test::sphere_mesh(size, 60, 41, 0.1));
      const PlacedField field = build_distance_field(
          mesh, {.cells = 40, .interpolation = interpolation, .smooth = smooth});
      int blended = 0, off = 0;
      for (int k = 0; k < 40000; ++k) {
        const Vec3d p = random.uniform(0.88, 1.12) * size * random.unit_vector();
        const FieldSample sample = field.sample(p);
        if (!field.field->at_surface(field.in_lattice(p))) continue;
        const double error = std::abs(sample.distance - field.exact(p).distance);
        if (sample.source == FieldSample::Source::Exact) {
          ASSERT_EQ(error, 0);
          continue;
        }
        ++blended;
        off += error <= smooth * field.cell ? 0 : 1;
        // Between the five points, the blend is off by only a few times as much.
        ASSERT_LE(error, 4 * smooth * field.cell);
      }
      EXPECT_GT(blended, 1000);
      EXPECT_LE(off, blended / 15) << smooth;
    }
  }
}

TEST(SmoothCells, NoneIfDisabledAndNoneAtEdgesOfABox) {
  const Vec3d half(0.5, 0.3, 0.2);
  const PlacedField all = build_distance_field(make_box(half), {.cells = 32});
  const PlacedField some =
      build_distance_field(make_box(half), {.cells = 32, .smooth = kSmoothPart});
  Random random(26);
  int flat = 0, at_edge = 0;
  for (int k = 0; k < 30000; ++k) {
    const Vec3d p = random.vector(-0.55, 0.55);
    const Vec3d in_lattice = some.in_lattice(p);
    if (!some.field->at_surface(in_lattice)) continue;
    EXPECT_EQ(all.sample(p).source, FieldSample::Source::Exact);
    // Number of faces that are no farther than half a cell from the cell's middle.
    const Vec3d middle = some.origin + some.cell * middle_of_cell(in_lattice);
    const Vec3d beyond = (middle.cwiseAbs() - half) / some.cell;
    const int faces = static_cast<int>((beyond.array().abs() <= 0.5).count());
    if (beyond.maxCoeff() > 0.5) continue;
    const bool queries = some.sample(p).source == FieldSample::Source::Exact;
    if (faces >= 2) {
      ++at_edge;
      ASSERT_TRUE(queries);
    } else if (faces == 1 && (beyond.array() > -4).count() == 1) {
      ++flat;
      ASSERT_FALSE(queries);
    }
  }
  EXPECT_GT(flat, 500);
  EXPECT_GT(at_edge, 100);
}

TEST(SmoothCells, SpheresAndCapsulesAreSmoothWhereTheyAreLarge) {
  const auto share_querying = [](const Shape<double>& shape, int cells) {
    const PlacedField field = build_distance_field(shape, {.cells = cells, .smooth = kSmoothPart});
    Random random(27);
    int querying = 0, at_surface = 0;
    for (int k = 0; k < 20000; ++k) {
      const Vec3d p = random.vector(-1.2, 1.2);
      if (!field.field->at_surface(field.in_lattice(p))) continue;
      ++at_surface;
      querying += field.sample(p).source == FieldSample::Source::Exact ? 1 : 0;
    }
    return static_cast<double>(querying) / at_surface;
  };
  EXPECT_EQ(share_querying(Sphere<double>{1}, 3), 1);  // a radius of 1.5 cells
  EXPECT_LT(share_querying(Sphere<double>{1}, 32), 0.01);
  const Capsule<double> thin{{Vec3d(-1, 0, 0), Vec3d(1, 0, 0)}, 0.02};
  EXPECT_EQ(share_querying(thin, 32), 1);
}

}  // namespace
}  // namespace contactscope
