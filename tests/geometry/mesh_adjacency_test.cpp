#include "geometry/mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "geometry/primitives.h"
#include "mesh_shapes.h"

namespace contactscope::test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr double kDegree = std::numbers::pi / 180;

Mesh<double> mesh_of(const MeshInput& input, MeshReport* report = nullptr) {
  return build_mesh(input.vertices, input.triangles, report);
}

/// Neighbours across an edge refer to each other by the same edge.
template <class S> void expect_mutual(const Mesh<S>& mesh) {
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const int other = mesh.neighbour(t, k);
      if (other < 0) continue;
      int matches = 0;
      for (int j = 0; j < 3; ++j) {
        if (mesh.neighbour(other, j) != t) continue;
        if (mesh.corner(other, j) != mesh.corner(t, (k + 1) % 3)) continue;
        if (mesh.corner(other, (j + 1) % 3) != mesh.corner(t, k)) continue;
        ++matches;
        EXPECT_EQ(mesh.edge_class(other, j), mesh.edge_class(t, k));
        EXPECT_EQ(bend_angle(mesh, other, j), bend_angle(mesh, t, k));
      }
      EXPECT_EQ(matches, 1);
    }
  }
}

int count(const Mesh<double>& mesh, EdgeClass wanted) {
  int found = 0;
  for (const auto& edges : mesh.edges) {
    for (const EdgeClass edge : edges) found += edge == wanted ? 1 : 0;
  }
  return found;
}

TEST(MeshAdjacency, AClosedMeshHasTheNeighboursOfItsHull) {
  Random random(1);
  for (const double size : {1e-4, 1.0, 1e4}) {
    const Hull<double> hull = random_hull(random, 32, size, 3);
    MeshReport report;
    const Mesh<double> mesh = mesh_of(triangles_of(hull), &report);
    ASSERT_EQ(mesh.triangle_count(), hull.face_count());
    for (int f = 0; f < hull.face_count(); ++f) {
      int edge = hull.face_edges[static_cast<std::size_t>(f)];
      for (int k = 0; k < 3; ++k) {
        const int across = hull.half_edges[static_cast<std::size_t>(Hull<double>::twin(edge))].face;
        EXPECT_EQ(mesh.neighbour(f, k), across);
        const double cosine = hull.planes[static_cast<std::size_t>(f)].normal.dot(
            hull.planes[static_cast<std::size_t>(across)].normal);
        EXPECT_NEAR(std::cos(bend_angle(mesh, f, k)), cosine, 1e-12);
        EXPECT_GT(bend_angle(mesh, f, k), 0) << "a hull is convex at every edge";
        edge = hull.half_edges[static_cast<std::size_t>(edge)].next;
      }
    }
    EXPECT_EQ(count(mesh, EdgeClass::Boundary), 0);
    EXPECT_THAT(report.non_manifold_edges, IsEmpty());
    EXPECT_THAT(report.flipped_edges, IsEmpty());
    expect_mutual(mesh);
    expect_mutual(mesh_cast<float>(mesh));
  }
}

TEST(MeshAdjacency, ATurnedOutHullIsConcaveAtEveryEdge) {
  Random random(2);
  MeshInput input = triangles_of(random_hull(random, 20, 1, 2));
  for (std::array<int, 3>& triangle : input.triangles) std::swap(triangle[1], triangle[2]);
  const Mesh<double> room = mesh_of(input);
  EXPECT_EQ(count(room, EdgeClass::Internal), 3 * room.triangle_count());
  EXPECT_LT(bend_angle(room, 0, 0), 0);
}

TEST(MeshAdjacency, AGridIsOpenAtItsRimOnly) {
  const Mesh<double> grid = make_grid(3, 2, 7, 5, 0);
  EXPECT_EQ(count(grid, EdgeClass::Boundary), 2 * (7 + 5));
  EXPECT_EQ(count(grid, EdgeClass::Internal), 3 * 2 * 7 * 5 - 2 * (7 + 5));
  expect_mutual(grid);
}

