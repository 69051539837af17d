#include "query/v_clip.h"

#include <gtest/gtest.h>

#include "geometry/primitives.h"
#include "support/brute_force_distance.h"
#include "support/builders.h"
#include "support/cases.h"
#include "support/random_geometry.h"

// Distances by V-Clip against brute force over all pairs of features.
namespace contactscope {
namespace {

using test::Random;

struct TwoHulls {
  Hull<double> a, b;
  Pose<double> b_in_a;
  double size = 1;
};

/// Boxes and hulls of 4 to 30 points, of 0.1 mm to 10 km, anyhow or parallel, from deep overlap to far away.
TwoHulls random_hulls(Random& random) {
  TwoHulls pair;
  pair.size = random.decade(-4, 4);
  for (Hull<double>* hull : {&pair.a, &pair.b})
    *hull = random.chance(0.3) ? test::random_box(random, pair.size, 10)
                               : test::random_hull(random, 4 + random.index(27), pair.size, 5);
  if (random.chance(0.8)) pair.b_in_a.rotation = random.rotation();
  pair.b_in_a.position = random.uniform(0.2, 4) * pair.size * random.unit_vector();
  return pair;
}

template <class S> void judge_distances(int cases, std::uint64_t seed) {
  Random random(seed);
  int separated = 0, together = 0, walks_of_some_steps = 0;
  for (int i = 0; i < cases; ++i) {
    const TwoHulls pair = random_hulls(random);
    const Hull<S> a = hull_cast<S>(pair.a), b = hull_cast<S>(pair.b);
    const Pose<S> pose = pair.b_in_a.cast<S>();
    Pose<double> rounded = pose.template cast<double>();
    rounded.rotation.normalize();
    std::vector<ComparedFeatures> walk;
    const VClipResult<S> found = v_clip<S>(a, b, pose, nullptr, &walk);
    const auto truth = static_cast<double>(
        test::brute_force_distance(test::features_of(hull_cast<double>(a), {}),
                                   test::features_of(hull_cast<double>(b), rounded))
            .distance);
    const double rounding = 64 * static_cast<double>(std::numeric_limits<S>::epsilon()) *
                            (pair.size + pair.b_in_a.position.norm());
    ASSERT_NE(found.status, VClipStatus::OutOfSteps) << i;
    ASSERT_EQ(walk.size(), static_cast<std::size_t>(found.steps) + 1) << i;
    if (found.status == VClipStatus::Overlap) {
      ASSERT_LE(truth, rounding) << i;
      ++together;
      continue;
    }
    ++separated;
    ASSERT_NEAR(static_cast<double>(found.distance), truth, rounding) << i;
    ASSERT_NEAR(static_cast<double>((found.on_b - found.on_a).norm()), truth, rounding) << i;
    // From the result, and from anywhere else, it ends at the same distance.
    const VClipResult<S> stays = v_clip<S>(a, b, pose, &found.features);
    ASSERT_EQ(stays.status, VClipStatus::Separated) << i;
    ASSERT_NEAR(static_cast<double>(stays.distance), truth, rounding) << i;
    walks_of_some_steps += stays.steps > 0;
    const ComparedFeatures elsewhere{{FeatureKind::Face, random.index(a.face_count())},
                                     {FeatureKind::Vertex, random.index(b.vertex_count())}};
    const VClipResult<S> again = v_clip<S>(a, b, pose, &elsewhere);
    ASSERT_EQ(again.status, VClipStatus::Separated) << i;
    ASSERT_NEAR(static_cast<double>(again.distance), truth, rounding) << i;
  }
  EXPECT_LE(walks_of_some_steps, cases / 1000) << "features that are as close, within rounding";
  EXPECT_GT(separated, cases / 3);
  EXPECT_GT(together, cases / 10);
}

TEST(VClip, DistancesAreThoseOfBruteForceInDouble) { judge_distances<double>(200, 361); }
TEST(VClip, DistancesAreThoseOfBruteForceInFloat) { judge_distances<float>(200, 362); }
TEST(VClip, SlowDistances) {
  judge_distances<double>(test::cases(2'000), 363);
  judge_distances<float>(test::cases(2'000), 364);
}

TEST(VClip, ClosestFeaturesOfTwoBoxesAreTheirCornerEdgeAndFace) {
  const Hull<double> box = make_box(Vec3d(1, 1, 1));
  const auto kinds = [&](const Vec3d& offset, const Quatd& rotation) {
    const VClipResult<double> found = v_clip<double>(box, box, {rotation, offset});
    EXPECT_EQ(found.status, VClipStatus::Separated);
    const std::string names = "vef";
    return std::string{names[static_cast<std::size_t>(found.features.a.kind)],
                       names[static_cast<std::size_t>(found.features.b.kind)]};
  };
  const double eighth = test::kDegree * 45;
  EXPECT_EQ(kinds({3, 3, 3}, Quatd::Identity()), "vv");
  EXPECT_EQ(kinds({0.1, 3, 0.2}, test::about(Vec3d(1, 0, 1).normalized(), 0.9)), "fv");
  EXPECT_EQ(kinds({2.5, 2.5, 0},
                  test::about(Vec3d::UnitZ(), -eighth) * test::about(Vec3d::UnitX(), eighth)),
            "ee");
}

// A box that turns once above another: from the last frame's features a few steps are enough.
TEST(VClip, AWalkFromTheLastFrameIsShort) {
  const Hull<double> below = make_box(Vec3d(1, 0.5, 1)), above = make_box(Vec3d(0.5, 0.5, 0.5));
  ComparedFeatures last{};
  int warm = 0, cold = 0;
  for (int i = 0; i < 360; ++i) {
    const Pose<double> pose{test::about(Vec3d(1, 2, 3).normalized(), test::kDegree * i),
                            Vec3d(0.3, 2, 0.1)};
    const VClipResult<double> from_last =
        v_clip<double>(below, above, pose, i == 0 ? nullptr : &last);
    const VClipResult<double> from_first = v_clip<double>(below, above, pose);
    EXPECT_NEAR(from_last.distance, from_first.distance, 1e-14);
    warm += from_last.steps;
    cold += from_first.steps;
    last = from_last.features;
  }
  EXPECT_LT(20 * warm, cold);
}

}  // namespace
}  // namespace contactscope
