#include <gtest/gtest.h>

#include <cstdio>
#include <map>
#include <string>

#include "geometry/hull_builder.h"
#include "query/penetration.h"
#include "query/penetration_bounds.h"
#include "support/brute_force_sat.h"
#include "support/builders.h"

/// Depth and normal of every method compared with all axes by brute force, over pairs of all kinds
/// that are hard for some method: ten thousand that overlap in double, half as many in float, and
/// the pairs drawn between them that touch or are separated.
namespace contactscope {
namespace {

using test::PairCase;
using test::Random;

/// B in the middle of A.
PairCase<double> concentric(PairCase<double> pair) {
  pair.pose_b.position =
      pair.pose_a.transform(pair.a.centroid) - pair.pose_b.rotate(pair.b.centroid);
  return pair;
}

/// Boxes in one grid: faces, edges and vertices coincide, and many just touch.
PairCase<double> boxes_in_a_grid(Random& random) {
  const auto step = [&](int count) { return 0.25 * random.index(count); };
  return {test::cube(0.5), Pose<double>(), make_box(Vec3d(0.25 + step(4), 0.25 + step(2), 0.5)),
          test::at(step(5), step(5), step(5))};
}

/// A tetrahedron and a copy moved by quarters of an edge: coplanar, collinear, coincident features.
PairCase<double> coplanar_simplices(Random& random) {
  const Vec3d points[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const Hull<double> simplex = build_hull(points);
  const auto step = [&] { return 0.25 * (random.index(9) - 4); };
  PairCase<double> pair{simplex, Pose<double>(), simplex, test::at(step(), step(), step())};
  if (random.chance(0.5)) pair.pose_b.rotation = test::about(Vec3d(1, 1, 1), 120 * test::kDegree);
  return pair;
}

/// A needle a thousand times as long as thin, through or on an equally thin plate, level or turned.
PairCase<double> needle_and_plate(Random& random) {
  const double thin = random.decade(-4, -2);
  PairCase<double> pair{make_box(Vec3d(1, 1, thin)), Pose<double>(), make_box(Vec3d(1, thin, thin)),
                        Pose<double>()};
  if (random.chance(0.7)) pair.pose_b.rotation = random.rotation();
  pair.pose_b.position = random.uniform(0, 0.9) * random.unit_vector();
  if (random.chance(0.5)) pair.pose_b.position.z() = thin * random.uniform(-2, 2);
  return test::moved(pair, random.pose(2));
}

PairCase<double> hard_pair(Random& random, int index) {
  switch (index % 10) {
    case 0:
      return test::random_pair(random);
    case 1:
      return test::everyday_pair(random);
    case 2:
      return concentric(test::everyday_pair(random));
    case 3:
    case 4:
      return coplanar_simplices(random);
    case 5:
    case 6:
      return needle_and_plate(random);
    default:
      return boxes_in_a_grid(random);
  }
}

struct Tally {
  std::map<std::string, int> statuses;
  double most_over = 0;   // ulps of the scale by which a depth is too large
  double most_under = 0;  // or too small

  void print(const char* method, const char* scalar) const {
    std::printf("%-8s %-6s", method, scalar);
    for (const auto& [status, count] : statuses) {
      std::printf(" %s=%d", status.c_str(), count);
      testing::Test::RecordProperty(std::string(method) + "_" + status, count);
    }
    std::printf("; depth up to %.3g ulps more and %.3g less than the true one\n", most_over,
                most_under);
  }
};

template <class S> class PenetrationPairs : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(PenetrationPairs, Scalars);

TYPED_TEST(PenetrationPairs, SlowTenThousandOverlapsAgreeWithExhaustion) {
  using S = TypeParam;
  constexpr int kOverlaps = sizeof(S) == sizeof(double) ? 10000 : 5000;
  constexpr PenetrationMethod kMethods[] = {PenetrationMethod::Sat, PenetrationMethod::Epa,
                                            PenetrationMethod::Mpr, PenetrationMethod::Sampling};
  Random random(4096);
  Tally tallies[4];
  int overlapping = 0, touching = 0, concluded = 0;
  for (int i = 0; overlapping < kOverlaps; ++i) {
    ASSERT_LT(i, 3 * kOverlaps);
    const PairCase<S> pair = hard_pair(random, i).template cast<S>();
    const Pose<S> b_in_a = relative_pose(pair.pose_a, pair.pose_b);
    const SupportSet<S> a = support_set(pair.a), b = support_set(pair.b);
    const PairCase<double> exact = pair.template cast<double>();
    const Pose<double> exact_b_in_a = b_in_a.template cast<double>();
    const double truth =
        test::brute_force_sat(exact.a, Pose<double>(), exact.b, exact_b_in_a).separation;
    const auto scale = static_cast<double>(reach_of(a) + reach_of(b) + b_in_a.position.norm());
    const double ulp = scale * static_cast<double>(std::numeric_limits<S>::epsilon());
    const bool is_deep = truth<-32 * ulp, is_separated = truth> 64 * ulp;
    overlapping += is_deep ? 1 : 0;
    touching += !is_deep && !is_separated ? 1 : 0;
    if (is_separated && i % 20 >= 10) continue;  // keeps their number near that of the overlaps

    for (const PenetrationMethod method : kMethods) {
      // As slow as all others together.
      if (method == PenetrationMethod::Sampling && i / 10 % 4 != 0) continue;
      SCOPED_TRACE(std::string(to_string(method)) + " of pair " + std::to_string(i));
      Tally& tally = tallies[static_cast<int>(method)];
      PenetrationOptions<S> options;
      options.samples = 64;
      const PenetrationResult<S> found = penetration(method, a, b, b_in_a, options);
      const std::string status = to_string(found.status);
      ++tally.statuses[is_deep ? status : is_separated ? status + "_apart" : status + "_touching"];
      ASSERT_NE(found.status, PenetrationStatus::NotFinite);
      ASSERT_TRUE(!is_deep || has_depth(found.status)) << truth / ulp << " ulps";
      if (is_separated && method != PenetrationMethod::Sampling &&
          method != PenetrationMethod::Mpr) {
        ASSERT_EQ(found.status, PenetrationStatus::Separated) << truth / ulp << " ulps";
      }
      if (is_separated && found.status == PenetrationStatus::Separated) ++concluded;
      if (!has_depth(found.status) || is_separated) continue;

      const auto depth = static_cast<double>(found.depth);
      const double over = (depth + std::min(truth, 0.0)) / ulp;
      tally.most_over = std::max(tally.most_over, over);
      tally.most_under = std::max(tally.most_under, -over);
      // With any method, the depth separates the shapes and is never less than the least one.
      ASSERT_NEAR(found.normal.norm(), 1, 8 * std::numeric_limits<S>::epsilon());
      ASSERT_GE(over, -8);
      const double along = test::separation_along(found.normal.template cast<double>(), exact.a,
                                                  Pose<double>(), exact.b, exact_b_in_a);
      ASSERT_NEAR(along, -depth, (is_deep ? 16 : 64) * ulp);
      ASSERT_LE(static_cast<double>(found.least_depth), std::max(-truth, 0.0) + 16 * ulp);
      const Vec3<S> between = found.on_a - found.on_b;
      if (found.status == PenetrationStatus::Converged) {
        ASSERT_NEAR(static_cast<double>(between.dot(found.normal)), depth, 64 * ulp);
      }

      const bool is_exact =
          method == PenetrationMethod::Sat ||
          (method == PenetrationMethod::Epa && found.status == PenetrationStatus::Converged);
      ASSERT_TRUE(!is_exact || over <= 16) << over << " ulps, " << status;
      if (method == PenetrationMethod::Sampling) {
        ASSERT_LE(found.iterations, options.samples + 6 * kMaxSamplingRounds);
        const double spacing = scale * sampling_angle<double>(64);
        ASSERT_LE(over * ulp, spacing);
        ASSERT_GE(static_cast<double>(found.least_depth), -truth - 2 * spacing);
      }
    }
  }
  const char* scalar = sizeof(S) == 4 ? "float" : "double";
  for (const PenetrationMethod method : kMethods) {
    tallies[static_cast<int>(method)].print(to_string(method), scalar);
  }
  EXPECT_GT(touching, kOverlaps / 20);
  EXPECT_GT(concluded, kOverlaps / 4);
  // The search about the best direction zigzags along some ridges until its limit.
  EXPECT_GT(tallies[static_cast<int>(PenetrationMethod::Sampling)].statuses["out_of_iterations"],
            0);
  // EPA may stall in one of a thousand overlapping pairs.
  const Tally& epa = tallies[static_cast<int>(PenetrationMethod::Epa)];
  EXPECT_GT(epa.statuses.at("converged"), overlapping * 999 / 1000);
}

}  // namespace
}  // namespace contactscope
