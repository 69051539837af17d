#include "geometry/aabb_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "geometry/mesh.h"
#include "geometry/primitives.h"
#include "mesh_shapes.h"
#include "trace/pair.h"

namespace contactscope::test {
namespace {

template <class S> std::vector<int> found(const AabbTree<S>& tree, const Aabb<S>& box) {
  std::vector<int> triangles;
  tree.query(box, [&](int triangle) { triangles.push_back(triangle); });
  return triangles;
}

/// Every triangle whose extent along each axis meets the box's.
template <class S> std::vector<int> brute_force(const Mesh<S>& mesh, const Aabb<S>& box) {
  std::vector<int> triangles;
  for (int t = 0; t < mesh.triangle_count(); ++t) {
    bool separated = false;
    for (int axis = 0; axis < 3; ++axis) {
      const auto [least, most] =
          std::minmax({mesh.corner(t, 0)[axis], mesh.corner(t, 1)[axis], mesh.corner(t, 2)[axis]});
      separated = separated || most < box.lower[axis] || box.upper[axis] < least;
    }
    if (!separated) triangles.push_back(t);
  }
  return triangles;
}

/// Boxes anywhere about the mesh, over four decades; points; boxes that end at a triangle's start.
template <class S> Aabb<S> random_query(Random& random, const Mesh<S>& mesh) {
  const Aabb<S> bounds = mesh.tree.bounds();
  const Vec3<S> extent = bounds.extent();
  const Vec3<S> corner = mesh.corner(random.index(mesh.triangle_count()), random.index(3));
  Aabb<S> box;
  if (random.chance(0.1)) {
    box.include(corner);
  } else if (random.chance(0.2)) {
    box.include(corner);
    box.include(Vec3<S>(corner + extent.maxCoeff() * random.unit_vector().cast<S>()));
  } else {
    Vec3<S> center;
    Vec3<S> half;
    const double size = random.decade(-4, 0);
    for (int axis = 0; axis < 3; ++axis) {
      const S along = static_cast<S>(random.uniform(-0.1, 1.1));
      center[axis] = bounds.lower[axis] + along * extent[axis];
      half[axis] = static_cast<S>(size * random.uniform(0, 1)) * extent.maxCoeff();
    }
    box.include(Vec3<S>(center - half));
    box.include(Vec3<S>(center + half));
  }
  return box;
}

template <class S>
void expect_queries_equal_brute_force(Random& random, const Mesh<S>& mesh, int count) {
  int hits = 0;
  for (int i = 0; i < count; ++i) {
    const Aabb<S> box = random_query(random, mesh);
    std::vector<int> triangles = found(mesh.tree, box);
    ASSERT_EQ(mesh.tree.recorded_query(box).candidates, triangles);
    std::sort(triangles.begin(), triangles.end());
    ASSERT_EQ(triangles, brute_force(mesh, box));
    hits += triangles.empty() ? 0 : 1;
  }
  EXPECT_GT(hits, count / 5);
}

/// Number of nodes on the longest path from the root to a leaf, both counted.
template <class S> int depth_of(const AabbTree<S>& tree) {
  int depth = 0;
  for (const trace::TreeVisit& visit : tree.recorded_query(tree.bounds()).visits)
    depth = std::max(depth, visit.depth + 1);
  return depth;
}

template <class S, class Part> bool contains(const Aabb<S>& box, const Part& part) {
  Aabb<S> both = box;
  both.include(part);
  return both == box;
}

/// Boxes contain everything below them, every triangle is in one leaf, and no path is too long.
template <class S> void expect_well_formed(const Mesh<S>& mesh) {
  const AabbTree<S>& tree = mesh.tree;
  EXPECT_LE(depth_of(tree), kMaxAabbTreeDepth);
  std::vector<int> sorted = tree.triangles;
  std::sort(sorted.begin(), sorted.end());
  for (int t = 0; t < mesh.triangle_count(); ++t) ASSERT_EQ(sorted[static_cast<std::size_t>(t)], t);

  int next = 0;
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const typename AabbTree<S>::Node& node = tree.nodes[i];
    if (!node.leaf()) {
      ASSERT_GT(node.next, static_cast<int>(i) + 2);
      ASSERT_LE(node.next, static_cast<int>(tree.nodes.size()));
      const std::size_t end = std::min(static_cast<std::size_t>(node.next), i + 100);
      for (std::size_t below = i + 1; below < end; ++below) {
        ASSERT_TRUE(contains(node.box, tree.nodes[below].box));
      }
      continue;
    }
    ASSERT_EQ(node.next, next) << "leaves hold the triangles in tree order";
    next += node.count;
    for (int k = node.next; k < next; ++k) {
      const int t = tree.triangles[static_cast<std::size_t>(k)];
      for (int c = 0; c < 3; ++c) ASSERT_TRUE(contains(node.box, mesh.corner(t, c)));
      ASSERT_TRUE(k == node.next || tree.triangles[static_cast<std::size_t>(k) - 1] < t);
    }
  }
  EXPECT_EQ(next, mesh.triangle_count());
}

void check(Random& random, const Mesh<double>& mesh, int queries = 300) {
  Mesh<float> rounded = mesh_cast<float>(mesh);
  Mesh<double> moved = mesh;
  expect_well_formed(mesh);
  expect_well_formed(rounded);
  expect_queries_equal_brute_force(random, mesh, queries);
  expect_queries_equal_brute_force(random, rounded, queries);

  const Vec3d extent = mesh.tree.bounds().extent();
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    moved.vertices[i] += 0.2 * extent.cwiseProduct(random.unit_vector());
    rounded.vertices[i] = moved.vertices[i].cast<float>();
  }
  refit(moved);
  refit(rounded);
  expect_well_formed(moved);
  expect_well_formed(rounded);
  expect_queries_equal_brute_force(random, moved, queries);
  expect_queries_equal_brute_force(random, rounded, queries);
}

