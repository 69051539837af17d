#include <gmock/gmock.h>

#include "study/random_cases.h"
#include "study/study.h"
#include "support/brute_force_sat.h"

namespace contactscope {
namespace {

const trace::StudySeries& series_named(const trace::Study& study, const std::string& method) {
  for (const trace::StudySeries& series : study.series) {
    if (series.method == method) return series;
  }
  throw std::runtime_error("no series " + method);
}

TEST(OracleAxis, ItsNormalIsTheOneThatBruteForceFinds) {
  std::mt19937_64 engine(6);
  for (int trial = 0; trial < 30; ++trial) {
    const OverlappingHulls pair = overlapping_hulls(engine, 10);
    const OracleAxis axis = oracle_axis(pair.a, pair.b, pair.b_in_a);
    EXPECT_NEAR(axis.separation, pair.deepest.separation, 1e-15 * pair.size);
    const double along =
        test::separation_along(axis.normal, pair.a, Pose<double>(), pair.b, pair.b_in_a);
    EXPECT_NEAR(along, axis.separation, 1e-12 * pair.size) << trial;
  }
}

TEST(PenetrationStudy, MoreEffortIsNeverWorseAndEpaIsAsExactAsTheSeparatingAxisTest) {
  StudyOptions options;
  options.cases = 12;
  options.repetitions = 1;
  const std::vector<trace::Study> studies =
      study_penetration(options, [](int, int, const auto&) {});
  ASSERT_EQ(studies.size(), 3u);
  for (const trace::Study& study : studies) {
    ASSERT_EQ(study.series.size(), 11u);
    for (const trace::StudySeries& series : study.series) {
      ASSERT_EQ(series.points.size(), 6u) << series.method;
      for (std::size_t k = 0; k < 6; ++k) {
        const trace::StudyPoint& point = series.points[k];
        EXPECT_EQ(point.parameter, static_cast<double>(k + 1)) << series.method;
        EXPECT_LE(*point.error_worst, study.measure == "unfinished" ? 1 : 4) << series.method;
        EXPECT_EQ(point.failed, 0) << series.method << " " << point.parameter;
        EXPECT_EQ(point.of, 12);
        EXPECT_GT(point.nanoseconds.min, 0);
      }
    }
  }
  const trace::Study& depths = studies[0];
  EXPECT_LT(*series_named(depths, "double, SAT").points[0].error_worst, 1e-13);
  EXPECT_LT(*series_named(depths, "float, SAT").points[0].error_worst, 1e-5);
  const auto& by_tolerance = series_named(depths, "double, EPA by tolerance").points;
  EXPECT_LT(*by_tolerance.back().error_worst, 1e-13);
  EXPECT_GE(*by_tolerance.front().error_worst, *by_tolerance.back().error_worst);
  // Iteration limits end the search: the lower the limit, the larger the error of the upper bound.
  const auto& by_iterations = series_named(depths, "double, EPA by iterations").points;
  for (std::size_t k = 1; k < by_iterations.size(); ++k) {
    EXPECT_LE(*by_iterations[k].error, *by_iterations[k - 1].error + 1e-12);
  }
  EXPECT_LT(*by_iterations.back().error_worst, 1e-13);
  // Only a search with an iteration limit is ended by it.
  EXPECT_EQ(series_named(studies[2], "double, EPA by tolerance").points.back().error, 0);
  EXPECT_GT(*series_named(studies[2], "double, EPA by iterations").points.front().error, 0.9);
  // MPR's normal is not the one of least depth, however exact it is.
  EXPECT_GT(*series_named(depths, "double, MPR by tolerance").points.back().error_worst, 1e-4);
  const auto& sampled = series_named(depths, "double, sampling, one round").points;
  EXPECT_LT(*sampled.back().error, *sampled.front().error);
}

}  // namespace
}  // namespace contactscope
