#include "snapshot/finding.h"

#include <gmock/gmock.h>

#include "snapshot/compare_trace.h"
#include "snapshot/frame_hashes.h"
#include "snapshot/sample_trace.h"
#include "snapshot/store.h"

namespace contactscope::snapshot {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;

Finding picture(const std::string& scenario, const std::string& cause, int differing) {
  Finding finding{FindingKind::Changed, scenario, "", 0, scenario + "/frame_0000.png"};
  finding.cause = cause;
  finding.pixels = PixelMeasures{};
  finding.pixels->found.differing = differing;
  return finding;
}

Outcome three_scenarios() {
  Outcome outcome{"snapshots"};
  outcome.scenarios = {{"a/a", "a.toml"}, {"b/b", "b.toml"}, {"c/c", "c.toml"}, {"d/d", "d.toml"}};
  outcome.scenarios[0].findings = {picture("a/a", "alone", 9000)};
  outcome.scenarios[1].findings = {picture("b/b", "drawing", 10)};
  outcome.scenarios[2].findings = {
      picture("c/c", "drawing", 500),
      {FindingKind::UnmetExpectation, "c/c", "", {}, "", "unmet", {}, "expectations of c/c"}};
  return outcome;
}

TEST(Findings, OneCauseIsToldOnceWithItsScenarios) {
  const Outcome outcome = three_scenarios();
  const std::vector<Cause> all = causes(outcome);
  ASSERT_THAT(all, SizeIs(3));
  EXPECT_THAT(all[0].scenarios, ElementsAre("b/b", "c/c"));
  EXPECT_EQ(all[0].findings[0]->scenario, "c/c") << "the largest difference first";
}

TEST(Findings, TheSummaryCountsEachKind) {
  Outcome outcome = three_scenarios();
  EXPECT_EQ(summary(tally(outcome)),
            "4 scenarios: 1 the same, 3 fail (3 changed, 0 new, 0 missing, 0 orphaned, 1 unmet "
            "expectation, 0 unreadable, 0 known bad)");
  outcome.scenarios[0].findings[0].review = Review::Rejected;
  EXPECT_THAT(summary(tally(outcome)), HasSubstr(", 1 rejected"));
  outcome.scenarios.resize(1);
  outcome.scenarios[0].findings.clear();
  EXPECT_EQ(summary(tally(outcome)), "1 scenario: all the same");
}

TEST(FirstCause, IsWhatThePipelineDecidesFirst) {
  const trace::Trace stored = sample_trace();
  trace::Trace now = stored;
  trace::Pair& pair = sample_pair(now);
  pair.manifolds[0].points[0].position.x() += 0.1;
  pair.manifolds[0].points[1].id = "a:e9 b:e9";
  ASSERT_TRUE(pair.sat.has_value());
  pair.sat->face_a->separation += 0.01;
  const TraceDifferences told = compare_with_stored(to_json_lines(stored), "file", now);
  EXPECT_THAT(told.cause, HasSubstr("crate-floor: sat face_a: separation"));
  EXPECT_THAT(told.cause, HasSubstr("so 1 point and 1 of 4 ids changed"));
}

TEST(FirstCause, ADecisionIsToldWithBothOfItsNumbers) {
  trace::Trace stored = sample_trace();
  trace::Sat& before = *sample_pair(stored).sat;
  before.face_a->separation = -0.02001;
  before.face_b = before.face_a;
  before.face_b->separation = -0.01998;
  before.chosen = "face_a";
  trace::Trace now = stored;
  sample_pair(now).sat->chosen = "face_b";
  const TraceDifferences told = compare_with_stored(to_json_lines(stored), "file", now);
  EXPECT_THAT(told.cause,
              HasSubstr("the separating axis test now takes face b instead of face a: separation "
                        "-19.980 mm against -20.010 mm, 30 um between them"));
}

TEST(FirstCause, ItsSignatureHasNoNumbersOrNames) {
  const auto signature = [](double move, std::size_t point) {
    trace::Trace now = sample_trace();
    sample_pair(now).manifolds[0].points[point].position.x() += move;
    return compare_with_stored(to_json_lines(sample_trace()), "file", now).signature;
  };
  EXPECT_EQ(signature(0.1, 0), signature(0.3, 1));
  trace::Trace title = sample_trace();
  title.header.title = "Another one";
  const TraceDifferences told = compare_with_stored(to_json_lines(sample_trace()), "file", title);
  EXPECT_NE(told.signature, signature(0.1, 0));
  EXPECT_TRUE(told.is_words);
  EXPECT_FALSE(told.is_setup);
}

TEST(FrameHashes, EveryFactCounts) {
  trace::Trace trace = sample_trace();
  trace::Frame& frame = trace.frames.back();
  const std::string before = hash_of(frame);
  EXPECT_EQ(hash_of(frame), before);
  EXPECT_THAT(before, SizeIs(16));
  double& separation = frame.pairs[0].manifolds[0].points[0].separation;
  separation = std::nextafter(separation, 1);
  const std::string moved = hash_of(frame);
  EXPECT_NE(moved, before);
  frame.pairs[0].manifolds[0].points[0].id += "x";
  EXPECT_NE(hash_of(frame), moved);
}

TEST(FrameHashes, TheSignOfZeroDoesNot) {
  trace::Trace trace = sample_trace();
  double& coordinate = trace.frames[0].poses[0].second.position.x();
  coordinate = 0.0;
  const std::string before = hash_of(trace.frames[0]);
  coordinate = -0.0;
  EXPECT_EQ(hash_of(trace.frames[0]), before);
}

TEST(FrameHashes, TheirFileReadsBack) {
  const FrameHashes hashes{rounding(), {{0, "0123456789abcdef"}, {12, "fedcba9876543210"}}};
  EXPECT_EQ(parse_hashes(to_text(hashes), "frames.txt"), hashes);
  EXPECT_THROW(parse_hashes("0 0123", "frames.txt"), std::runtime_error);
  EXPECT_THROW(parse_hashes("rounding 1\nx y\n", "frames.txt"), std::runtime_error);
}

}  // namespace
}  // namespace contactscope::snapshot
