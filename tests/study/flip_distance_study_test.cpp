#include <gmock/gmock.h>

#include "scenario/scenario.h"
#include "study/study.h"

namespace contactscope {
namespace {

// A ball that sinks from 1 to 3 mm into a slab, a millimetre a frame.
constexpr const char* kSinkingBall = R"(title = "A ball sinks in"
[time]
frames = 3
dt = 1
[shapes.slab]
type = "box"
half_extents = [1, 0.5, 1]
position = [0, -0.5, 0]
[shapes.ball]
type = "sphere"
radius = 0.5
position = [0, 0.499, 0]
[shapes.ball.motion]
velocity = [0, -0.001, 0]
[pipeline]
scalar = "double"
)";

TEST(FlipDistanceStudy, MeasuresTheFlipDistanceOfEachFrame) {
  const std::vector<Scenario> scenarios = {parse_scenario(kSinkingBall, "mine/ball.toml")};
  StudyOptions options;
  options.scenarios = &scenarios;
  options.cases = 8;
  int record = 0;
  const std::vector<trace::Study> studies =
      study_flip_distance(options, [&](int, int, const std::string&) { ++record; });
  EXPECT_EQ(record, 3);
  ASSERT_EQ(studies.size(), 3u);
  EXPECT_EQ(studies[0].measure, "way");
  ASSERT_EQ(studies[0].series.size(), 1u);
  const trace::StudySeries& distance = studies[0].series[0];
  EXPECT_EQ(distance.method, "slab-ball");
  EXPECT_EQ(distance.panel, "mine/ball");
  ASSERT_EQ(distance.points.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(distance.points[i].error.value_or(0), 0.001 * static_cast<double>(i + 1), 1e-6);
  // A ball's contact is the same after any rotation.
  EXPECT_EQ(studies[1].series[0].points[0].failed, 1);
}

TEST(FlipDistanceStudy, UsesTheNamedFrames) {
  const std::vector<Scenario> scenarios = {parse_scenario(kSinkingBall, "mine/ball.toml")};
  StudyOptions options;
  options.scenarios = &scenarios;
  options.only_frames = {2};
  const auto studies = study_flip_distance(options, [](int, int, const std::string&) {});
  ASSERT_EQ(studies[0].series.size(), 1u);
  ASSERT_EQ(studies[0].series[0].points.size(), 1u);
  EXPECT_EQ(studies[0].series[0].points[0].parameter, 2);
}

}  // namespace
}  // namespace contactscope
