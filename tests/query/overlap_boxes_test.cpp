#include <gmock/gmock.h>

#include "query/box_pairs.h"
#include "query/overlap.h"
#include "support/brute_force_boxes.h"

namespace contactscope {
namespace {

using test::exact_gap;
using test::Random;
using test::Turned;

template <class S> class OverlapOfBoxes : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(OverlapOfBoxes, Scalars);

template <class S>
Obb<S> box_at(const Vec3d& center, const Vec3d& half, const Quatd& turn = Quatd::Identity()) {
  return {center.cast<S>(), turn.toRotationMatrix().cast<S>(), half.cast<S>()};
}

/// Tries every kind of pair at every size, near the origin and 1000 times the size away.
template <class S, class Check>
void for_random_boxes(std::uint64_t seed, int trials, const Check& check) {
  Random random(seed);
  for (int trial = 0; trial < trials; ++trial) {
    const double size = random.decade(-4, 4);
    const double out = random.chance(0.25) ? 1000 * size : 0;
    const auto [a, b] = test::random_boxes<S>(random, size, static_cast<Turned>(trial % 4), out);
    check(a, b, trial);
    if (testing::Test::HasFailure()) return;
  }
}

/// The three promises of overlap.h.
template <class S> void expect_nothing_lost(int trials) {
  int overlapping = 0, undecided = 0;
  for_random_boxes<S>(1, trials, [&](const Obb<S>& a, const Obb<S>& b, int trial) {
    const double gap = exact_gap(a, b);
    const double unit = std::numeric_limits<S>::epsilon() * test::size_of_pair(a, b);
    const bool inclusive = overlaps(a, b, Comparison<S>::inclusive());
    const bool exclusive = overlaps(a, b, Comparison<S>::exclusive());
    if (gap <= 0) {
      EXPECT_TRUE(inclusive) << trial << ": gap " << gap / unit;
    }
    if (gap > 32 * unit) {
      EXPECT_FALSE(inclusive) << trial << ": gap " << gap / unit;
    }
    if (gap >= 0) {
      EXPECT_FALSE(exclusive) << trial << ": gap " << gap / unit;
    }
    if (gap < -48 * unit) {
      EXPECT_TRUE(exclusive) << trial << ": gap " << gap / unit;
    }
    EXPECT_EQ(overlaps(b, a, Comparison<S>::inclusive()), inclusive) << trial;
    EXPECT_EQ(overlaps(b, a, Comparison<S>::exclusive()), exclusive) << trial;
    overlapping += gap <= 0 ? 1 : 0;
    undecided += std::abs(gap) < 128 * unit ? 1 : 0;
  });
  // The cases are as intended: of both kinds, and many within rounding.
  EXPECT_GT(overlapping, trials / 10);
  EXPECT_LT(overlapping, trials * 9 / 10);
  EXPECT_GT(undecided, trials / 20);
}

TYPED_TEST(OverlapOfBoxes, LosesNothing) { expect_nothing_lost<TypeParam>(2000); }
TYPED_TEST(OverlapOfBoxes, SlowLosesNothing) { expect_nothing_lost<TypeParam>(40000); }

TYPED_TEST(OverlapOfBoxes, ARecordNamesEveryAxisAndChangesNoAnswer) {
  using S = TypeParam;
  for (const auto& comparison :
       {Comparison<S>::inclusive(), Comparison<S>::exclusive(), Comparison<S>::within(S(0.01))}) {
    for (const ObbTest<S> test :
         {ObbTest<S>{}, ObbTest<S>{ObbAxes::Faces, 0}, ObbTest<S>{ObbAxes::Fifteen, 0},
          ObbTest<S>{ObbAxes::Fifteen, S(1e-3)}}) {
      for_random_boxes<S>(2, 400, [&](const Obb<S>& a, const Obb<S>& b, int trial) {
        OverlapRecord<S> record;
        const bool answer = overlaps(a, b, comparison, test, &record);
        EXPECT_EQ(overlaps(a, b, comparison, test), answer);
        ASSERT_EQ(record.axes.size(), test.axes == ObbAxes::Faces ? 6u : 15u);
        const bool none = std::ranges::none_of(record.axes, &OverlapAxis<S>::separates);
        EXPECT_EQ(none, answer) << trial << " " << static_cast<int>(test.axes) << " "
                                << exact_gap(a, b);
        const double unit = std::numeric_limits<S>::epsilon() * test::size_of_pair(a, b);
        const test::QuadBox of_a(a, a.center), of_b(b, a.center);
        for (const OverlapAxis<S>& axis : record.axes) {
          if (axis.direction.isZero(0)) continue;
          // Unguarded tests round by more than that if the cross product is short.
          if (test.axes == ObbAxes::Fifteen && axis.length < S(0.1)) continue;
          const Vec3d& d = axis.direction.template cast<double>();
          EXPECT_NEAR(d.norm(), 1, 1e-5);
          EXPECT_NEAR(axis.gap, test::gap_along({d.x(), d.y(), d.z()}, of_a, of_b), 1000 * unit);
          EXPECT_NEAR(axis.gap,
                      std::max(axis.interval_b[0] - axis.interval_a[1],
                               axis.interval_a[0] - axis.interval_b[1]),
                      8 * unit);
        }
      });
    }
  }
}

TYPED_TEST(OverlapOfBoxes, WithinATolerance) {
  using S = TypeParam;
  Random random(3);
  for_random_boxes<S>(3, 2000, [&](const Obb<S>& a, const Obb<S>& b, int trial) {
    const double size = test::size_of_pair(a, b);
    const S tolerance = static_cast<S>(size * random.decade(-9, 0));
    const double gap = exact_gap(a, b);
    const double unit = std::numeric_limits<S>::epsilon() * (size + double(tolerance));
    const bool within = overlaps(a, b, Comparison<S>::within(tolerance));
    if (gap <= 0) {
      EXPECT_TRUE(within) << trial;
    }
    if (gap > double(tolerance) + 32 * unit) {
      EXPECT_FALSE(within) << trial;
    }
  });
  // Corner to corner along (1, 1, 1): distance sqrt(3), but no axis separates by more than 1.
  const Obb<S> a = box_at<S>({0, 0, 0}, {1, 1, 1}), b = box_at<S>({3, 3, 3}, {1, 1, 1});
  EXPECT_TRUE(overlaps(a, b, Comparison<S>::within(S(1.001))));
  EXPECT_FALSE(overlaps(a, b, Comparison<S>::within(S(0.999))));
}

TYPED_TEST(OverlapOfBoxes, CrossedEdgesSeparateOnlyAlongTheirCrossProduct) {
  using S = TypeParam;
  const Quatd edge_up(Eigen::AngleAxisd(0.7853981633974483, Vec3d::UnitX()));
  const Quatd across(Eigen::AngleAxisd(1.2, Vec3d::UnitY()));
  for (const double scale : {1e-4, 1.0, 1e4}) {
    const double reach = 2 * std::sqrt(2.0) * scale;
    const Vec3d half = Vec3d::Constant(scale);
    const auto meets = [&](double separation, ObbAxes axes) {
      return overlaps(box_at<S>({0, 0, 0}, half, edge_up),
                      box_at<S>({0, reach + separation * scale, 0}, half, across * edge_up),
                      Comparison<S>::inclusive(), ObbTest<S>{axes, 0});
    };
    EXPECT_TRUE(meets(-1e-3, ObbAxes::Guarded)) << scale;
    EXPECT_FALSE(meets(1e-3, ObbAxes::Guarded)) << scale;
    EXPECT_FALSE(meets(1e-3, ObbAxes::Fifteen)) << scale;
    EXPECT_TRUE(meets(1e-3, ObbAxes::Faces)) << scale;
  }
}

TYPED_TEST(OverlapOfBoxes, TouchingCountsOrDoesNot) {
  using S = TypeParam;
  const Obb<S> a = box_at<S>({0, 0, 0}, {1, 2, 3});
  for (const Vec3d& offset : {Vec3d(2, 0, 0), Vec3d(0, 4, 1), Vec3d(2, 4, 6)}) {
    EXPECT_TRUE(overlaps(a, box_at<S>(offset, {1, 2, 3}), Comparison<S>::inclusive()));
    EXPECT_FALSE(overlaps(a, box_at<S>(offset, {1, 2, 3}), Comparison<S>::exclusive()));
    EXPECT_TRUE(overlaps(a, box_at<S>(0.999 * offset, {1, 2, 3}), Comparison<S>::exclusive()));
    EXPECT_FALSE(overlaps(a, box_at<S>(1.001 * offset, {1, 2, 3}), Comparison<S>::inclusive()));
  }
}

TYPED_TEST(OverlapOfBoxes, FlatOnesAndPointsAreSets) {
  using S = TypeParam;
  const Obb<S> plate = box_at<S>({0, 0, 0}, {1, 1, 0}), point = box_at<S>({0.5, 0.5, 0}, {0, 0, 0});
  EXPECT_TRUE(overlaps(plate, point, Comparison<S>::inclusive()));
  EXPECT_FALSE(overlaps(plate, point, Comparison<S>::exclusive()));
  EXPECT_TRUE(overlaps(point, point, Comparison<S>::inclusive()));
  EXPECT_FALSE(overlaps(plate, box_at<S>({0.5, 0.5, 1e-3}, {0, 0, 0}), Comparison<S>::inclusive()));
  // Two needles in one plane that miss each other.
  const Quatd turn(Eigen::AngleAxisd(0.5, Vec3d::UnitZ()));
  const Obb<S> needle = box_at<S>({0, 0, 0}, {1, 0, 0});
  EXPECT_FALSE(
      overlaps(needle, box_at<S>({0, 0.6, 0}, {1, 0, 0}, turn), Comparison<S>::inclusive()));
  EXPECT_TRUE(
      overlaps(needle, box_at<S>({0, 0.3, 0}, {1, 0, 0}, turn), Comparison<S>::inclusive()));
}

TYPED_TEST(OverlapOfBoxes, EmptyOnesAndWhatIsNotANumberOverlapNothing) {
  using S = TypeParam;
  const S nan = std::numeric_limits<S>::quiet_NaN(), infinity = std::numeric_limits<S>::infinity();
  const Obb<S> good = box_at<S>({0, 0, 0}, {1, 1, 1});
  std::vector<Obb<S>> bad = {Obb<S>{}};
  for (const S number : {nan, infinity}) {
    for (int i = 0; i < 3; ++i) {
      bad.insert(bad.end(), 3, good);
      bad.end()[-3].center[i] = number;
      bad.end()[-2].half_extents[i] = number;
      bad.end()[-1].axes(i, (i + 1) % 3) = number;
    }
  }
  for (int i = 0; i < 3; ++i) {
    bad.push_back(good);
    bad.back().half_extents[i] = S(-0.5);
  }
  OverlapRecord<S> record;
  for (const ObbAxes axes : {ObbAxes::Faces, ObbAxes::Fifteen, ObbAxes::Guarded}) {
    for (const Obb<S>& box : bad) {
      for (const auto& comparison : {Comparison<S>::inclusive(), Comparison<S>::exclusive(),
                                     Comparison<S>::within(S(0.5))}) {
        EXPECT_FALSE(overlaps(box, good, comparison, ObbTest<S>{axes, 0}, &record)) << box.axes;
        EXPECT_THAT(record.axes, testing::IsEmpty());
        EXPECT_FALSE(overlaps(good, box, comparison, ObbTest<S>{axes, 0})) << box.axes;
      }
    }
    EXPECT_TRUE(overlaps(good, good, Comparison<S>::exclusive(), ObbTest<S>{axes, 0}));
  }
}

/// Wrong answers over pairs, a tenth of them parallel, by a test that skips up to `skip_up_to`.
struct Wrong {
  int missed = 0;  // overlap, but are reported as separated
  double deepest_miss = 0;
  int passed = 0;  // are separated, but reported as overlapping
};

Wrong wrong_answers(const ObbTest<float>& test, int pairs) {
  Random random(9);
  Wrong wrong;
  for (int i = 0; i < pairs; ++i) {
    const auto half = [&] {
      return Vec3d(random.uniform(0.1, 1), random.uniform(0.1, 1), random.uniform(0.1, 1));
    };
    const Quatd turn = random.rotation();
    const Obb<float> a = box_at<float>(Vec3d::Zero(), half(), turn);
    const Obb<float> b =
        box_at<float>(random.uniform(0, 2) * random.unit_vector(), half(),
                      i % 10 == 0 ? Quatd(turn * random.rotation_by(1e-7)) : random.rotation());
    const bool answer = overlaps(a, b, Comparison<float>::inclusive(), test);
    const double gap = exact_gap(a, b);
    const double unit = 1.2e-7 * test::size_of_pair(a, b);
    if (gap <= 0 && !answer) {
      ++wrong.missed;
      wrong.deepest_miss = std::max(wrong.deepest_miss, -gap);
    }
    wrong.passed += gap > 32 * unit && answer ? 1 : 0;
  }
  return wrong;
}

TEST(OverlapOfParallelBoxes, SlowAThresholdOfZeroMissesDeepOverlapsAndTheGuardNone) {
  constexpr int kPairs = 20000;
  const Wrong plain = wrong_answers({ObbAxes::Fifteen, 0}, kPairs);
  EXPECT_GT(plain.missed, kPairs / 1000);
  EXPECT_GT(plain.deepest_miss, 1e-3);
  const Wrong skipping = wrong_answers({ObbAxes::Fifteen, 1e-3F}, kPairs);
  EXPECT_EQ(skipping.missed, 0);
  const Wrong guarded = wrong_answers({}, kPairs);
  EXPECT_EQ(guarded.missed, 0);
  EXPECT_EQ(guarded.passed, 0);
  const Wrong faces = wrong_answers({ObbAxes::Faces, 0}, kPairs);
  EXPECT_EQ(faces.missed, 0);
  EXPECT_GT(faces.passed, kPairs / 100);
  RecordProperty("missed", plain.missed);
  RecordProperty("deepest_miss", std::to_string(plain.deepest_miss));
}

TEST(OverlapOfNearlyParallelBoxes, SkippingMissesASeparationAlongAShortCrossProduct) {
  // Two sticks of length 2, an edge down over an edge up, crossing at 0.01 rad, separated by 1 mm.
  const Quatd edge_up(Eigen::AngleAxisd(0.7853981633974483, Vec3d::UnitX()));
  const Quatd across(Eigen::AngleAxisd(0.01, Vec3d::UnitY()));
  const Vec3d half(1, 0.1, 0.1);
  const Obb<float> a = box_at<float>({0, 0, 0}, half, edge_up);
  const Obb<float> b = box_at<float>({0, 0.2 * std::sqrt(2.0) + 1e-3, 0}, half, across * edge_up);
  EXPECT_NEAR(exact_gap(a, b), 1e-3, 1e-6);
  EXPECT_TRUE(overlaps(a, b, Comparison<float>::inclusive(), {ObbAxes::Fifteen, 0.02F}));
  EXPECT_FALSE(overlaps(a, b, Comparison<float>::inclusive(), {ObbAxes::Fifteen, 0.005F}));
  EXPECT_FALSE(overlaps(a, b, Comparison<float>::inclusive()));
}

}  // namespace
}  // namespace contactscope
