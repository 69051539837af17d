#include "geometry/mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "mesh_shapes.h"

namespace contactscope::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::vector<Vec3d> kSquare{{0, 0, 0}, {1, 0, 0}, {1, 0, -1}, {0, 0, -1}};

TEST(Mesh, TwoTrianglesMakeASquareWithOneInnerEdge) {
  MeshReport report;
  const Mesh<double> mesh = build_mesh(kSquare, {{0, 1, 2}, {0, 2, 3}}, &report);
  EXPECT_EQ(mesh.vertices, kSquare);
  EXPECT_THAT(mesh.triangles, ElementsAre(std::array{0, 1, 2}, std::array{0, 2, 3}));
  EXPECT_THAT(mesh.neighbours, ElementsAre(std::array{-1, -1, 1}, std::array{0, -1, -1}));
  EXPECT_THAT(mesh.normals, ElementsAre(Vec3d::UnitY(), Vec3d::UnitY()));
  using enum EdgeClass;
  EXPECT_THAT(mesh.edges, ElementsAre(std::array{Boundary, Boundary, Internal},
                                      std::array{Internal, Boundary, Boundary}));
  EXPECT_EQ(mesh.tree.bounds(), (Aabb<double>{Vec3d(0, 0, -1), Vec3d(1, 0, 0)}));
  EXPECT_THAT(report.zero_area_triangles, IsEmpty());
  EXPECT_THAT(report.non_manifold_edges, IsEmpty());
  EXPECT_THAT(report.flipped_edges, IsEmpty());
}

TEST(Mesh, TrianglesWithoutAnAreaAreDroppedAndReported) {
  MeshReport report;
  const Mesh<double> mesh = build_mesh({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {5, 5, 5}},
                                       {{0, 1, 2}, {0, 1, 3}, {3, 3, 0}, {4, 4, 4}}, &report);
  EXPECT_THAT(mesh.triangles, ElementsAre(std::array{0, 1, 3}));
  EXPECT_EQ(mesh.neighbours.size(), 1u);
  EXPECT_EQ(mesh.normals.size(), 1u);
  EXPECT_EQ(mesh.edges.size(), 1u);
  EXPECT_EQ(mesh.tree.triangles.size(), 1u);
  EXPECT_EQ(mesh.vertices.size(), 5u);
  EXPECT_THAT(report.zero_area_triangles, ElementsAre(0, 2, 3));
}

TEST(Mesh, DegenerateTrianglesAreKeptOnRequest) {
  const Mesh<double> mesh = build_mesh_with_flat_triangles(
      {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}, {3, 3, 0}, {3, 3, 3}});
  ASSERT_EQ(mesh.triangle_count(), 4);
  EXPECT_FALSE(has_area(mesh, 0));
  EXPECT_TRUE(has_area(mesh, 1));
  EXPECT_EQ(longest_edge(mesh, 0), 2);
  EXPECT_EQ(mesh.corner(2, longest_edge(mesh, 2)), Vec3d(0, 1, 0));
  EXPECT_EQ(mesh.neighbour(0, 2), 1);
  EXPECT_EQ(mesh.edge_class(0, 2), EdgeClass::Internal);
  // A side of length 0 has no neighbour; a segment forth and back is not its own neighbour.
  EXPECT_EQ(mesh.neighbours[3], (std::array{-1, -1, -1}));
  EXPECT_EQ(build_mesh_with_flat_triangles({{0, 0, 0}, {1, 0, 0}}, {{0, 1, 0}}).neighbours[0],
            (std::array{-1, -1, -1}));
}

TEST(Mesh, PointsOnALineButForRoundingHaveNoArea) {
  MeshReport report;
  const std::vector<Vec3d> vertices{{0.1, 0.1, 0.1}, {0.2, 0.2, 0.2},  {0.7, 0.7, 0.7},
                                    {1000.1, 0, 0},  {1000.2, 0.1, 0}, {1000.3, 0.2, 0},
                                    {0, 0, 1}};
  build_mesh(vertices, {{0, 1, 2}, {3, 4, 5}, {0, 1, 6}}, &report);
  EXPECT_THAT(report.zero_area_triangles, ElementsAre(0, 1));
}

TEST(Mesh, SmallAndThinTrianglesAreKept) {
  for (const double scale : {1e-200, 1e-30, 1e-9, 1e-4, 1e4, 1e150}) {
    MeshReport report;
    const Mesh<double> mesh =
        build_mesh({scale * Vec3d(0, 0, 0), scale * Vec3d(1, 0, 0), scale * Vec3d(0.5, 1e-12, 0)},
                   {{0, 1, 2}}, &report);
    EXPECT_THAT(report.zero_area_triangles, IsEmpty()) << scale;
    EXPECT_EQ(mesh.normal(0), Vec3d::UnitZ()) << scale;
  }
}

