#include "study/random_cases.h"

#include <gmock/gmock.h>

#include "study/study.h"
#include "support/brute_force_sat.h"

namespace contactscope {
namespace {

using testing::ElementsAre;

void ignore_progress(int /*done*/, int /*total*/, const std::string& /*what*/) {}

StudyOptions small() {
  StudyOptions options;
  options.cases = 3;
  options.repetitions = 1;
  return options;
}

TEST(DepthOracle, AgreesWithBruteForceOverAllAxes) {
  std::mt19937_64 engine(3);
  for (int trial = 0; trial < 40; ++trial) {
    const OverlappingHulls pair = overlapping_hulls(engine, trial % 2 == 0 ? 8 : 16);
    const double brute =
        test::brute_force_sat(pair.a, Pose<double>{}, pair.b, pair.b_in_a).separation;
    EXPECT_NEAR(pair.deepest.separation, brute, 1e-12 * pair.size) << trial;
  }
}

TEST(DepthOracle, AlongItsOwnAxisIsTheSeparationAndAlongOthersLess) {
  std::mt19937_64 engine(6);
  for (int trial = 0; trial < 40; ++trial) {
    const OverlappingHulls pair = overlapping_hulls(engine, 12);
    const SeparationOracle oracle(Shape<double>(pair.a), Pose<double>(), Shape<double>(pair.b),
                                  pair.b_in_a);
    EXPECT_NEAR(oracle.separation_along(pair.deepest.normal, -1), pair.deepest.separation,
                1e-12 * pair.size);
    EXPECT_LE(oracle.separation_along(pair.offset, -1),
              pair.deepest.separation + 1e-12 * pair.size);
  }
}

TEST(OverlappingHulls, HaveTheirVerticesOverlapAndSize) {
  std::mt19937_64 engine(5);
  for (int trial = 0; trial < 40; ++trial) {
    const OverlappingHulls pair = overlapping_hulls(engine, 16);
    EXPECT_EQ(pair.a.vertex_count(), 16);
    EXPECT_EQ(pair.b.vertex_count(), 16);
    EXPECT_LE(pair.a.radius, 2 * pair.size);
    EXPECT_LT(pair.deepest.separation, -0.9e-3 * pair.size);
    EXPECT_GT(pair.deepest.separation, -0.11 * pair.size);
  }
}

TEST(HullPrecisionStudy, DoubleIsFarCloserThanFloatAndNothingFails) {
  const std::vector<trace::Study> studies = study_hull_precision(small(), ignore_progress);
  ASSERT_EQ(studies.size(), 3u);
  ASSERT_EQ(studies[0].series.size(), 9u);
  EXPECT_EQ(studies[2].measure, "axes");
  for (std::size_t line = 0; line < 9; ++line)
    for (std::size_t p = 0; p < 4; ++p)
      EXPECT_EQ(studies[1].series[line].points[p].error,
                studies[0].series[line].points[p].nanoseconds.min / 1000);
  for (const trace::StudySeries& series : studies[0].series) {
    std::vector<double> parameters;
    for (const trace::StudyPoint& point : series.points) {
      parameters.push_back(point.parameter);
      EXPECT_EQ(point.failed, 0) << series.method;
      EXPECT_EQ(point.of, 3) << series.method;
      ASSERT_TRUE(point.error_worst) << series.method;
      const bool is_float = series.method.starts_with("float");
      EXPECT_LT(*point.error_worst, is_float ? 1e-5 : 1e-13) << series.method;
      EXPECT_GT(*point.error_worst, is_float ? 1e-10 : -1) << series.method;
      EXPECT_GT(point.nanoseconds.min, 0) << series.method;
    }
    EXPECT_THAT(parameters, ElementsAre(8, 16, 32, 64)) << series.method;
  }
}

}  // namespace
}  // namespace contactscope
