#include <gtest/gtest.h>

#include "study/study.h"

namespace contactscope {
namespace {

TEST(BoundingTreesStudy, NoVolumeMissesAnIntersectionAndCloserOnesCompareLess) {
  StudyOptions options;
  options.repetitions = 1;
  const std::vector<trace::Study> studies =
      study_bounding_trees(options, [](int, int, const std::string&) {});
  ASSERT_EQ(studies.size(), 1u);
  const std::vector<trace::StudySeries>& tests = studies[0].series;
  ASSERT_EQ(tests.size(), 3u);
  for (const trace::StudySeries& line : tests) {
    ASSERT_EQ(line.points.size(), 5u);
    for (std::size_t i = 0; i < 5; ++i) {
      EXPECT_EQ(line.points[i].failed, 0) << line.method;
      if (i > 0) {
        EXPECT_LT(*line.points[i].error, *line.points[i - 1].error) << line.method;
      }
    }
  }
  // Where the surfaces are near each other, flat oriented boxes are separated first.
  EXPECT_LT(*tests[1].points[1].error, *tests[2].points[1].error);
  EXPECT_LT(*tests[2].points[1].error, *tests[0].points[1].error);
}

}  // namespace
}  // namespace contactscope
