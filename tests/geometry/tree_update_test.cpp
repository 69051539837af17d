#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "geometry/mesh.h"
#include "support/random_geometry.h"
#include "support/sphere_mesh.h"

namespace contactscope {
namespace {

using test::Random;

/// Turns every point about z by `angle` per metre of height.
std::vector<Vec3d> twisted(const std::vector<Vec3d>& vertices, double angle) {
  return mapped(vertices, [angle](const Vec3d& v) -> Vec3d {
    const double c = std::cos(angle * v.z()), s = std::sin(angle * v.z());
    return {c * v.x() - s * v.y(), s * v.x() + c * v.y(), v.z()};
  });
}

/// Number of boxes that queries with small boxes on the surface test, in total.
int boxes_tested(const Mesh<double>& mesh) {
  Random random(71);
  int tested = 0;
  for (int i = 0; i < 400; ++i) {
    Aabb<double> box;
    box.include(at(mesh.vertices, random.index(count_of(mesh.vertices))));
    box.lower -= Vec3d::Constant(0.01);
    box.upper += Vec3d::Constant(0.01);
    const AabbTree<double>& tree = mesh.tree;
    for (int n = 0; n < count_of(tree.nodes);) {
      const AabbTree<double>::Node& node = at(tree.nodes, n);
      const bool hit = overlaps(node.box, box);
      tested += 1 + (hit && node.leaf() ? node.count : 0);
      n = hit || node.leaf() ? n + 1 : node.next;
    }
  }
  return tested;
}

Mesh<double> sphere() { return test::built(test::sphere_mesh(1, 40, 30, 0)); }

TEST(TreeUpdate, ARefitTreeHoldsTheMovedTriangles) {
  Mesh<double> mesh = sphere();
  double cost = mesh.tree.expected_cost();
  const double cost_before = cost;
  mesh.vertices = twisted(mesh.vertices, 2);
  EXPECT_FALSE(update_tree(mesh, TreeUpdate::Refit, cost));
  EXPECT_EQ(cost, cost_before);
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    const Aabb<double> box = box_of<double>(mesh.vertices, at(mesh.triangles, t));
    bool found = false;
    mesh.tree.query(box, [&](int triangle) { found |= triangle == t; });
    ASSERT_TRUE(found) << t;
  }
}

TEST(TreeUpdate, ARebuiltTreeIsTheOneOfTheMovedMesh) {
  Mesh<double> mesh = sphere();
  double cost = mesh.tree.expected_cost();
  mesh.vertices = twisted(mesh.vertices, 2);
  EXPECT_TRUE(update_tree(mesh, TreeUpdate::Rebuild, cost));
  const Mesh<double> fresh = build_mesh(mesh.vertices, mesh.triangles);
  EXPECT_EQ(mesh.tree.triangles, fresh.tree.triangles);
  EXPECT_EQ(cost, fresh.tree.expected_cost());
}

TEST(TreeUpdate, CostIsThatOfTheShapeAtEveryScale) {
  Mesh<double> mesh = sphere();
  const double cost = mesh.tree.expected_cost();
  EXPECT_GT(cost, 2);
  for (const double scale : {0x1p-13, 0x1p13}) {
    Mesh<double> scaled = mesh;
    double unused = 0;
    for (Vec3d& vertex : scaled.vertices) vertex *= scale;
    update_tree(scaled, TreeUpdate::Refit, unused);
    EXPECT_EQ(scaled.tree.expected_cost(), cost);
  }
}

TEST(TreeUpdate, SlowAutoRebuildsBeforeQueriesCostTooMuch) {
  const std::vector<Vec3d> before = sphere().vertices;
  Mesh<double> refitted = sphere(), chosen = sphere();
  double cost = chosen.tree.expected_cost(), unused = cost;
  int rebuilt = 0;
  double worst_refitted = 0, worst_chosen = 0;
  for (int frame = 1; frame <= 50; ++frame) {
    refitted.vertices = twisted(before, 0.2 * frame);
    chosen.vertices = refitted.vertices;
    update_tree(refitted, TreeUpdate::Refit, unused);
    rebuilt += update_tree(chosen, TreeUpdate::Auto, cost) ? 1 : 0;
    const double fresh = boxes_tested(build_mesh(refitted.vertices, refitted.triangles));
    worst_refitted = std::max(worst_refitted, boxes_tested(refitted) / fresh);
    worst_chosen = std::max(worst_chosen, boxes_tested(chosen) / fresh);
  }
  EXPECT_GT(rebuilt, 1);
  EXPECT_LT(rebuilt, 25);
  EXPECT_GT(worst_refitted, 1.2 * kWorstTreeCost) << "the twist is no challenge";
  EXPECT_LT(worst_chosen, 1.1 * kWorstTreeCost);
  std::printf("boxes tested, over those of a fresh tree: refitted %.2f, auto %.2f with %d builds\n",
              worst_refitted, worst_chosen, rebuilt);
}

}  // namespace
}  // namespace contactscope