Mesh<double> mesh_of(const MeshInput& input) { return build_mesh(input.vertices, input.triangles); }

TEST(AabbTree, StopsAfterTheFirstAcceptedTriangle) {
  Random random(31);
  const Mesh<double> mesh = make_grid(10, 10, 24, 24, 0.5);
  int stopped = 0;
  for (int i = 0; i < 300; ++i) {
    const Aabb<double> box = random_query(random, mesh);
    const std::vector<int> all = found(mesh.tree, box);
    // The wanted one is in the box, or does not exist.
    const int place = all.empty() ? 0 : random.index(static_cast<int>(all.size()) + 1);
    const int wanted =
        place < static_cast<int>(all.size()) ? all[static_cast<std::size_t>(place)] : -1;
    std::vector<int> requested;
    const bool any = mesh.tree.any_of(box, [&](int triangle) {
      requested.push_back(triangle);
      return triangle == wanted;
    });
    ASSERT_EQ(any, wanted >= 0);
    const std::size_t count = any ? static_cast<std::size_t>(place) + 1 : all.size();
    ASSERT_EQ(requested,
              std::vector<int>(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count)));
    stopped += requested.size() < all.size() ? 1 : 0;
  }
  EXPECT_GT(stopped, 50);
}

TEST(AabbTree, SlowQueriesEqualBruteForceOnSoups) {
  Random random(1);
  for (const int count : {1, 2, 3, 4, 5, 9, 100, 2000}) {
    check(random, mesh_of(random_soup(random, count, 1, 0.1, Vec3d::Zero())));
  }
}

TEST(AabbTree, SlowQueriesEqualBruteForceAtEveryScaleAndFarFromTheOrigin) {
  Random random(2);
  for (const double side : {1e-4, 1.0, 1e4}) {
    for (const double away : {0.0, 1e2, 1e6}) {
      const Vec3d center = away * side * random.unit_vector();
      check(random, mesh_of(random_soup(random, 300, side, 0.3 * side, center)), 100);
    }
  }
}

TEST(AabbTree, SlowQueriesEqualBruteForceOnSliversThatCrossTheWholeMesh) {
  Random random(3);
  check(random, mesh_of(random_slivers(random, 1000, 1, Vec3d::Zero())));
}

TEST(AabbTree, SlowQueriesEqualBruteForceOnFlatAndWavyGrids) {
  Random random(4);
  check(random, make_grid(10, 10, 30, 20, 0));
  check(random, make_grid(10, 1, 50, 3, 0.5));
}

