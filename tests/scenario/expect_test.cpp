#include "scenario/run.h"

#include <limits>

#include <gmock/gmock.h>

#include "scenario/broken.h"

namespace contactscope {
namespace {

using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Frames 0 to 9 of crate and floor, with one [[expect]] on line 10 about frames 2 to 5.
Scenario expecting(const std::string& keys) {
  return parse_scenario(two_boxes("[time]\nframes = 10\n[[expect]]\na = \"crate\"\nb = \"floor\"\n"
                                  "frames = [2, 5]\n" +
                                  keys),
                        "hull/a.toml");
}

/// Frame 3: crate touches floor with three points, deepest at -0.005, along the first face axis.
trace::Frame touching() {
  trace::Frame frame;
  frame.frame = 3;
  trace::Pair pair{"crate", "floor", "", "hull-hull", "touching", -0.005, {}, {}, {}, {}};
  trace::Manifold manifold{{0, -1, 0}, "face_a", {}, {}};
  manifold.type = "face-face";
  manifold.points = {{{0, 0, 0}, -0.005, ""}, {{1, 0, 0}, -0.001, ""}, {{0, 0, 1}, 0, ""}};
  pair.manifolds.push_back(manifold);
  frame.pairs.push_back(pair);
  return frame;
}

/// Frame 3: crate and floor separated by 0.25 along an edge axis.
trace::Frame separated() {
  trace::Frame frame;
  frame.frame = 3;
  trace::Pair pair{"crate", "floor", "", "hull-hull", "separated", 0.25, {}, {}, {}, {}};
  pair.sat.emplace();
  pair.sat->face_a = trace::FaceAxis{0, 0.125, {0, -1, 0}, {0, 0, 0}};
  pair.sat->edge = trace::EdgeAxis{0, 1, 0.25, {0.6, -0.8, 0}, {0, 0, 0}, {0, 0, 0}};
  pair.sat->chosen = "edge_edge";
  frame.pairs.push_back(pair);
  return frame;
}

TEST(Expect, FramesThatFailAlikeAreFoldedByWhatIsExpected) {
  Scenario scenario = expecting("points = 4\nseparation = -0.1");
  scenario.expectations[0].first_frame = 0;
  scenario.expectations[0].last_frame = 9;
  std::vector<trace::Frame> frames(3, touching());
  for (int i = 0; i < 3; ++i) frames[static_cast<std::size_t>(i)].frame = i;
  frames[1].pairs[0].separation = -0.10000002384185791;  // within the tolerance
  EXPECT_THAT(unmet_expectations(scenario, frames),
              ElementsAre("hull/a.toml:10: frames 0 to 2, crate-floor: expected 4 points, got 3",
                          "hull/a.toml:10: 2 frames from 0 to 2, crate-floor: expected separation "
                          "-0.1 m, got -0.005 m (tolerance 1e-05)"));
  frames[2].pairs[0].manifolds[0].points.resize(1);
  EXPECT_THAT(unmet_expectations(scenario, frames)[0],
              EndsWith("expected 4 points, got 3; other frames differ"));
}

TEST(Expect, ComputedNumbersHaveSixDigitsUnlessThatHidesTheDifference) {
  trace::Frame frame = touching();
  frame.pairs[0].separation = -0.10000002384185791;
  EXPECT_THAT(unmet_expectations(expecting("separation = -0.2"), {frame})[0],
              HasSubstr("got -0.1 m (tolerance"));
  EXPECT_THAT(unmet_expectations(expecting("separation = -0.1\ntolerance = 0"), {frame})[0],
              HasSubstr("got -0.10000002384185791 m"));
}

TEST(Expect, MetExpectationsAreSilent) {
  EXPECT_THAT(unmet_expectations(expecting("state = \"touching\"\npoints = 3\naxis = \"face_a\"\n"
                                           "type = \"face-face\"\n"
                                           "normal = [0, -1, 0]\nseparation = -0.005"),
                                 {touching()}),
              IsEmpty());
  EXPECT_THAT(unmet_expectations(expecting("state = \"separated\"\npoints = 0\n"
                                           "axis = \"edge_edge\"\nnormal = [0.6, -0.8, 0]\n"
                                           "separation = 0.25"),
                                 {separated()}),
              IsEmpty());
}

TEST(Expect, AnotherContactTypeOrNoneFails) {
  EXPECT_THAT(
      unmet_expectations(expecting("type = \"point-face\""), {touching()}),
      ElementsAre("hull/a.toml:10: frame 3, crate-floor: expected type point-face, got face-face"));
  EXPECT_THAT(
      unmet_expectations(expecting("type = \"point-face\""), {separated()}),
      ElementsAre("hull/a.toml:10: frame 3, crate-floor: expected type point-face, got none"));
}

TEST(Expect, EachKeyIsASentenceWithItsPlace) {
  EXPECT_THAT(
      unmet_expectations(expecting("state = \"separated\""), {touching()}),
      ElementsAre("hull/a.toml:10: frame 3, crate-floor: expected separated, got touching with "
                  "separation -0.005 m"));
  EXPECT_THAT(unmet_expectations(expecting("points = 4"), {touching()}),
              ElementsAre("hull/a.toml:10: frame 3, crate-floor: expected 4 points, got 3"));
  EXPECT_THAT(unmet_expectations(expecting("points = 1"), {separated()}),
              ElementsAre("hull/a.toml:10: frame 3, crate-floor: expected 1 point, got 0"));
  EXPECT_THAT(
      unmet_expectations(expecting("axis = \"face_b\""), {touching()}),
      ElementsAre("hull/a.toml:10: frame 3, crate-floor: expected axis face_b, got face_a"));
  EXPECT_THAT(
      unmet_expectations(expecting("normal = [0, 1, 0]"), {touching()}),
      ElementsAre("hull/a.toml:10: frame 3, crate-floor: expected normal [0, 1, 0], got [0, -1, 0] "
                  "(tolerance 1e-05)"));
  EXPECT_THAT(
      unmet_expectations(expecting("separation = -0.004\ntolerance = 1e-4"), {touching()}),
      ElementsAre(
          "hull/a.toml:10: frame 3, crate-floor: expected separation -0.004 m, got -0.005 m "
          "(tolerance 1e-04)"));
  EXPECT_EQ(unmet_expectations(expecting("state = \"separated\"\npoints = 0\naxis = \"face_b\"\n"
                                         "normal = [0, 1, 0]\nseparation = 0.1"),
                               {touching()})
                .size(),
            5u);
}

TEST(Expect, ToleranceIsForEachComponentOfTheNormal) {
  trace::Frame frame = touching();
  frame.pairs[0].manifolds[0].normal = {9e-6, -1, -9e-6};  // the vectors differ by more than 1e-5
  EXPECT_THAT(unmet_expectations(expecting("normal = [0, -1, 0]"), {frame}), IsEmpty());
  frame.pairs[0].manifolds[0].normal = {0, -1, 1.1e-5};
  EXPECT_EQ(unmet_expectations(expecting("normal = [0, -1, 0]"), {frame}).size(), 1u);
}

TEST(Expect, SeparationWithinTheToleranceHolds) {
  EXPECT_THAT(unmet_expectations(expecting("separation = -0.00501"), {touching()}), IsEmpty());
  EXPECT_EQ(unmet_expectations(expecting("separation = -0.005011"), {touching()}).size(), 1u);
  EXPECT_THAT(unmet_expectations(expecting("separation = -0.005\ntolerance = 0"), {touching()}),
              IsEmpty());
}

TEST(Expect, NotANumberNeverHolds) {
  trace::Frame frame = touching();
  frame.pairs[0].separation = std::numeric_limits<double>::quiet_NaN();
  frame.pairs[0].manifolds[0].normal.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(unmet_expectations(
                expecting("separation = -0.005\nnormal = [0, -1, 0]\ntolerance = 1e9"), {frame})
                .size(),
            2u);
}

TEST(Expect, OnlyFramesOfTheRangeAreJudged) {
  const Scenario scenario = expecting("points = 4");
  for (const int number : {0, 1, 2, 5, 6, 9}) {
    trace::Frame frame = touching();
    frame.frame = number;
    const bool judged = number >= 2 && number <= 5;
    EXPECT_EQ(unmet_expectations(scenario, {frame}).size(), judged ? 1u : 0u) << number;
  }
}

TEST(Expect, PointsAreCountedOverAllManifolds) {
  trace::Frame frame = touching();
  frame.pairs[0].manifolds.push_back(frame.pairs[0].manifolds[0]);
  EXPECT_THAT(unmet_expectations(expecting("points = 6"), {frame}), IsEmpty());
}

TEST(Expect, EveryManifoldMustHaveTheNormal) {
  trace::Frame frame = touching();
  frame.pairs[0].manifolds.push_back(frame.pairs[0].manifolds[0]);
  frame.pairs[0].manifolds[1].normal = {1, 0, 0};
  EXPECT_EQ(unmet_expectations(expecting("normal = [0, -1, 0]"), {frame}).size(), 1u);
}

TEST(Expect, ASeparatedPairWithoutRecordHasNoAxis) {
  trace::Frame frame = separated();
  frame.pairs[0].sat.reset();
  EXPECT_THAT(unmet_expectations(expecting("axis = \"edge_edge\"\nnormal = [1, 0, 0]"), {frame}),
              ElementsAre("hull/a.toml:10: frame 3, crate-floor: expected axis edge_edge, got none",
                          "hull/a.toml:10: frame 3, crate-floor: expected normal [1, 0, 0], got "
                          "none"));
}

TEST(Expect, AMissingPairIsNotMet) {
  trace::Frame frame = touching();
  frame.pairs.clear();
  EXPECT_THAT(unmet_expectations(expecting("points = 3"), {frame}),
              ElementsAre("hull/a.toml:10: frame 3, crate-floor: the frame has no such pair"));
}

TEST(Expect, TheLabelChoosesAmongEntriesOfOnePair) {
  const Scenario scenario = parse_scenario(
      two_boxes("[[pairs]]\na = \"crate\"\nb = \"floor\"\nlabel = \"off\"\n"
                "[[pairs]]\na = \"crate\"\nb = \"floor\"\nlabel = \"on\"\n"
                "[[expect]]\na = \"crate\"\nb = \"floor\"\nlabel = \"on\"\npoints = 3\n"),
      "hull/a.toml");
  trace::Frame frame = touching();
  frame.frame = 0;
  frame.pairs.push_back(frame.pairs[0]);
  frame.pairs[0].label = "off";
  frame.pairs[1].label = "on";
  frame.pairs[0].manifolds.clear();
  EXPECT_THAT(unmet_expectations(scenario, {frame}), IsEmpty());
  std::swap(frame.pairs[0].manifolds, frame.pairs[1].manifolds);
  EXPECT_THAT(unmet_expectations(scenario, {frame}),
              ElementsAre("hull/a.toml:16: frame 0, crate-floor (on): expected 3 points, got 0"));
}

}  // namespace
}  // namespace contactscope
