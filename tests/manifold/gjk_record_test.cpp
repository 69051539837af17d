#include <gtest/gtest.h>

#include "manifold/placed_shapes.h"
#include "support/builders.h"

namespace contactscope {
namespace {

// GJK searches for the closest point over an edge and a vertex, but not above a face.
TEST(GjkRecord, HasTheStepsOfGjkIfItRan) {
  const Shape<double> box = test::cube(0.5);
  const auto record_at = [&](const Vec3d& center) {
    return test::record_of<double>({box, {}, test::ball(0.5), {Quatd::Identity(), center}});
  };
  EXPECT_FALSE(record_at(Vec3d(0.1, 0.9, 0.2)).gjk.has_value());
  const trace::Pair next_to_edge = record_at(Vec3d(0.7, 0.7, 0.1));
  ASSERT_TRUE(next_to_edge.gjk.has_value());
  EXPECT_EQ(next_to_edge.gjk->status, "separated");
  EXPECT_GE(next_to_edge.gjk->iterations, 1);
  EXPECT_NEAR(next_to_edge.gjk->distance, std::sqrt(0.08), 1e-15);
  // The hull is a here, so the pair is recorded mirrored.
  EXPECT_LT((next_to_edge.gjk->point_a - Vec3d(0.5, 0.5, 0.1)).norm(), 1e-15);
  EXPECT_LT((next_to_edge.gjk->point_b - Vec3d(0.7, 0.7, 0.1)).norm(), 1e-15);
  ASSERT_FALSE(next_to_edge.gjk->steps.empty());
  for (const trace::Simplex& simplex : next_to_edge.gjk->steps) {
    ASSERT_GE(simplex.size(), 1u);
    ASSERT_LE(simplex.size(), 4u);
    for (const trace::SimplexVertex& vertex : simplex) {
      EXPECT_LT((vertex.a.cwiseAbs() - Vec3d(0.5, 0.5, 0.5)).norm(), 1e-15);  // a corner
      EXPECT_LT((vertex.b - Vec3d(0.7, 0.7, 0.1)).norm(), 1e-15);             // the centre
    }
  }
}

// The last simplex carries the closest points; without it the record would be incomplete.
TEST(GjkRecord, TheLastStepCarriesTheClosestPoints) {
  const Shape<double> box = test::cube(0.5);
  for (const Vec3d& center : {Vec3d(0.7, 0.7, 0.1), Vec3d(0.7, -0.8, 0.9), Vec3d(-0.6, 0.2, 0.7)}) {
    const trace::Pair pair =
        test::record_of<double>({box, {}, test::ball(0.5), {Quatd::Identity(), center}});
    ASSERT_TRUE(pair.gjk.has_value());
    ASSERT_EQ(pair.gjk->steps.size(), static_cast<std::size_t>(pair.gjk->iterations));
    const trace::Simplex& last = pair.gjk->steps.back();
    // Within the bounds of the simplex's corners.
    Vec3d lower = last.front().a, upper = last.front().a;
    for (const trace::SimplexVertex& vertex : last) {
      lower = lower.cwiseMin(vertex.a);
      upper = upper.cwiseMax(vertex.a);
    }
    EXPECT_TRUE((pair.gjk->point_a.array() >= lower.array() - 1e-12).all());
    EXPECT_TRUE((pair.gjk->point_a.array() <= upper.array() + 1e-12).all());
  }
}

}  // namespace
}  // namespace contactscope
