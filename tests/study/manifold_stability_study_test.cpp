#include "study/manifold_stability_study.h"

#include <gtest/gtest.h>

#include <span>

#include "study/study.h"

namespace contactscope {
namespace {

constexpr LandingMethod kEvery[] = {LandingMethod::OneShot, LandingMethod::ByDistance,
                                    LandingMethod::ByIds};

TEST(ManifoldStabilityStudy, ALevelDropIsStableAtOnceInOneShotAndElseInFourFramesOrMore) {
  const LandingCase drop{Landing::Drop, 0.02, Vec3d(0.4, 0.3, 0.5), 0.3};
  EXPECT_EQ(land(drop, LandingMethod::OneShot, 90).frames_to_stable, 1);
  EXPECT_GE(land(drop, LandingMethod::ByDistance, 90).frames_to_stable, 4);
  EXPECT_GE(land(drop, LandingMethod::ByIds, 90).frames_to_stable, 4);
}

TEST(ManifoldStabilityStudy, TheFirstPointTurnsABoxThatOneShotLeavesLevel) {
  const LandingCase drop{Landing::Drop, 0.1, Vec3d(0.4, 0.3, 0.5), 0.3};
  EXPECT_LT(land(drop, LandingMethod::OneShot, 90).rotation, 0.02);
  EXPECT_GT(land(drop, LandingMethod::ByDistance, 90).rotation, 0.1);
}

TEST(ManifoldStabilityStudy, EveryMethodComesToRestOnTheFloor) {
  for (const LandingMethod method : kEvery) {
    const LandingCase drop{Landing::Drop, 0.01, Vec3d(0.4, 0.3, 0.5), 0.3};
    const LandingOutcome outcome = land(drop, method, 240);
    EXPECT_NEAR(outcome.poses.back().position.y(), 0.3, 0.01);
  }
}

TEST(ManifoldStabilityStudy, HasThreeMeasuresOfThreeMethodsInThreePanels) {
  StudyOptions options;
  options.cases = 1;
  options.repetitions = 1;
  int last = 0, of = -1;
  const auto studies =
      study_manifold_stability(options, [&](int done, int total, const std::string&) {
        last = done;
        of = total;
      });
  EXPECT_EQ(last, of);
  ASSERT_EQ(studies.size(), 4U);
  const std::vector<trace::StudySeries>& queries = studies[3].series;
  ASSERT_EQ(queries.size(), 5U);
  for (std::size_t p = 0; p < queries[0].points.size(); ++p)
    for (std::size_t deep = 1; deep < queries.size(); ++deep)
      EXPECT_NEAR(*queries[0].points[p].error + *queries[deep].points[p].error, 1, 1e-12)
          << "either GJK suffices, or the depth is needed";
  // From 10 m it falls by 23 cm a frame, past both margins; from 10 cm by 2 cm, half of them.
  EXPECT_GT(*queries[1].points.back().error, 0.2);
  EXPECT_LT(*queries[1].points.front().error, 0.1);
  for (const trace::Study& study : std::span(studies).first(3)) {
    ASSERT_EQ(study.series.size(), 9U) << study.measure;
    for (const trace::StudySeries& series : study.series) {
      EXPECT_EQ(series.points.size(), 7U) << series.method;
      for (const trace::StudyPoint& point : series.points)
        EXPECT_GT(point.nanoseconds.median, 0) << series.method;
    }
  }
}

}  // namespace
}  // namespace contactscope
