#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "support/builders.h"

namespace contactscope {
namespace {

using test::collide;
using test::PairCase;
using test::sorted_ids;

template <class S> std::vector<FeatureId> flipped(std::vector<FeatureId> ids) {
  for (FeatureId& id : ids) id = id.flipped();
  std::sort(ids.begin(), ids.end());
  return ids;
}

template <class S> class ContactIds : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(ContactIds, Scalars);

TYPED_TEST(ContactIds, FlipWhenAAndBAreSwapped) {
  using S = TypeParam;
  // Box on box in general position: the same two faces meet whichever is the reference.
  test::Random random(2007);
  for (int i = 0; i < 500; ++i) {
    PairCase<double> pair{make_box({0.5, 0.2, 0.4}), test::at(0, 0, 0), make_box({0.3, 0.3, 0.6}),
                          test::at(0, 0, 0)};
    const double tilt = random.uniform(0, 1e-3);
    pair.pose_b.rotation =
        test::about(Vec3d::UnitX(), tilt) * test::about(Vec3d::UnitY(), random.uniform(0.1, 6));
    pair.pose_b.position = random.level(0.4, 0.49);
    const PairCase<S> placed = test::moved(pair, random.pose(5)).cast<S>();
    const Manifold<S> there = collide(placed);
    const Manifold<S> back = collide(test::swapped(placed));
    ASSERT_GE(there.points.size(), 3u);
    ASSERT_EQ(flipped<S>(sorted_ids(there)), sorted_ids(back)) << "pair " << i;
    ASSERT_LT((there.normal + back.normal).norm(), 2e-3);

    // The same points, except for the offset between the two reference faces.
    std::map<FeatureId, const ContactPoint<S>*> by_id;
    for (const ContactPoint<S>& point : back.points) by_id[point.id.flipped()] = &point;
    for (const ContactPoint<S>& point : there.points) {
      const ContactPoint<S>& other = *by_id.at(point.id);
      const Vec3<S> between = point.position - other.position;
      const Vec3<S> aside = between - there.normal.dot(between) * there.normal;
      // 1e-3 of tilt times about 1 cm of overlap, more where edges cross at a small angle.
      ASSERT_LT(aside.norm(), 2e-4);
      ASSERT_NEAR(point.separation, other.separation, 5e-5);
    }
  }
}

TYPED_TEST(ContactIds, FlipForAnEdgeContactToo) {
  using S = TypeParam;
  const PairCase<S> pair = test::crossed_edges(1, 0.01).cast<S>();
  const Manifold<S> there = collide(pair);
  const Manifold<S> back = collide(test::swapped(pair));
  ASSERT_EQ(there.points.size(), 1u);
  EXPECT_EQ(flipped<S>(sorted_ids(there)), sorted_ids(back));
  const double rounding = 16 * std::numeric_limits<S>::epsilon();
  EXPECT_LT((there.points[0].position - back.points[0].position).norm(), rounding);
}

TYPED_TEST(ContactIds, SlowAreUniqueWithinAManifold) {
  using S = TypeParam;
  test::Random random(11);
  std::size_t points = 0;
  for (int i = 0; i < 3000; ++i) {
    const Manifold<S> manifold = collide(test::random_pair(random).cast<S>());
    const std::vector<FeatureId> ids = sorted_ids(manifold);
    points += ids.size();
    ASSERT_EQ(std::adjacent_find(ids.begin(), ids.end()), ids.end()) << "pair " << i;
  }
  EXPECT_GT(points, 3000u);
}

TYPED_TEST(ContactIds, StayWhileTheFeaturesStay) {
  using S = TypeParam;
  // A box that turns and slides by a little: the same edges cross.
  const PairCase<double> pair = test::stacked_cubes(0.3, 0.01);
  const std::vector<FeatureId> before = sorted_ids(collide(pair.cast<S>()));
  ASSERT_EQ(before.size(), 8u);
  test::Random random(12);
  for (int i = 0; i < 200; ++i) {
    PairCase<double> after = pair;
    after.pose_b.position += 2e-4 * random.unit_vector();
    after.pose_b.rotation = random.rotation_by(random.uniform(0, 5e-4)) * pair.pose_b.rotation;
    EXPECT_EQ(sorted_ids(collide(after.cast<S>())), before);
  }
}

TYPED_TEST(ContactIds, ACornerInsideTheOtherFaceHasItsTwoEdges) {
  using S = TypeParam;
  const PairCase<double> pair{make_box({5, 1, 5}), test::at(0, -1, 0), test::cube(0.5),
                              test::at(1, 0.49, 2)};
  for (const ContactPoint<S>& point : collide(pair.cast<S>()).points) {
    EXPECT_EQ(point.id.first.owner, Owner::B);
    EXPECT_EQ(point.id.second.owner, Owner::B);
    EXPECT_NE(point.id.first.index, point.id.second.index);
  }
}

}  // namespace
}  // namespace contactscope
