#include <gtest/gtest.h>

#include <cmath>

#include "query/gjk.h"
#include "study/study.h"

namespace contactscope {
namespace {

std::vector<trace::Study> small_distance_study() {
  StudyOptions options;
  options.cases = 4;
  options.repetitions = 1;
  return study_distance(options, [](int, int, const std::string&) {});
}

TEST(DistanceStudy, VClipAndGjkFindTheDistanceOfAllPairsInFarFewerSteps) {
  const std::vector<trace::Study> studies = small_distance_study();
  ASSERT_EQ(studies.size(), 2u);
  ASSERT_EQ(studies[0].series.size(), 3u);
  for (const trace::StudySeries& line : studies[0].series)
    for (const trace::StudyPoint& point : line.points) EXPECT_EQ(point.failed, 0) << line.method;
  const auto last = [&](std::size_t line) { return *studies[0].series[line].points.back().error; };
  // Euler: up to 252 triangles and 378 edges; a few of them are merged.
  EXPECT_LE(last(0), std::pow(128 + 252 + 378, 2));
  EXPECT_GT(last(0), 500000);
  EXPECT_LT(last(1), 100);
  EXPECT_LT(last(2), 30);
}

TEST(DistanceStudy, OneInFiftyNeverEndsWithoutTolerancesAndWithThemEachEndsWithinTwentySteps) {
  const trace::Study gains = small_distance_study()[1];
  ASSERT_EQ(gains.series.size(), 4u);
  const std::vector<trace::StudyPoint>&with = gains.series[0].points,
        &without = gains.series[1].points;
  EXPECT_LE(with.size(), 20u);
  EXPECT_EQ(with.back().failed, 0);
  EXPECT_EQ(without.size(), static_cast<std::size_t>(kMaxGjkIterations));
  EXPECT_GE(without.back().failed, 20);
  EXPECT_EQ(without.back().of, 1000);
}

}  // namespace
}  // namespace contactscope