TEST(MeshAdjacency, AMoebiusStripHasOneSeamThatNoWindingCloses) {
  MeshReport report;
  const Mesh<double> strip = mesh_of(moebius_strip(12), &report);
  ASSERT_EQ(report.flipped_edges.size(), 1u);
  EXPECT_THAT(report.flipped_edges[0], ElementsAre(0, 23));
  EXPECT_THAT(report.non_manifold_edges, IsEmpty());
  EXPECT_EQ(strip.neighbour(0, 0), -1);
  EXPECT_EQ(strip.edge_class(0, 0), EdgeClass::Boundary);
  EXPECT_EQ(count(strip, EdgeClass::Boundary), 2 * 12 + 2);
  expect_mutual(strip);
}

TEST(MeshAdjacency, ATriangleTurnedOverAmongOthersIsReported) {
  MeshInput input = hinge(0);
  std::swap(input.triangles[1][0], input.triangles[1][1]);
  MeshReport report;
  const Mesh<double> mesh = mesh_of(input, &report);
  ASSERT_EQ(report.flipped_edges.size(), 1u);
  EXPECT_THAT(report.flipped_edges[0], ElementsAre(0, 1));
  EXPECT_EQ(count(mesh, EdgeClass::Boundary), 6);
}

TEST(MeshAdjacency, AcrossATJunctionThereIsNoNeighbour) {
  // One long edge below, its halves above.
  const MeshInput input{{{0, 0, 0}, {2, 0, 0}, {1, 0, 1}, {1, 0, 0}, {0, 0, -1}, {2, 0, -1}},
                        {{0, 2, 1}, {0, 3, 4}, {3, 1, 5}, {3, 5, 4}}};
  MeshReport report;
  const Mesh<double> mesh = mesh_of(input, &report);
  EXPECT_THAT(mesh.neighbours[0], ElementsAre(-1, -1, -1));
  EXPECT_EQ(mesh.neighbour(1, 0), -1);
  EXPECT_EQ(mesh.neighbour(2, 0), -1);
  EXPECT_EQ(mesh.neighbour(3, 2), 1);
  EXPECT_THAT(report.non_manifold_edges, IsEmpty());
  expect_mutual(mesh);
}

TEST(MeshAdjacency, ThreeTrianglesOnOneEdgeAreReportedUnlinked) {
  MeshInput book{{{0, 0, 0}, {0, 0, 1}}, {}};
  for (int page = 0; page < 3; ++page) {
    book.vertices.emplace_back(std::cos(page), std::sin(page), 0.5);
    book.triangles.push_back({0, 1, 2 + page});
  }
  std::swap(book.triangles[1][0], book.triangles[1][1]);
  MeshReport report;
  const Mesh<double> mesh = mesh_of(book, &report);
  ASSERT_EQ(report.non_manifold_edges.size(), 1u);
  EXPECT_THAT(report.non_manifold_edges[0], ElementsAre(0, 1, 2));
  EXPECT_THAT(report.flipped_edges, IsEmpty());
  EXPECT_EQ(count(mesh, EdgeClass::Boundary), 9);
}

TEST(MeshAdjacency, ReportedTrianglesCountWithoutThoseThatWereDropped) {
  MeshInput input = hinge(0);
  std::swap(input.triangles[1][0], input.triangles[1][1]);
  input.triangles.insert(input.triangles.begin(), {0, 0, 1});
  MeshReport report;
  mesh_of(input, &report);
  EXPECT_THAT(report.zero_area_triangles, ElementsAre(0));
  ASSERT_EQ(report.flipped_edges.size(), 1u);
  EXPECT_THAT(report.flipped_edges[0], ElementsAre(0, 1));
}

