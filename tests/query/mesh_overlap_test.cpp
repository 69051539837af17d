#include "query/mesh_overlap.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/at.h"
#include "support/random_geometry.h"
#include "support/sphere_mesh.h"

namespace contactscope {
namespace {

using enum TriangleOverlapKind;
using test::Random;

template <class S>
Triangle<S> triangle_at(const std::vector<Vec3<S>>& vertices, const std::array<int, 3>& triangle) {
  return {at(vertices, triangle[0]), at(vertices, triangle[1]), at(vertices, triangle[2])};
}

/// Every triangle of a against every one of b.
template <class S>
std::vector<MeshIntersection<S>> brute_force(const Mesh<S>& a, const Mesh<S>& b,
                                             const Pose<S>& b_in_a) {
  const std::vector<Vec3<S>> moved = vertices_in(b, b_in_a);
  std::vector<MeshIntersection<S>> found;
  for (int i = 0; i < a.triangle_count(); ++i) {
    for (int j = 0; j < b.triangle_count(); ++j) {
      const TriangleOverlap<S> overlap = triangle_overlap(
          triangle_at(a.vertices, at(a.triangles, i)), triangle_at(moved, at(b.triangles, j)));
      if (overlap.kind != None) found.push_back({i, j, overlap});
    }
  }
  return found;
}

template <class S>
void expect_brute_force(const Mesh<S>& a, const Mesh<S>& b, const Pose<S>& b_in_a) {
  const MeshOverlap<S> overlap = mesh_overlap(a, b, b_in_a);
  const std::vector<MeshIntersection<S>> expected = brute_force(a, b, b_in_a);
  ASSERT_EQ(overlap.intersections.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const MeshIntersection<S>& found = overlap.intersections[i];
    ASSERT_EQ(found.a, expected[i].a);
    ASSERT_EQ(found.b, expected[i].b);
    ASSERT_EQ(found.overlap.kind, expected[i].overlap.kind);
    ASSERT_EQ(found.overlap.segment, expected[i].overlap.segment);
  }
  EXPECT_GE(overlap.counts.triangle_pairs, static_cast<std::int64_t>(expected.size()));
}

using test::built;
using test::cube_mesh;

TEST(MeshOverlap, SlowSpheresGiveThePairsOfBruteForce) {
  Random random(51);
  for (int i = 0; i < 12; ++i) {
    const double size = std::pow(10.0, i % 9 - 4);  // 1e-4 to 1e4
    const Mesh<double> a = built(test::sphere_mesh(size, 16, 11, 0.1));
    const Mesh<double> b = built(test::sphere_mesh(0.7 * size, 13, 9, 0.05));
    const Pose<double> b_in_a = random.pose(size);
    expect_brute_force(a, b, b_in_a);
    expect_brute_force(mesh_cast<float>(a), mesh_cast<float>(b), b_in_a.cast<float>());
  }
}

TEST(MeshOverlap, SlowMeshesFarFromTheOriginGiveThePairsOfBruteForce) {
  Random random(52);
  for (int i = 0; i < 6; ++i) {
    const Vec3d far(3e4, -1e4, 2e4);
    test::SphereMesh sphere = test::sphere_mesh(1, 16, 11, 0.1);
    for (Vec3d& vertex : sphere.vertices) vertex += far;
    const Mesh<double> a = built(sphere), b = built(test::sphere_mesh(1, 13, 9, 0));
    const Pose<double> b_in_a{random.rotation(), far + random.unit_vector()};
    expect_brute_force(a, b, b_in_a);
    expect_brute_force(mesh_cast<float>(a), mesh_cast<float>(b), b_in_a.cast<float>());
  }
}

TEST(MeshOverlap, CubesFaceToFaceShareAreas) {
  const Mesh<double> mesh = cube_mesh(1);
  const Pose<double> beside{Quatd::Identity(), Vec3d(2, 0.5, 0.25)};
  expect_brute_force(mesh, mesh, beside);
  const MeshOverlap<double> overlap = mesh_overlap(mesh, mesh, beside);
  EXPECT_TRUE(overlap.overlapping());
  int areas = 0;
  for (const MeshIntersection<double>& pair : overlap.intersections) {
    EXPECT_NE(pair.overlap.kind, Proper);
    areas += pair.overlap.kind == Coplanar ? 1 : 0;
  }
  EXPECT_GE(areas, 2);
  // One last bit apart.
  const double bit = 0x1p-51;
  EXPECT_FALSE(
      mesh_overlap(mesh, mesh, {Quatd::Identity(), Vec3d(2 + bit, 0.5, 0.25)}).overlapping());
}

TEST(MeshOverlap, ACubeInsideACubeCrossesNothing) {
  const MeshOverlap<double> overlap = mesh_overlap(cube_mesh(3), cube_mesh(1), Pose<double>{});
  EXPECT_FALSE(overlap.overlapping());
  EXPECT_EQ(overlap.counts.triangle_pairs, 0);
}

TEST(MeshOverlap, TheRecordTellsEveryNodePairOnce) {
  const Mesh<double> a = built(test::sphere_mesh(1, 16, 11, 0.1));
  const Mesh<double> b = built(test::sphere_mesh(1, 13, 9, 0));
  const Pose<double> b_in_a{Quatd::Identity(), Vec3d(1, 0.5, 0.2)};
  std::vector<NodePairVisit> visits;
  const MeshOverlap<double> watched = mesh_overlap(a, b, b_in_a, &visits);
  const MeshOverlap<double> unwatched = mesh_overlap(a, b, b_in_a);
  ASSERT_EQ(watched.intersections.size(), unwatched.intersections.size());
  EXPECT_EQ(watched.counts.node_pairs, static_cast<std::int64_t>(visits.size()));
  EXPECT_EQ(watched.counts.node_pairs, unwatched.counts.node_pairs);
  ASSERT_FALSE(visits.empty());
  EXPECT_EQ(visits.front(), (NodePairVisit{0, 0, true}));
  // Each follows from one that overlaps: it has a parent among those before it.
  std::int64_t leaves = 0;
  for (std::size_t i = 1; i < visits.size(); ++i) {
    bool has_parent = false;
    for (std::size_t k = 0; k < i && !has_parent; ++k) {
      const NodePairVisit& parent = visits[k];
      // A leaf stands for itself.
      const auto below = [](const AabbTree<double>& tree, int from, int to) {
        if (at(tree.nodes, from).leaf()) return to == from;
        return to == from + 1 || to == tree.right_of(from);
      };
      has_parent = parent.overlaps && below(a.tree, parent.a, visits[i].a) &&
                   below(b.tree, parent.b, visits[i].b);
      ASSERT_FALSE(parent.a == visits[i].a && parent.b == visits[i].b) << "seen twice";
    }
    ASSERT_TRUE(has_parent) << i;
    leaves += visits[i].overlaps && at(a.tree.nodes, visits[i].a).leaf() &&
                      at(b.tree.nodes, visits[i].b).leaf()
                  ? 1
                  : 0;
  }
  EXPECT_EQ(leaves, watched.counts.leaf_pairs);
}

}  // namespace
}  // namespace contactscope
