#include "query/mesh_overlap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "query/mesh_query_cost.h"
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
  const Pose<double> shifted{Quatd::Identity(), Vec3d(2, 0.5, 0.25)};
  expect_brute_force(mesh, mesh, shifted);
  const MeshOverlap<double> overlap = mesh_overlap(mesh, mesh, shifted);
  EXPECT_TRUE(overlap.overlapping());
  int areas = 0;
  for (const MeshIntersection<double>& pair : overlap.intersections) {
    EXPECT_NE(pair.overlap.kind, Proper);
    areas += pair.overlap.kind == Coplanar ? 1 : 0;
  }
  EXPECT_GE(areas, 2);
  // Separated by one last bit.
  const double bit = 0x1p-51;
  EXPECT_FALSE(
      mesh_overlap(mesh, mesh, {Quatd::Identity(), Vec3d(2 + bit, 0.5, 0.25)}).overlapping());
}

TEST(MeshOverlap, ACubeInsideACubeCrossesNothing) {
  const MeshOverlap<double> overlap = mesh_overlap(cube_mesh(3), cube_mesh(1), Pose<double>{});
  EXPECT_FALSE(overlap.overlapping());
  EXPECT_EQ(overlap.counts.triangle_pairs, 0);
}

TEST(MeshOverlap, TheRecordHasEveryNodePairOnce) {
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
  // Each has a parent among the earlier ones that overlap.
  std::int64_t leaves = 0;
  for (std::size_t i = 1; i < visits.size(); ++i) {
    bool has_parent = false;
    for (std::size_t k = 0; k < i && !has_parent; ++k) {
      const NodePairVisit& parent = visits[k];
      // A leaf is its own only child.
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

/// The result with any front must equal the result without one.
template <class S>
std::size_t expect_same_with_front(const Mesh<S>& a, const Mesh<S>& b, const Pose<S>& b_in_a,
                                   MeshFront& front) {
  const MeshOverlap<S> from_roots = mesh_overlap(a, b, b_in_a);
  const MeshOverlap<S> coherent = mesh_overlap(a, b, b_in_a, nullptr, &front);
  EXPECT_EQ(coherent.counts.leaf_pairs, from_roots.counts.leaf_pairs);
  EXPECT_EQ(coherent.counts.triangle_pairs, from_roots.counts.triangle_pairs);
  EXPECT_EQ(coherent.intersections.size(), from_roots.intersections.size());
  for (std::size_t i = 0;
       i < std::min(coherent.intersections.size(), from_roots.intersections.size()); ++i) {
    const MeshIntersection<S>&one = coherent.intersections[i], &other = from_roots.intersections[i];
    EXPECT_EQ(one.a, other.a);
    EXPECT_EQ(one.b, other.b);
    EXPECT_EQ(one.overlap.kind, other.overlap.kind);
    EXPECT_EQ(one.overlap.segment, other.overlap.segment);
  }
  return from_roots.intersections.size();
}

/// Two meshes of this size that randomly move, jump, deform and get new trees from frame to frame,
/// with one front throughout. Returns the number of frames in which they crossed.
template <class S> int expect_same_through_changes(double size, int seed, int frames) {
  Random random(static_cast<unsigned>(seed));
  const Mesh<double> made_a = built(test::sphere_mesh(size, 16, 11, 0.1));
  const Mesh<double> made_b = built(test::sphere_mesh(0.7 * size, 13, 9, 0.05));
  Mesh<S> a = mesh_cast<S>(made_a), b = mesh_cast<S>(made_b);
  MeshFront front;
  Pose<double> b_in_a = random.pose(size);
  int crossing = 0;
  for (int frame = 0; frame < frames; ++frame) {
    const int change = random.index(16);
    if (change == 0) {
      b_in_a = random.pose(random.index(4) > 0 ? size : 100 * size);
    } else {
      b_in_a.position += 0.02 * size * random.unit_vector();
    }
    if (change >= 12) {
      const double swell = random.uniform(-0.05, 0.05) * size;
      for (Vec3<S>& v : b.vertices) v.x() += static_cast<S>(swell * std::sin(5 * v.y() / size));
      refit(b);
    }
    double unused = 0;
    if (change == 1) update_tree(b, TreeUpdate::Rebuild, unused);
    if (change == 2) {
      for (Vec3<S>& v : a.vertices) v.z() += static_cast<S>(0.3) * v.x();
      update_tree(a, TreeUpdate::Rebuild, unused);
    }
    if (expect_same_with_front(a, b, b_in_a.template cast<S>(), front) > 0) ++crossing;
    if (::testing::Test::HasFailure()) break;
  }
  return crossing;
}

TEST(MeshFront, SlowMatchesATraversalFromTheRoots) {
  for (int i = 0; i < 9; ++i) {
    const double size = std::pow(10.0, i - 4);  // 1e-4 to 1e4
    EXPECT_GT(expect_same_through_changes<float>(size, 53 + i, 300), 60) << size;
    EXPECT_GT(expect_same_through_changes<double>(size, 153 + i, 300), 60) << size;
  }
}

TEST(MeshFront, MatchesAFreshTraversalOnceAtRest) {
  const Mesh<float> a = mesh_cast<float>(built(test::sphere_mesh(1, 24, 17, 0.1)));
  const Mesh<float> b = mesh_cast<float>(built(test::sphere_mesh(1, 21, 15, 0)));
  const auto pose_at = [](float offset) {
    return Pose<float>{Quat<float>(0.8F, 0, 0.6F, 0), Vec3f(offset, 0.2F, 0.1F)};
  };
  MeshFront front;
  for (int frame = 0; frame <= 40; ++frame)
    mesh_overlap(a, b, pose_at(0.04F * static_cast<float>(frame)), nullptr, &front);
  const std::size_t passed = front.pairs.size();
  // Each node gets a turn in eight frames, and one of two levels may get it before the other.
  for (int frame = 0; frame < 200; ++frame) mesh_overlap(a, b, pose_at(1.6F), nullptr, &front);
  MeshFront fresh;
  const MeshOverlap<float> first = mesh_overlap(a, b, pose_at(1.6F), nullptr, &fresh);
  EXPECT_GT(passed, fresh.pairs.size());
  EXPECT_EQ(front.pairs, fresh.pairs);
  EXPECT_GT(first.counts.leaf_pairs, 0);
  // At rest it saves most of the nodes above it.
  const MeshOverlap<float> rest = mesh_overlap(a, b, pose_at(1.6F), nullptr, &front);
  EXPECT_LT(static_cast<double>(rest.counts.node_pairs),
            0.8 * static_cast<double>(first.counts.node_pairs));
}

TEST(MeshFront, SeparatedMeshesAreComparedOnce) {
  const Mesh<double> mesh = built(test::sphere_mesh(1, 16, 11, 0.1));
  MeshFront front;
  mesh_overlap(mesh, mesh, {Quatd::Identity(), Vec3d(1, 0, 0)}, nullptr, &front);
  EXPECT_GT(front.pairs.size(), 100u);
  const Pose<double> far{Quatd::Identity(), Vec3d(10, 0, 0)};
  for (int frame = 0; frame < 3; ++frame) {
    EXPECT_EQ(mesh_overlap(mesh, mesh, far, nullptr, &front).counts.node_pairs, 1);
    EXPECT_EQ(front.pairs, (std::vector<NodeIndices>{{0, 0}}));
  }
}

TEST(MeshFront, IsVoidForARebuiltTree) {
  Mesh<double> a = built(test::sphere_mesh(1, 16, 11, 0.1));
  const Mesh<double> b = built(test::sphere_mesh(1, 13, 9, 0));
  const Pose<double> b_in_a{Quatd::Identity(), Vec3d(1, 0.5, 0.2)};
  MeshFront front;
  mesh_overlap(a, b, b_in_a, nullptr, &front);
  for (Vec3d& v : a.vertices) v.y() *= 1.5;
  refit(a);
  std::vector<NodePairVisit> visits;
  mesh_overlap(a, b, b_in_a, &visits, &front);
  const std::size_t kept = visits.size();
  double unused = 0;
  update_tree(a, TreeUpdate::Rebuild, unused);
  visits.clear();
  const MeshOverlap<double> again = mesh_overlap(a, b, b_in_a, &visits, &front);
  EXPECT_EQ(again.counts.node_pairs, mesh_overlap(a, b, b_in_a).counts.node_pairs);
  EXPECT_LT(kept, visits.size());
}

TEST(MeshFront, TheRecordHasEachComparedPairOnce) {
  const Mesh<double> a = built(test::sphere_mesh(1, 16, 11, 0.1));
  const Mesh<double> b = built(test::sphere_mesh(1, 13, 9, 0));
  MeshFront front;
  for (int frame = 0; frame < 40; ++frame) {
    const Pose<double> b_in_a{Quatd::Identity(), Vec3d(1, 0.05 * frame, 0.2)};
    std::vector<NodePairVisit> visits;
    const MeshOverlap<double> overlap = mesh_overlap(a, b, b_in_a, &visits, &front);
    ASSERT_EQ(overlap.counts.node_pairs, static_cast<std::int64_t>(visits.size()));
    std::set<std::pair<int, int>> seen;
    std::int64_t leaves = 0;
    for (const NodePairVisit& visit : visits) {
      ASSERT_TRUE(seen.emplace(visit.a, visit.b).second) << frame;
      leaves +=
          visit.overlaps && at(a.tree.nodes, visit.a).leaf() && at(b.tree.nodes, visit.b).leaf();
    }
    EXPECT_EQ(leaves, overlap.counts.leaf_pairs);
  }
}

TEST(MeshQueryCost, JudgesTreesAndNotHowNearTheMeshesAre) {
  using enum MeshQueryCost::Verdict;
  const auto counts = [](std::int64_t nodes, std::int64_t triangles) {
    return MeshOverlapCounts{nodes, 0, triangles};
  };
  MeshQueryCost cost;
  EXPECT_EQ(cost.judge(counts(50, 63)), Unknown) << "too few";
  EXPECT_EQ(cost.judge(counts(1000, 500)), Unknown) << "the first one";
  EXPECT_EQ(cost.judge(counts(1300, 500)), AsNew);
  EXPECT_EQ(cost.judge(counts(1301, 500)), Worse);
  EXPECT_EQ(cost.judge(counts(1299, 700)), AsNew) << "closer, and no dearer";
  EXPECT_EQ(cost.judge(counts(1400, 700)), Unknown) << "dearer, and closer";
  EXPECT_EQ(cost.judge(counts(1821, 700)), Worse) << "dearer than that makes them";
  EXPECT_EQ(cost.judge(counts(1290, 300)), Unknown) << "more for each, but there are fewer";
  EXPECT_EQ(cost.judge(counts(1310, 300)), Worse);
  EXPECT_EQ(cost.judge(counts(779, 300)), AsNew);
  EXPECT_EQ(cost.judge(counts(5000, 1001)), Unknown) << "much closer: another base";
  EXPECT_EQ(cost.judge(counts(6500, 1001)), AsNew);
  EXPECT_EQ(cost.judge(counts(900, 499)), Unknown) << "far apart: another base";
  EXPECT_EQ(cost.judge(counts(1171, 499)), Worse);
  // A cheaper later query becomes the new base.
  EXPECT_EQ(cost.judge(counts(700, 480)), AsNew);
  EXPECT_EQ(cost.judge(counts(911, 480)), Worse);
  cost.restart();
  EXPECT_EQ(cost.judge(counts(911, 480)), Unknown);
  EXPECT_EQ(cost.judge(counts(911, 480)), AsNew);
}

}  // namespace
}  // namespace contactscope