TEST(AabbTree, SlowQueriesEqualBruteForceOnASkewedMesh) {
  Random random(5);
  check(random, mesh_of(skewed_mesh(random, 2000)));
}

TEST(AabbTree, WithoutTrianglesNothingIsFound) {
  const AabbTree<double> tree = build_aabb_tree({});
  const Aabb<double> everything{Vec3d(-1, -1, -1), Vec3d(1, 1, 1)};
  EXPECT_TRUE(tree.bounds().empty());
  EXPECT_EQ(depth_of(tree), 0);
  EXPECT_TRUE(found(tree, everything).empty());
  EXPECT_TRUE(tree.recorded_query(everything).visits.empty());
}

TEST(AabbTree, AnEmptyBoxFindsNothing) {
  const Mesh<double> grid = make_grid(1, 1, 4, 4, 0);
  EXPECT_TRUE(found(grid.tree, Aabb<double>{}).empty());
}

TEST(AabbTree, TrianglesComeInTheSameOrderForEveryBox) {
  const Mesh<double> grid = make_grid(10, 10, 20, 20, 0.3);
  const std::vector<int> all = found(grid.tree, grid.tree.bounds());
  EXPECT_EQ(all, grid.tree.triangles);
  EXPECT_EQ(all, make_grid(10, 10, 20, 20, 0.3).tree.triangles);

  const std::vector<int> some = found(grid.tree, Aabb<double>{Vec3d(-2, -1, -2), Vec3d(1, 1, 1)});
  EXPECT_GT(some.size(), 10u);
  auto at = all.begin();
  for (const int triangle : some) {
    at = std::find(at, all.end(), triangle);
    ASSERT_NE(at, all.end()) << triangle << " is out of order";
  }
}

TEST(AabbTree, ARecordedQueryHasWhatItVisited) {
  const Mesh<double> grid = make_grid(10, 10, 20, 20, 0);
  const Aabb<double> box{Vec3d(1.1, -1, 1.1), Vec3d(1.3, 1, 1.4)};  // inside one cell
  const trace::Tree record = grid.tree.recorded_query(box);
  EXPECT_EQ(record.candidates.size(), 2u);
  ASSERT_FALSE(record.visits.empty());
  EXPECT_EQ(record.visits[0].box.lower, grid.tree.bounds().lower);
  EXPECT_EQ(record.visits[0].box.upper, grid.tree.bounds().upper);
  EXPECT_EQ(record.visits[0].depth, 0);
  EXPECT_LT(record.visits.size(), 60u);

  for (std::size_t i = 0; i < record.visits.size(); ++i) {
    const trace::TreeVisit& visit = record.visits[i];
    EXPECT_EQ(visit.overlaps, overlaps(Aabb<double>{visit.box.lower, visit.box.upper}, box));
    if (i == 0) continue;
    // A child follows the node that was just entered; otherwise the walk continues above.
    const trace::TreeVisit& last = record.visits[i - 1];
    if (last.overlaps && !last.leaf) {
      EXPECT_EQ(visit.depth, last.depth + 1);
    } else {
      EXPECT_LE(visit.depth, last.depth);
    }
  }
}

TEST(AabbTree, AQueryMissedAtTheRootVisitsNothingElse) {
  const Mesh<double> grid = make_grid(10, 10, 20, 20, 0);
  const trace::Tree record = grid.tree.recorded_query({Vec3d(20, 0, 0), Vec3d(21, 1, 1)});
  ASSERT_EQ(record.visits.size(), 1u);
  EXPECT_FALSE(record.visits[0].overlaps);
}

TEST(AabbTree, SlowAMillionCopiesOfOneTriangleMakeABalancedTree) {
  const Aabb<double> box{Vec3d(0, 0, 0), Vec3d(1, 1, 0)};
  const std::vector<Aabb<double>> boxes(1'000'000, box);
  const AabbTree<double> tree = build_aabb_tree(boxes);
  EXPECT_LE(depth_of(tree), 20);
  EXPECT_EQ(found(tree, {Vec3d(1, 1, 0), Vec3d(2, 2, 2)}).size(), 1'000'000u);
  EXPECT_TRUE(found(tree, {Vec3d(1, 1, 0.1), Vec3d(2, 2, 2)}).empty());
}

