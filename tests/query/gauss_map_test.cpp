#include "query/gauss_map.h"

#include <gtest/gtest.h>

#include <set>
#include <utility>

#include "query/hull_pair.h"
#include "query/support_set.h"
#include "support/builders.h"
#include "support/minkowski_face.h"

namespace contactscope {
namespace {

using EdgePairs = std::set<std::pair<int, int>>;

const Plane<double>& plane_at(const Hull<double>& hull, int half_edge) {
  const int face = hull.half_edges[static_cast<std::size_t>(half_edge)].face;
  return hull.planes[static_cast<std::size_t>(face)];
}

EdgePairs by_arc_test(const Hull<double>& a, const Hull<double>& b, const Quatd& b_in_a) {
  EdgePairs pairs;
  for (int i = 0; i < a.edge_count(); ++i) {
    for (int j = 0; j < b.edge_count(); ++j) {
      const Vec3d b1 = b_in_a * plane_at(b, 2 * j).normal;
      const Vec3d b2 = b_in_a * plane_at(b, 2 * j + 1).normal;
      if (test::is_minkowski_face(plane_at(a, 2 * i).normal, plane_at(a, 2 * i + 1).normal, b1,
                                  b2)) {
        pairs.emplace(i, j);
      }
    }
  }
  return pairs;
}

EdgePairs by_walk(const Hull<double>& a, const Hull<double>& b, const Quatd& b_in_a) {
  EdgePairs pairs;
  for (int i = 0; i < a.edge_count(); ++i) {
    const Vec3d a1 = b_in_a.conjugate() * plane_at(a, 2 * i).normal;
    const Vec3d a2 = b_in_a.conjugate() * plane_at(a, 2 * i + 1).normal;
    walk_arc(b, a1, a2, support_index(support_set(b), Vec3d(-a1)),
             support_index(support_set(b), Vec3d(-a2)),
             [&](int edge_b) { EXPECT_TRUE(pairs.emplace(i, edge_b / 2).second); });
  }
  return pairs;
}

TEST(GaussMap, SlowWalkMeetsTheEdgesWhoseArcsCross) {
  test::Random random(2013);
  std::size_t faces = 0;
  for (int i = 0; i < 300; ++i) {
    const Hull<double> a = test::random_hull(random, 4 + random.index(30), 1, 3);
    const Hull<double> b = i % 3 == 0 ? test::random_box(random, 2, 3)
                                      : test::random_hull(random, 4 + random.index(30), 1, 3);
    const Quatd turn = random.rotation();
    const EdgePairs walked = by_walk(a, b, turn);
    EXPECT_EQ(walked, by_arc_test(a, b, turn)) << "pair " << i;
    faces += walked.size();
  }
  EXPECT_GT(faces, 1000u);
}

TEST(GaussMap, LevelCubesHaveNoCrossingArcs) {
  const Hull<double> box = test::cube(0.5);
  EXPECT_TRUE(by_arc_test(box, box, Quatd::Identity()).empty());
}

TEST(GaussMap, WalkBetweenOneRegionVisitsNothing) {
  const Hull<double> box = test::cube(0.5);
  const Vec3d a1 = Vec3d(1, 2, 3).normalized();
  const Vec3d a2 = Vec3d(3, 1, 2).normalized();
  const int corner = support_index(support_set(box), Vec3d(-a1));
  ASSERT_EQ(corner, support_index(support_set(box), Vec3d(-a2)));
  int visits = 0;
  walk_arc(box, a1, a2, corner, corner, [&](int) { ++visits; });
  EXPECT_EQ(visits, 0);
}

}  // namespace
}  // namespace contactscope
