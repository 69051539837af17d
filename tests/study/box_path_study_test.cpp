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
  ASSERT_EQ(own.points.size(), 6u);
  ASSERT_EQ(any.points.size(), own.points.size());
  for (std::size_t i = 0; i < own.points.size(); ++i) {
    EXPECT_EQ(own.points[i].parameter, any.points[i].parameter);
    EXPECT_EQ(own.points[i].failed + any.points[i].failed, 0);
    EXPECT_LT(*own.points[i].error, *any.points[i].error);
  }
}

}  // namespace
}  // namespace contactscope
