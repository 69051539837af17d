#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <random>
#include <sstream>

#include "lint/faults.h"
#include "lint/worlds.h"
#include "support/temporary_folder.h"
#include "trace/find.h"
#include "trace/read_trace.h"

/// Faults that the balance of impulses finds, at random places of recorded traces.
namespace contactscope::lint {
namespace {

Trace recording_by(void (*record)(const test::Recording&), test::Recording recording) {
  const TemporaryFolder folder;
  recording.path = folder / "run.jsonl";
  record(recording);
  std::ifstream in(recording.path);
  return trace::read_trace(in, recording.path);
}

const std::vector<Trace>& stack_of_each_engine() {
  static const std::vector<Trace> all = {
      recording_by(&test::record_in_bullet, {}),
      recording_by(&test::record_in_ode, {}),
#ifdef CONTACTSCOPE_HAS_MUJOCO
      recording_by(&test::record_in_mujoco, {}),
#endif
  };
  return all;
}

std::vector<std::string> causes_of(const std::vector<Finding>& findings) {
  std::vector<std::string> causes;
  for (const Finding& finding : findings) causes.push_back(finding.cause);
  return causes;
}

/// The pairs with several points in a frame.
std::vector<Target> pairs_of(const trace::Frame& frame) {
  std::vector<Target> all;
  for (const trace::Pair& pair : frame.pairs)
    if (!pair.manifolds.empty() && pair.manifolds[0].points.size() > 1)
      all.push_back({pair.a, pair.b, pair.b});
  return all;
}

/// Seeds a fault into random pairs of random stacks, from a random frame to the one before another.
/// At least 95 % are to be named first, each with its pair.
template <class Seed> void expect_found(const char* cause, bool once, const Seed& seed) {
  constexpr int kTrials = 40;
  std::mt19937 random(7);
  const auto below = [&](std::size_t count) { return random() % count; };
  int named = 0;
  std::ostringstream misses;
  for (int trial = 0; trial < kTrials; ++trial) {
    Trace trace = stack_of_each_engine()[below(stack_of_each_engine().size())];
    const std::size_t count = trace.frames.size();
    const std::size_t start = trial % 2 == 0 && !once ? 0 : 10 + below(count - 30);
    const std::vector<Target> pairs = pairs_of(trace.frames[start]);
    const Target target = pairs[below(pairs.size())];
    for (std::size_t f = start; f < (once ? start + 1 : count); ++f)
      for (std::size_t p = trace.frames[f].pairs.size(); p-- > 0;) {
        const trace::Pair& pair = trace.frames[f].pairs[p];
        if (pair.a == target.a && pair.b == target.b) seed(trace.frames[f], p, random);
      }
    const std::vector<Finding> findings = lint(trace);
    if (!findings.empty() && findings[0].cause == cause &&
        std::minmax(findings[0].a, findings[0].b) == std::minmax(target.a, target.b))
      ++named;
    else
      misses << trace.header.engine << ", frame " << start << ", " << target.a << "-" << target.b
             << ": " << testing::PrintToString(causes_of(findings)) << "\n";
  }
  EXPECT_GE(named, 0.95 * kTrials) << misses.str();
}

TEST(LintBalance, ARestingPairThatIsNotReportedFromSomeFrameOnIsNamed) {
  expect_found("pair_never_reported", false, [](trace::Frame& frame, std::size_t pair, auto&) {
    frame.pairs.erase(frame.pairs.begin() + static_cast<std::ptrdiff_t>(pair));
  });
}

/// The links of a chain overlap and push each other, and a joint does that, not a contact.
TEST(LintBalance, JointsOfChainsAreNoMissingContacts) {
  for (const int unrecorded : {0, 60, 200}) {
    const Trace chains = recording_by(
        &test::record_in_bullet,
        {.world = test::World::Chains, .bodies = 30, .unrecorded = unrecorded, .frames = 120});
    EXPECT_THAT(causes_of(lint(chains)), testing::Not(testing::Contains(testing::AnyOf(
                                             "pair_never_reported", "overlap_without_contact"))))
        << unrecorded;
  }
}

TEST(LintBalance, APairThatIsLostOnceIsNamed) {
  expect_found("pairs_flicker", true, [](trace::Frame& frame, std::size_t pair, auto&) {
    frame.pairs.erase(frame.pairs.begin() + static_cast<std::ptrdiff_t>(pair));
  });
}

TEST(LintBalance, PointsThatAreLostOnceAreNamed) {
  expect_found("points_flicker", true,
               [](trace::Frame& frame, std::size_t pair, std::mt19937& random) {
                 auto& points = frame.pairs[pair].manifolds[0].points;
                 const std::size_t kept = 1 + random() % (points.size() - 1);
                 std::shuffle(points.begin(), points.end(), random);
                 points.resize(kept);
               });
}

/// Where normals or separations jump all the time, a point that is lost once is their effect.
TEST(LintBalance, JumpsExplainALostPointOfTheirPair) {
  for (const Trace& stack : stack_of_each_engine())
    for (const char* const name : {"separations are 100 mm less", "normals turn by 90 degrees"}) {
      const Target target = targets(stack, 1).at(0);
      Trace trace = stack;
      const auto fault = std::ranges::find(faults(), std::string(name), &Fault::name);
      seed(trace, *fault, target, Often::Always);
      for (trace::Pair& pair : trace.frames[21].pairs)
        if (pair.a == target.a && pair.b == target.b) pair.manifolds[0].points.resize(1);
      const std::vector<Finding> findings = lint(trace);
      ASSERT_FALSE(findings.empty()) << name;
      EXPECT_EQ(findings[0].cause, fault->causes[0]) << name << ", " << trace.header.engine;
      EXPECT_THAT(causes_of(findings), testing::Not(testing::Contains("points_flicker")));
    }
}

TEST(LintBalance, EachFrameWithoutAContactIsMarked) {
  Trace trace = stack_of_each_engine()[0];
  const Target target = targets(trace, 1).at(0);
  for (std::size_t f = 5; f < 25; ++f)
    std::erase_if(trace.frames[f].pairs, [&](const trace::Pair& pair) {
      return pair.a == target.a && pair.b == target.b;
    });
  for (const Finding& finding : lint(trace)) {
    if (finding.cause != "overlap_without_contact" && finding.cause != "pair_never_reported")
      continue;
    EXPECT_EQ(finding.marks.size(), static_cast<std::size_t>(finding.count)) << finding.cause;
    EXPECT_GT(finding.count, 5);
  }
}

}  // namespace
}  // namespace contactscope::lint