void expect_refusal(const std::function<void()>& build, const std::string& words) {
  try {
    build();
    ADD_FAILURE() << "no error";
  } catch (const ShapeError& error) {
    EXPECT_THAT(error.what(), HasSubstr(words));
  }
}

TEST(Mesh, ATriangleThatNamesNoVertexIsRefused) {
  for (const int bad : {4, -1, std::numeric_limits<int>::max(), std::numeric_limits<int>::min()}) {
    expect_refusal(
        [&] {
          build_mesh(kSquare, {{0, 1, 2}, {0, 2, bad}});
        },
        "triangle 1 names vertex " + std::to_string(bad) + ", but there are 4");
  }
}

TEST(Mesh, CoordinatesThatAreNotFiniteAreRefused) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    std::vector<Vec3d> vertices = kSquare;
    vertices[3].y() = bad;
    expect_refusal([&] { build_mesh(vertices, {{0, 1, 2}}); }, "vertex 3");
  }
  expect_refusal(
      [] {
        build_mesh({{-1.5e308, 0, 0}, {1.5e308, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
      },
      "too large");
}

TEST(Mesh, AMeshWithoutAnyAreaIsRefused) {
  expect_refusal([] { build_mesh(kSquare, {}); }, "no triangle");
  expect_refusal([] { build_mesh({}, {}); }, "no triangle");
  expect_refusal([] { build_mesh(kSquare, {{0, 1, 1}, {2, 2, 2}}); }, "zero area");
}

/// Unit normal in long double, from exact differences of the coordinates.
Vec3d precise_normal(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  using Vec3l = Vec3<long double>;
  const Vec3l ab = b.cast<long double>() - a.cast<long double>();
  const Vec3l ac = c.cast<long double>() - a.cast<long double>();
  return ab.cross(ac).normalized().cast<double>();
}

double angle_between(const Vec3d& a, const Vec3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

TEST(TriangleNormal, IsRightForSliversAtEveryScaleAndPlace) {
  Random random(1);
  int kept = 0;
  for (int i = 0; i < 20000; ++i) {
    const double size = random.decade(-4, 4);
    const Vec3d a = size * random.decade(-3, 3) * random.unit_vector();
    const Vec3d b = a + size * random.unit_vector();
    const Vec3d c =
        a + random.uniform(0, 1) * (b - a) + size * random.decade(-12, 0) * random.unit_vector();
    const Vec3d normal = triangle_normal(a, b, c);
    if (normal.isZero(0)) continue;
    ++kept;
    EXPECT_NEAR(normal.norm(), 1, 1e-15);
    // If the corner is flat, rounding of the two short edges has more effect.
    const double sine = std::sin(angle_between(a - c, b - c));
    const double roundings = std::numeric_limits<double>::epsilon() * (8 + 8 / sine);
    EXPECT_LT(angle_between(normal, precise_normal(a, b, c)), roundings);
  }
  EXPECT_GT(kept, 10000);
}

TEST(TriangleNormal, ChangesUnderADegreeByTheLastDigitIfTheTriangleIsKept) {
  Random random(2);
  double most = 0;
  for (int i = 0; i < 20000; ++i) {
    const double place = random.decade(-3, 3);
    const Vec3d a = place * random.unit_vector();
    const Vec3d b = a + random.decade(-6, 0) * random.unit_vector();
    const Vec3d c =
        a + random.uniform(0, 1) * (b - a) + place * random.decade(-14, -13) * random.unit_vector();
    const Vec3d normal = triangle_normal(a, b, c);
    if (normal.isZero(0)) continue;
    // Any real triangle that could round to these coordinates.
    std::array<Vec3d, 3> corners{a, b, c};
    std::array<Vec3<long double>, 3> exact;
    for (std::size_t k = 0; k < 3; ++k) {
      for (int axis = 0; axis < 3; ++axis) {
        const long double x = corners[k][axis];
        const long double ulp =
            std::nextafter(std::abs(corners[k][axis]), HUGE_VAL) - std::abs(corners[k][axis]);
        exact[k][axis] = x + (random.chance(0.5) ? 0.5L : -0.5L) * ulp;
      }
    }
    const Vec3d turned =
        (exact[1] - exact[0]).cross(exact[2] - exact[0]).normalized().cast<double>();
    most = std::max(most, angle_between(normal, turned));
  }
  EXPECT_LT(most, kFlatEdgeAngle);
  EXPECT_GT(most, kFlatEdgeAngle / 20) << "the triangles are too thick to show anything";
}

TEST(TriangleNormal, DoesNotDependOnTheCornerThatComesFirstButForRounding) {
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const Vec3d a = random.unit_vector();
    const Vec3d b = random.unit_vector();
    const Vec3d c = random.unit_vector();
    EXPECT_LT(angle_between(triangle_normal(a, b, c), triangle_normal(b, c, a)), 1e-13);
    EXPECT_LT(angle_between(triangle_normal(a, b, c), -triangle_normal(c, b, a)), 1e-13);
  }
}

TEST(MeshCast, RoundsVerticesOnceAndKeepsTheTopology) {
  Random random(4);
  const MeshInput input = random_soup(random, 200, 10, 3, Vec3d(5, 0, 0));
  const Mesh<double> mesh = build_mesh(input.vertices, input.triangles);
  const Mesh<float> cast = mesh_cast<float>(mesh);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    EXPECT_EQ(cast.vertices[i], Vec3f(mesh.vertices[i].cast<float>()));
  }
  EXPECT_EQ(cast.triangles, mesh.triangles);
  EXPECT_EQ(cast.neighbours, mesh.neighbours);
  EXPECT_EQ(cast.edges, mesh.edges);
  EXPECT_EQ(cast.tree.triangles, mesh.tree.triangles);
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    EXPECT_LT((cast.normal(t).cast<double>() - mesh.normal(t)).norm(), 1e-4);
  }
}

