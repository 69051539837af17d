#include "study/broad_phase_study.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace contactscope {
namespace {

using ::testing::Each;
using ::testing::SizeIs;

constexpr int kBoxes[] = {30, 200};
constexpr StudyOptions kTwoSteps{.seed = 3, .cases = 2, .repetitions = {}, .frames = {}};

void report_nothing(int, int, const std::string&) {}

TEST(BroadPhaseStudy, NoBroadPhaseMissesAPair) {
  const auto results = study_pair_finders(own_pair_finders(), kBoxes, kTwoSteps, report_nothing);
  ASSERT_THAT(results, SizeIs(4));
  for (const trace::Study& study : results) {
    EXPECT_THAT(study.series, SizeIs(5 * broad_phases().size()));
    for (const trace::StudySeries& series : study.series) {
      ASSERT_THAT(series.points, SizeIs(2)) << series.method;
      EXPECT_THAT(series.points, Each(testing::Field(&trace::StudyPoint::failed, 0)))
          << series.method;
      EXPECT_THAT(series.points, Each(testing::Field(&trace::StudyPoint::of, 2))) << series.method;
    }
  }
}

/// Omits the last pair.
class Forgetful : public PairFinder {
 public:
  void place(std::span<const Aabb<float>> boxes, std::span<const int> moved) override {
    for (const int i : moved)
      i < phase_->handles() ? phase_->move(i, boxes[static_cast<std::size_t>(i)])
                            : void(phase_->add(boxes[static_cast<std::size_t>(i)]));
  }
  void find(std::vector<BoxPair>& found) override {
    found = phase_->pairs();
    found.pop_back();
  }

 private:
  std::unique_ptr<BroadPhase> phase_ = make_broad_phase("tree");
};

TEST(BroadPhaseStudy, AMissedPairIsAFailure) {
  const std::vector<PairFinderInfo> forgetful = {
      {"forgetful", 1000, 1000, [] { return std::make_unique<Forgetful>(); }}};
  for (const trace::Study& study : study_pair_finders(forgetful, kBoxes, kTwoSteps, report_nothing))
    for (const trace::StudySeries& series : study.series)
      EXPECT_THAT(series.points, Each(testing::Field(&trace::StudyPoint::failed, 2)))
          << series.panel;
}

TEST(BroadPhaseStudy, BruteForceComparesEveryTwoBoxesOnce) {
  const auto results = study_pair_finders(own_pair_finders(), kBoxes, kTwoSteps, report_nothing);
  int seen = 0;
  for (const trace::StudySeries& series : results[3].series) {
    if (series.method != "brute_force") continue;
    ++seen;
    for (const trace::StudyPoint& point : series.points)
      EXPECT_DOUBLE_EQ(point.error.value(), (point.parameter - 1) / 2) << series.panel;
  }
  EXPECT_EQ(seen, 5);
}

TEST(BroadPhaseStudy, BeyondWhatAFinderIsForItHasNoPoint) {
  std::vector<PairFinderInfo> finders = own_pair_finders();
  finders[0].most_boxes = 100;
  const auto results = study_pair_finders(finders, kBoxes, kTwoSteps, report_nothing);
  EXPECT_THAT(results[0].series[0].points, SizeIs(1));
  EXPECT_THAT(results[0].series[1].points, SizeIs(2));
}

}  // namespace
}  // namespace contactscope
