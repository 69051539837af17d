#include <gtest/gtest.h>

#include "study/study.h"

namespace contactscope {
namespace {

TEST(BoxPathStudy, EveryPairTouchesAndBoxesAreFasterByTheirOwnPath) {
  StudyOptions options;
  options.cases = 40;
  const std::vector<trace::Study> studies =
      study_box_path(options, [](int, int, const std::string&) {});
  ASSERT_EQ(studies.size(), 1u);
  ASSERT_EQ(studies[0].series.size(), 2u);
  const trace::StudySeries &any = studies[0].series[0], &own = studies[0].series[1];
  ASSERT_EQ(any.points.size(), 5u);
  ASSERT_EQ(own.points.size(), 1u);
  EXPECT_EQ(own.points[0].parameter, any.points[0].parameter);
  for (const trace::StudySeries& line : studies[0].series)
    for (const trace::StudyPoint& point : line.points) EXPECT_EQ(point.failed, 0) << line.method;
  EXPECT_LT(*own.points[0].error, *any.points[0].error);
  EXPECT_LT(*any.points[0].error, *any.points[4].error) << "more vertices take longer";
}

}  // namespace
}  // namespace contactscope
