#include "snapshot/finding.h"

#include <gmock/gmock.h>

#include <functional>

#include "snapshot/check.h"
#include "snapshot/compare_trace.h"
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
  finding.pixels->differing = differing;
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

TEST(Findings, ACauseIsListedOnceWithItsScenarios) {
  const Outcome outcome = three_scenarios();
  const std::vector<Cause> all = causes(outcome);
  ASSERT_THAT(all, SizeIs(3));
  EXPECT_THAT(all[0].scenarios, ElementsAre("b/b", "c/c"));
  EXPECT_EQ(all[0].findings[0]->scenario, "c/c") << "the largest difference first";
}

/// Number of causes of `count` scenarios with equal changes.
std::size_t causes_of(int count, const std::string& cause) {
  Outcome outcome{"snapshots"};
  for (int i = 0; i < count; ++i) {
    const std::string name = "a/s" + std::to_string(i);
    outcome.scenarios.push_back({name, name + ".toml"});
    outcome.scenarios.back().findings = {picture(name, cause, 10 + i), picture(name, cause, 20)};
  }
  return causes(outcome).size();
}

TEST(Findings, AFewEditedScenariosAreACauseEach) {
  const std::string edited = std::string(kInputCause) + "1, pose ";
  EXPECT_EQ(causes_of(1, edited), 1u);
  EXPECT_EQ(causes_of(5, edited), 5u);
  EXPECT_EQ(causes_of(6, edited), 1u) << "nobody edits so many at once: the program reads them";
  EXPECT_EQ(causes_of(2, "trace: 7, chosen "), 1u) << "one edit of the program";
}

TEST(Findings, OrphanedSnapshotsAreCountedNextToTheScenarios) {
  Outcome outcome = three_scenarios();
  outcome.scenarios.push_back({"e/e"});
  outcome.scenarios[4].findings = {{FindingKind::Orphaned, "e/e", "", {}, "e/e/trace.jsonl"}};
  EXPECT_THAT(summary(tally(outcome)),
              HasSubstr("4 scenarios: 1 the same, 3 fail, 1 more stored without a file ("));
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
  const TraceDifferences record = compare_with_stored(to_json_lines(stored), "file", now);
  EXPECT_THAT(record.cause, HasSubstr("crate-floor: sat face_a: separation"));
  EXPECT_THAT(record.cause, HasSubstr("so 1 point and 1 of 4 ids changed"));
}

TEST(FirstCause, ADecisionHasBothOfItsNumbers) {
  trace::Trace stored = sample_trace();
  trace::Sat& before = *sample_pair(stored).sat;
  before.face_a->separation = -0.02001;
  before.face_b = before.face_a;
  before.face_b->separation = -0.01998;
  before.chosen = "face_a";
  trace::Trace now = stored;
  sample_pair(now).sat->chosen = "face_b";
  const TraceDifferences record = compare_with_stored(to_json_lines(stored), "file", now);
  EXPECT_THAT(
      record.cause,
      HasSubstr("frame 12, crate-floor: the separating axis test now prefers face b: -19.980 mm "
                "against -20.010 mm of face a, a tie of 0.03 mm"));
  EXPECT_THAT(record.cause, Not(HasSubstr("to spare"))) << "no margin is known";
}

/// The cause if only `change` differs in the pair of frame 0, and the current margin is `decision`.
std::string record_of(const std::function<void(trace::Pair&)>& change,
                      const trace::Decision& decision) {
  trace::Trace now = sample_trace();
  change(now.frames[0].pairs[0]);
  const Margins margins = {{{0, "crate-floor"}, {decision}}};
  return compare_with_stored(to_json_lines(sample_trace()), "file", now, margins).cause;
}

TEST(FirstCause, EveryChoiceHasItsMargin) {
  EXPECT_THAT(
      record_of([](trace::Pair& pair) { pair.clip->incident.face = 5; },
                {"incident_face", "face 5", "face 3", {}, {}, 1e-6}),
      HasSubstr("crate-floor: the incident face is now face 5 instead of face 3, with 1e-06 of "
                "a cosine to spare"));
  EXPECT_THAT(record_of(
                  [](trace::Pair& pair) {
                    pair.reduction->kept = {0, 2, 1};
                  },
                  {"points", "points 0 1 2", "points 0 1 3", {}, 2e-6, {}}),
              HasSubstr("the reduction now keeps points 0 2 1 instead of 0 2 1 3, with 2 mm^2 to "
                        "spare"));
  EXPECT_THAT(record_of([](trace::Pair& pair) { pair.sat->face_b->face = 4; },
                        {"face_b", "face 4", "face 2", 3e-6, {}, {}}),
              HasSubstr("the best face b is now face 4 instead of face 2, with 3 um to spare"));
  EXPECT_THAT(record_of([](trace::Pair& pair) { pair.state = "separated"; },
                        {"contact", "separated", "touching", 2e-8, {}, {}}),
              HasSubstr("the shapes are now separated instead of touching, with 20 nm to spare"));
}

TEST(FirstCause, APreferenceHasItsRemainder) {
  const std::string record = record_of(
      [](trace::Pair& pair) {
        pair.sat->face_a->separation = -0.006;
        pair.sat->chosen = "face_a";
      },
      {"axis", "face_a", "edge_edge", 4e-6, {}, {}});
  EXPECT_THAT(record, HasSubstr("1 mm between them, with 4 um to spare over an edge pair"));
}

TEST(FirstCause, AMotionIsReportedWithTheChoiceItFlipped) {
  trace::Trace now = sample_trace();
  for (trace::Frame& frame : now.frames) frame.poses[0].second.position.y() += 3e-5;
  now.frames[1].pairs[0].clip->incident.face = 5;
  now.frames[1].pairs[0].clip->steps[0].offset += 1;
  const TraceDifferences record = compare_with_stored(to_json_lines(sample_trace()), "file", now);
  EXPECT_THAT(record.cause,
              HasSubstr("frame 0, crate: moved 30 um along y; so for crate-floor in frame "
                        "12 the incident face is now face 5 instead of face 3; with it 1 "
                        "clip step changed"));
}

TEST(FirstCause, InputPosesAreDistinguishedFromSolverMotion) {
  trace::Trace stored = sample_trace();
  for (trace::Frame& frame : stored.frames) frame.solver.reset();
  const auto is_input = [&](std::size_t frame) {
    trace::Trace now = stored;
    now.frames[frame].poses[0].second.position.y() += 3e-5;
    return compare_with_stored(to_json_lines(stored), "file", now).is_input;
  };
  EXPECT_TRUE(is_input(0));
  EXPECT_TRUE(is_input(1)) << "scripted";
  trace::Body body;
  body.name = stored.frames[1].poses[0].first;
  for (trace::Frame& frame : stored.frames) frame.solver.emplace().bodies = {body};
  EXPECT_TRUE(is_input(0)) << "where it begins";
  EXPECT_FALSE(is_input(1));

  trace::Trace point = sample_trace();
  sample_pair(point).manifolds[0].points[0].position.x() += 0.1;
  EXPECT_FALSE(compare_with_stored(to_json_lines(sample_trace()), "file", point).is_input);
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
  const TraceDifferences record = compare_with_stored(to_json_lines(sample_trace()), "file", title);
  EXPECT_NE(record.signature, signature(0.1, 0));
  EXPECT_TRUE(record.is_words);
  EXPECT_FALSE(record.is_setup);
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