TEST(MeshCast, NormalsAreThoseOfTheRoundedTriangles) {
  // One metre of a slope, so far away that single precision moves corners by up to a quarter.
  const Vec3d far(4e6 + 0.2, 0.3, 0.1);
  const Mesh<double> mesh =
      build_mesh({far, far + Vec3d(1.3, 0.5, 0), far + Vec3d(0, 0.5, -1.3)}, {{0, 1, 2}});
  const Mesh<float> cast = mesh_cast<float>(mesh);
  EXPECT_GT(angle_between(mesh.normal(0), cast.normal(0).cast<double>()), 0.01);
  for (int k = 0; k < 3; ++k) {
    const Vec3d edge = (cast.corner(0, (k + 1) % 3) - cast.corner(0, k)).cast<double>();
    EXPECT_LT(std::abs(cast.normal(0).cast<double>().dot(edge)), 1e-6);
  }
}

TEST(MeshCast, ATriangleThatRoundingFlattensHasNoNormal) {
  const Mesh<double> mesh =
      build_mesh({{1e6, 1, 0}, {1e6 + 1e-3, 1, 0}, {1e6, 1, -1e-3}}, {{0, 1, 2}});
  const Mesh<float> cast = mesh_cast<float>(mesh);
  EXPECT_EQ(cast.corner(0, 0), cast.corner(0, 1));
  EXPECT_FALSE(has_area(cast, 0));
}

TEST(MeshRefit, FollowsVerticesThatMoved) {
  MeshInput flat = hinge(0);
  Mesh<double> mesh = build_mesh(flat.vertices, flat.triangles);
  EXPECT_EQ(mesh.edge_class(0, 0), EdgeClass::Internal);
  mesh.vertices = hinge(0.5).vertices;
  refit(mesh);
  EXPECT_EQ(mesh.edge_class(0, 0), EdgeClass::Convex);
  EXPECT_NEAR(bend_angle(mesh, 0, 0), 0.5, 1e-15);
  EXPECT_NEAR(mesh.tree.bounds().lower.y(), -std::sin(0.5), 1e-15);
  EXPECT_EQ(mesh.neighbour(0, 0), 1);
}

TEST(MeshRefit, ATriangleThatCollapsesHasNoNormalUntilItRises) {
  Mesh<float> mesh = mesh_cast<float>(build_mesh(hinge(0).vertices, hinge(0).triangles));
  const Vec3f apex = mesh.vertices[3];
  mesh.vertices[3] = Vec3f(0, 0, -0.5f);
  refit(mesh);
  EXPECT_FALSE(has_area(mesh, 1));
  EXPECT_EQ(longest_edge(mesh, 1), 0);
  mesh.vertices[3] = apex;
  refit(mesh);
  EXPECT_EQ(mesh.normal(1), Vec3f::UnitY());
}

}  // namespace
}  // namespace contactscope::test
