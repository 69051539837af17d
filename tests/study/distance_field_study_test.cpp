#include <gmock/gmock.h>

#include <algorithm>

#include "study/study.h"
#include "study_lines.h"

namespace contactscope {
namespace {

using test::line_of;

TEST(DistanceFieldStudy, SlowOrdersTheMethodsAsTheyAre) {
  StudyOptions options;
  options.cases = 20;
  options.repetitions = 1;
  const auto results = study_distance_field(options, [](int, int, const std::string&) {});
  ASSERT_EQ(results.size(), 6U);

  // A finer lattice is more accurate, and larger.
  const auto& coarse_to_fine = line_of(results[0], "by cells", "cubic").points;
  ASSERT_EQ(coarse_to_fine.size(), 4U);
  EXPECT_LT(*coarse_to_fine.back().error, 0.2 * *coarse_to_fine.front().error);
  EXPECT_LT(*coarse_to_fine.back().error, 1e-3);
  EXPECT_LT(*line_of(results[1], "by cells", "cubic").points.back().error, 5);
  const auto& memory = line_of(results[2], "by cells", "cubic").points;
  EXPECT_GT(*memory.back().error, 4 * *memory.front().error);

  // Dense sample points find deep overlaps, but not shallow ones between them.
  EXPECT_EQ(*line_of(results[4], "1 cell deep", "sampled").points.front().error, 0);
  EXPECT_GT(*line_of(results[4], "0.01 cells deep", "sampled").points.back().error, 0.3);
  for (const trace::StudySeries& series : results[4].series)
    for (const trace::StudyPoint& point : series.points)
      EXPECT_TRUE(series.method != "conservative" || *point.error == 0)
          << series.panel << ' ' << point.parameter;

  // On plates thinner than a cell, blending loses some places, and triangles lose none.
  for (const char* method : {"cubic with exact cells", "cubic with exact cells where needed"})
    for (const trace::StudyPoint& point :
         line_of(results[5], "a plate beside a wall", method).points)
      EXPECT_EQ(*point.error, 0) << method << ' ' << point.parameter;
  const auto& blended = line_of(results[5], "a plate beside a wall", "trilinear").points;
  EXPECT_GT(*blended.front().error, 0.5);
  EXPECT_EQ(*blended.back().error, 0);
}

}  // namespace
}  // namespace contactscope
