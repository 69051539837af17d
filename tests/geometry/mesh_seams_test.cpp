#include "geometry/mesh_seams.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/tiled_floor.h"

namespace contactscope::test {
namespace {

std::vector<Vec3d> turned(const std::vector<Vec3d>& points, const Quatd& by) {
  return mapped(points, [&](const Vec3d& point) -> Vec3d { return by * point; });
}

// The outline of the square is the oracle.
TEST(MeshSeams, EveryInnerEdgeOfATiledFloorContinues) {
  Random random(3700);
  int junctions = 0;
  for (const double size : {1e-4, 1.0, 1e4}) {
    for (const double crack : {0.0, 1e-12, 1e-9, 2e-7}) {
      for (int i = 0; i < 20; ++i) {
        const TiledFloor floor(random, size, crack * size);
        const Mesh<double> mesh =
            build_mesh(turned(floor.vertices, random.rotation()), floor.triangles);
        for (int t = 0; t < mesh.triangle_count(); ++t) {
          EXPECT_EQ(mesh.region(t), 0);
          for (int k = 0; k < 3; ++k) {
            ASSERT_EQ(mesh.beyond(t, k) < 0, floor.is_outer(t, k)) << size << ", " << crack;
            EXPECT_EQ(mesh.edge_class(t, k),
                      floor.is_outer(t, k) ? EdgeClass::Boundary : EdgeClass::Internal);
            junctions += mesh.beyond(t, k) >= 0 && mesh.neighbour(t, k) < 0 ? 1 : 0;
          }
        }
      }
    }
  }
  EXPECT_GT(junctions, 1000);
}

TEST(MeshSeams, AWideCrackIsTheEndOfASurface) {
  Random random(3701);
  for (int i = 0; i < 20; ++i) {
    const TiledFloor floor(random, 1, 1e-3);
    EXPECT_TRUE(build_mesh(floor.vertices, floor.triangles).seams.empty());
  }
}

// The same floors: nothing but the width of the seams changes, and stays when the mesh is moved.
TEST(MeshSeams, AWiderWeldContinuesAcrossAWideCrack) {
  Random random(3702);
  int cracks = 0;
  for (const double size : {1e-4, 1.0, 1e4}) {
    for (int i = 0; i < 20; ++i) {
      const TiledFloor floor(random, size, 2e-4 * size);
      Mesh<double> mesh = build_mesh(turned(floor.vertices, random.rotation()), floor.triangles);
      EXPECT_TRUE(mesh.seams.empty());
      weld(mesh, 1e-3);
      if (i % 2 == 1) {
        for (Vec3d& vertex : mesh.vertices) vertex += 0.1 * size * Vec3d::Ones();
        refit(mesh);
      }
      const Mesh<float> rounded = mesh_cast<float>(mesh);
      for (int t = 0; t < mesh.triangle_count(); ++t)
        for (int k = 0; k < 3; ++k) {
          ASSERT_EQ(mesh.beyond(t, k) < 0, floor.is_outer(t, k)) << size;
          ASSERT_EQ(rounded.beyond(t, k), mesh.beyond(t, k));
          cracks += mesh.beyond(t, k) >= 0 && mesh.neighbour(t, k) < 0 ? 1 : 0;
        }
      EXPECT_EQ(mesh.vertices.size(), floor.vertices.size());
      weld(mesh, kSeam);
      EXPECT_TRUE(mesh.seams.empty());
    }
  }
  EXPECT_GT(cracks, 1000);
}

// Edge 1 0 of the first triangle along two others. The second one is turned up.
Mesh<double> three_sides(double gap, double bend) {
  return build_mesh({{0, 0, 0},
                     {2, 0, 0},
                     {1, 0, -1},
                     {0, 0, 0},
                     {1, 0, 0},
                     {0.5, 0, 1},
                     {1 + gap, 0, 0},
                     {2, 0, 0},
                     {1.5, std::sin(bend), std::cos(bend)}},
                    {{0, 1, 2}, {3, 5, 4}, {6, 8, 7}});
}

TEST(MeshSeams, AGapInTheShortEdgesEndsTheLongOneOnly) {
  const Mesh<double> mesh = three_sides(0.1, 0);
  EXPECT_EQ(mesh.beyond(0, 0), -1);
  EXPECT_EQ(mesh.beyond(1, 2), 0);
  EXPECT_EQ(mesh.beyond(2, 2), 0);
  EXPECT_EQ(three_sides(0, 0).beyond(0, 0), 1);
}

TEST(MeshSeams, BendsOfSeamsAreClassified) {
  using enum EdgeClass;
  const double flat = 0.5 * kFlatEdgeAngle, steep = std::numbers::pi / 6;
  EXPECT_EQ(three_sides(0, flat).edge_class(2, 2), Internal);
  EXPECT_EQ(three_sides(0, flat).region(2), 0);
  EXPECT_EQ(three_sides(0, steep).edge_class(2, 2), Internal);  // concave
  EXPECT_EQ(three_sides(0, steep).region(2), 2);
  EXPECT_EQ(three_sides(0, -steep).edge_class(2, 2), Convex);
  EXPECT_EQ(three_sides(0, -steep).edge_class(0, 0), Boundary);  // two bends
}

TEST(MeshSeams, AStripAsThinAsASeamIsNoSeamWithItself) {
  for (const double width : {1e-9, 1e-6, 1e-4})
    EXPECT_TRUE(
        build_mesh({{0, 0, 0}, {1, 0, 0}, {1, width, 0}, {0, width, 0}}, {{0, 1, 2}, {0, 2, 3}})
            .seams.empty());
}

// As for neighbours: which of three surfaces continues is not known.
TEST(MeshSeams, NoneAtAnEdgeThatThreeTrianglesShare) {
  const Mesh<double> mesh = build_mesh({{0, 0, 0}, {1, 0, 0}, {0, 0, -1}, {0, 0, 1}, {0, 1, 0}},
                                       {{0, 1, 2}, {1, 0, 3}, {1, 0, 4}});
  EXPECT_TRUE(mesh.seams.empty());
}

TEST(MeshSeams, OpenWhenADeformedSurfaceTears) {
  Mesh<double> mesh = three_sides(0, 0);
  ASSERT_EQ(mesh.beyond(1, 2), 0);
  mesh.vertices[5].y() -= 0.01;
  refit(mesh);
  EXPECT_EQ(mesh.beyond(1, 2), 0);
  for (const std::size_t vertex : {3u, 4u, 5u}) mesh.vertices[vertex].y() += 0.1;
  refit(mesh);
  EXPECT_EQ(mesh.beyond(1, 2), -1);
  EXPECT_EQ(mesh.beyond(0, 0), -1);
  EXPECT_EQ(mesh.beyond(2, 2), 0);
}

}  // namespace
}  // namespace contactscope::test