TEST(MeshAdjacency, VerticesInTheSamePlaceCountAsOne) {
  const MeshInput joined = hinge(0.3);
  MeshInput split;
  for (const std::array<int, 3>& t : joined.triangles) {
    const auto vertex = [&](std::size_t k) {
      return joined.vertices[static_cast<std::size_t>(t[k])];
    };
    split.add(vertex(0), vertex(1), vertex(2));
  }
  split.vertices[0].x() = -0.0;  // equal to 0 as a number, not as bits
  EXPECT_EQ(mesh_of(split).neighbours, mesh_of(joined).neighbours);
  expect_mutual(mesh_of(split));
}

TEST(MeshAdjacency, EdgesAreConvexFromADegreeOn) {
  for (const double scale : {1e-4, 1.0, 1e4}) {
    for (const double degrees : {-178.0, -90.0, -1.01, -0.99, 0.0, 0.99, 1.01, 2.0, 90.0, 179.9}) {
      MeshInput input = hinge(degrees * kDegree);
      for (Vec3d& vertex : input.vertices) vertex *= scale;
      const Mesh<double> mesh = mesh_of(input);
      EXPECT_NEAR(bend_angle(mesh, 0, 0), degrees * kDegree, 1e-14);
      EXPECT_EQ(bend_angle(mesh, 1, 0), bend_angle(mesh, 0, 0));
      EXPECT_EQ(mesh.edge_class(0, 0), degrees > 1 ? EdgeClass::Convex : EdgeClass::Internal)
          << degrees;
    }
  }
}

TEST(MeshAdjacency, ASheetFoldedOntoItselfIsConvexForAnyRounding) {
  for (const double rounding : {-1e-16, 0.0, 1e-16}) {
    MeshInput input = hinge(std::numbers::pi);
    input.vertices[3].y() = rounding;
    const Mesh<double> mesh = mesh_of(input);
    EXPECT_EQ(mesh.edge_class(0, 0), EdgeClass::Convex);
    EXPECT_NEAR(bend_angle(mesh, 0, 0), std::numbers::pi, 1e-15);
  }
}

TEST(MeshAdjacency, AFlatFloorOfSliversAsSixDigitsGiveItStaysFlat) {
  // Strips of a tilted floor of ten metres, each a thousandth as wide, heights printed as "%.6g".
  MeshInput floor;
  const auto height = [](double x, double z) {
    return std::round((2 + 0.3 * x + 0.1 * z) * 1e5) / 1e5;
  };
  for (int i = 0; i < 100; ++i) {
    const auto at = [&](int k, double z) {
      const double x = 0.01 * (i + k);
      return Vec3d(x, height(x, z), z);
    };
    floor.add(at(0, 0), at(0, 10), at(1, 10));
    floor.add(at(0, 0), at(1, 10), at(1, 0));
  }
  const Mesh<double> mesh = mesh_of(floor);
  EXPECT_EQ(count(mesh, EdgeClass::Convex), 0);
  EXPECT_EQ(count(mesh, EdgeClass::Boundary), 2 * 100 + 2);
}

TEST(MeshAdjacency, AFlatSlopeFarFromTheOriginStaysFlatInSinglePrecision) {
  Mesh<double> mesh = make_grid(20, 20, 33, 33, 0);
  MeshInput slope{mesh.vertices, mesh.triangles};
  for (Vec3d& vertex : slope.vertices) {
    vertex.y() = 0.5 * vertex.x();
    vertex += Vec3d(1e6 / 3, 1e6 / 3, 1e6 / 3);
  }
  mesh = mesh_of(slope);
  EXPECT_EQ(count(mesh, EdgeClass::Convex), 0);
  Mesh<float> rounded = mesh_cast<float>(mesh);
  EXPECT_EQ(rounded.edges, mesh.edges);
  // The rounded mesh does have bumps: recomputed classes differ.
  refit(rounded);
  EXPECT_FALSE(rounded.edges == mesh.edges);
}

}  // namespace
}  // namespace contactscope::test
