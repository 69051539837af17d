#include <gmock/gmock.h>

#include <algorithm>
#include <stdexcept>

#include "study/study.h"

namespace contactscope {
namespace {

const trace::StudySeries& line_of(const trace::Study& study, const std::string& method,
                                  const std::string& panel) {
  for (const trace::StudySeries& series : study.series)
    if (series.method == method && series.panel.starts_with(panel)) return series;
  throw std::out_of_range(method + ", " + panel);
}

TEST(DistanceFieldStudy, SlowOrdersTheMethodsAsTheyAre) {
  StudyOptions options;
  options.cases = 20;
  options.repetitions = 1;
  const auto results = study_distance_field(options, [](int, int, const std::string&) {});
  ASSERT_EQ(results.size(), 6U);

  // A finer lattice is nearer to the truth, and larger.
  const auto& coarse_to_fine = line_of(results[0], "cubic", "by cells").points;
  ASSERT_EQ(coarse_to_fine.size(), 4U);
  EXPECT_LT(*coarse_to_fine.back().error, 0.2 * *coarse_to_fine.front().error);
  EXPECT_LT(*coarse_to_fine.back().error, 1e-3);
  EXPECT_LT(*line_of(results[1], "cubic", "by cells").points.back().error, 5);
  const auto& memory = line_of(results[2], "cubic", "by cells").points;
  EXPECT_GT(*memory.back().error, 8 * *memory.front().error);

  // Deep overlaps are found by points that are near each other; shallow ones between them are not.
  EXPECT_EQ(*line_of(results[4], "sampled", "1 cell").points.front().error, 0);
  EXPECT_GT(*line_of(results[4], "sampled", "0.01 cells").points.back().error, 0.3);
  for (const trace::StudySeries& series : results[4].series)
    for (const trace::StudyPoint& point : series.points)
      EXPECT_TRUE(series.method != "conservative" || *point.error == 0)
          << series.panel << ' ' << point.parameter;

  // Of plates thinner than a cell blending loses some, and triangles none.
  for (const trace::StudyPoint& point : line_of(results[5], "cubic, exact cells", "a plate").points)
    EXPECT_EQ(*point.error, 0) << point.parameter;
  const auto& blended = line_of(results[5], "trilinear", "a plate").points;
  EXPECT_GT(*blended.front().error, 0.5);
  EXPECT_EQ(*blended.back().error, 0);
}

}  // namespace
}  // namespace contactscope