TEST(AabbTree, BoxesThatEachDwarfTheLastDoNotMakeAChain) {
  std::vector<Aabb<double>> boxes;
  for (int i = -1000; i < 1000; ++i) {
    const double at = std::ldexp(1.0, i);
    boxes.push_back({Vec3d(at, 0, 0), Vec3d(at, at, at)});
  }
  const AabbTree<double> tree = build_aabb_tree(boxes);
  EXPECT_LE(depth_of(tree), kMaxAabbTreeDepth);
  EXPECT_EQ(found(tree, {Vec3d(3, 0, 0), Vec3d(20, 1, 1)}).size(), 3u);
}

/// Expected cost of a query: the number of box tests, each weighted by the area of its box.
double expected_tests(const AabbTree<double>& tree) {
  double tests = 0;
  for (const AabbTree<double>::Node& node : tree.nodes) {
    tests += surface_area(node.box) * (node.leaf() ? node.count : 2);
  }
  return tests / surface_area(tree.bounds());
}

/// The same for a tree that halves by centre along the longest axis, down to `largest_leaf`.
double expected_tests_of_halves(std::vector<Aabb<double>> boxes, std::size_t largest_leaf) {
  Aabb<double> bounds;
  Aabb<double> centers;
  for (const Aabb<double>& box : boxes) {
    bounds.include(box);
    centers.include(box.center());
  }
  if (boxes.size() <= largest_leaf) return static_cast<double>(boxes.size());
  int axis = 0;
  centers.extent().maxCoeff(&axis);
  std::sort(boxes.begin(), boxes.end(), [&](const Aabb<double>& a, const Aabb<double>& b) {
    return a.center()[axis] < b.center()[axis];
  });
  const auto middle = boxes.begin() + static_cast<std::ptrdiff_t>(boxes.size() / 2);
  double tests = 2;
  for (const std::vector<Aabb<double>>& half :
       {std::vector(boxes.begin(), middle), std::vector(middle, boxes.end())}) {
    Aabb<double> half_bounds;
    for (const Aabb<double>& box : half) half_bounds.include(box);
    tests += surface_area(half_bounds) / surface_area(bounds) *
             expected_tests_of_halves(half, largest_leaf);
  }
  return tests;
}

TEST(AabbTree, TheHeuristicBeatsHalvingOnASkewedMesh) {
  Random random(6);
  const Mesh<double> mesh = mesh_of(skewed_mesh(random, 3000));
  for (const std::size_t largest_leaf : {1u, 2u, 4u, 8u}) {
    EXPECT_LT(expected_tests(mesh.tree),
              0.9 * expected_tests_of_halves(mesh.tree.boxes, largest_leaf))
        << largest_leaf;
  }
}

TEST(AabbTree, ATrillionTimesSmallerPartIsSplitAsWell) {
  Random random(8);
  const auto small = random_soup(random, 2000, 1e-6, 1e-8, Vec3d::Zero());
  const Mesh<double> alone = mesh_of(small);
  std::vector<Aabb<double>> boxes = alone.tree.boxes;
  boxes.push_back({Vec3d(1e6, 0, 0), Vec3d(1e6, 1, 1)});
  const AabbTree<double> tree = build_aabb_tree(boxes);
  const auto visits = [](const AabbTree<double>& of) {
    std::size_t sum = 0;
    for (const Aabb<double>& box : of.boxes) sum += of.recorded_query(box).visits.size();
    return sum;
  };
  EXPECT_LT(static_cast<double>(visits(tree)), 1.1 * static_cast<double>(visits(alone.tree)));
}

TEST(AabbTree, TheHeuristicIsNoWorseThanHalvingOnAGrid) {
  const Mesh<double> mesh = make_grid(10, 10, 40, 40, 0.3);
  EXPECT_LT(expected_tests(mesh.tree), 1.02 * expected_tests_of_halves(mesh.tree.boxes, 4));
}

}  // namespace
}  // namespace contactscope::test
