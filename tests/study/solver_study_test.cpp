#include <gmock/gmock.h>

#include <cmath>
#include <set>

#include "study/solver_stack.h"
#include "study/study.h"

namespace contactscope {
namespace {

constexpr PositionCorrection kCorrections[] = {
    PositionCorrection::Baumgarte, PositionCorrection::Projection, PositionCorrection::Soft};

StackPlan seeded_plan(int count, double ratio) {
  std::mt19937_64 engine(7);
  return stack_plan(engine, count, ratio);
}

SolverSettings stack_settings(PositionCorrection correction, int iterations, int substeps = 1) {
  SolverSettings settings;
  settings.position_correction = correction;
  settings.iterations = iterations;
  settings.substeps = substeps;
  return settings;
}

TEST(StackPlan, IsHeavyOnTopWithSmallOffsets) {
  const StackPlan plan = seeded_plan(6, 1000);
  ASSERT_EQ(plan.boxes.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(plan.boxes[i].mass, i == 5 ? 1000 : 1);
    EXPECT_LE(std::abs(plan.boxes[i].x), 0.02);
    EXPECT_LE(std::abs(plan.boxes[i].z), 0.02);
    EXPECT_NE(plan.boxes[i].x, plan.boxes[(i + 1) % 6].x);
  }
}

TEST(SolverStack, TwoBoxesComeToRestAndCarryTheirWeight) {
  for (const PositionCorrection correction : kCorrections) {
    const StackOutcome outcome = run_stack(seeded_plan(2, 1), stack_settings(correction, 8, 4));
    EXPECT_EQ(outcome.fault, StackFault::None) << to_string(correction);
    EXPECT_EQ(outcome.frames, kStackFrames);
    EXPECT_LT(outcome.load_error, 1e-3) << to_string(correction);
    EXPECT_LT(outcome.jitter, 1e-3) << to_string(correction);
    EXPECT_LT(outcome.drift, 2e-3) << to_string(correction);
    EXPECT_LT(outcome.penetration, 2e-3) << to_string(correction);
    EXPECT_LE(outcome.penetration, outcome.worst_penetration);
    EXPECT_EQ(outcome.ids_changed, 0) << to_string(correction);
    EXPECT_GT(outcome.nanoseconds, 0);
  }
}

// A single box 60 cm to the side of the one below has to fall with any solver.
TEST(SolverStack, AnUnsupportedBoxHasFallen) {
  StackPlan plan = seeded_plan(2, 1);
  plan.boxes[1].x = plan.boxes[0].x + 0.6;
  const StackOutcome outcome = run_stack(plan, stack_settings(PositionCorrection::Baumgarte, 8, 4));
  EXPECT_EQ(outcome.fault, StackFault::Fallen);
  EXPECT_LT(outcome.frames, 60);
}

// Two sweeps that start from zero in every frame: a thousand times the mass sinks through.
TEST(SolverStack, AHeavyBoxSinksIntoLightOnesWhereNoImpulseIsKept) {
  SolverSettings settings = stack_settings(PositionCorrection::Baumgarte, 2);
  settings.warm_start = false;
  EXPECT_NE(run_stack(seeded_plan(3, 1000), settings).fault, StackFault::None);
}

TEST(SolverStack, EnergyGainIsFound) {
  // Four times each overlap per step: boxes are thrown instead of pushed.
  SolverSettings settings = stack_settings(PositionCorrection::Baumgarte, 1);
  settings.baumgarte = 4;
  const StackOutcome outcome = run_stack(seeded_plan(6, 1), settings);
  EXPECT_EQ(outcome.fault, StackFault::Energy);
}

TEST(SolverStack, SteppedTwiceItIsTheSameToTheLastBit) {
  for (const PositionCorrection correction : kCorrections) {
    for (const bool warm : {false, true}) {
      SolverSettings settings = stack_settings(correction, 3, 2);
      settings.warm_start = warm;
      const StackOutcome one = run_stack(seeded_plan(5, 3), settings, 40);
      const StackOutcome other = run_stack(seeded_plan(5, 3), settings, 40);
      EXPECT_EQ(one.fault, other.fault);
      EXPECT_EQ(one.frames, other.frames);
      EXPECT_EQ(one.penetration, other.penetration);
      EXPECT_EQ(one.worst_penetration, other.worst_penetration);
      EXPECT_EQ(one.drift, other.drift);
      EXPECT_EQ(one.jitter, other.jitter);
      EXPECT_EQ(one.load_error, other.load_error);
      EXPECT_GT(one.worst_penetration, 0);
    }
  }
}

const std::vector<trace::Study>& short_study() {
  static const std::vector<trace::Study> studies = [] {
    StudyOptions options;
    options.cases = 1;
    options.frames = 4;
    int last = 0;
    return study_solver(options, [&](int done, int of, const std::string&) {
      EXPECT_EQ(done, last + 1);
      EXPECT_LE(done, of);
      last = done;
    });
  }();
  return studies;
}

// A box on one point of each contact swings about it; on two it turns about their line.
TEST(SolverStudy, AStackFallsOnOnePointRocksOnTwoAndStandsOnFour) {
  std::mt19937_64 engine(3);
  const StackPlan plan = stack_plan(engine, 6, 1);
  SolverSettings settings;
  settings.position_correction = PositionCorrection::Soft;
  settings.iterations = 2;
  settings.substeps = 4;
  EXPECT_EQ(run_stack(plan, settings, kStackFrames, 1).fault, StackFault::Fallen);
  const StackOutcome four = run_stack(plan, settings, kStackFrames, 4);
  EXPECT_EQ(four.fault, StackFault::None);
  EXPECT_GT(run_stack(plan, settings, kStackFrames, 2).jitter, 10 * four.jitter);
}

TEST(SolverStudy, HasCurvesInTwoPanelsAndMaps) {
  std::vector<std::string> measures;
  for (const trace::Study& study : short_study()) {
    measures.push_back(study.measure);
    EXPECT_EQ(study.study, "solver");
    if (study.measure == "energy" || study.measure == "max_points") continue;
    const bool is_map = study.measure.find("map") != std::string::npos;
    EXPECT_EQ(study.form, is_map ? trace::StudyForm::Map : trace::StudyForm::WorkPrecision);
    std::set<std::string> panels;
    for (const trace::StudySeries& series : study.series) panels.insert(series.panel);
    EXPECT_EQ(panels.size(), is_map ? 6u : 2u) << study.measure;
    EXPECT_TRUE(trace::has_panels(study));
  }
  EXPECT_THAT(measures,
              testing::ElementsAre("penetration", "worst", "drift", "jitter", "load", "ids",
                                   "penetration_heavy", "drift_heavy", "jitter_heavy",
                                   "penetration_two", "drift_two", "jitter_two",
                                   "penetration_twenty", "drift_twenty", "jitter_twenty",
                                   "max_points", "map", "drift_map", "jitter_map", "energy"));
}

TEST(SolverStudy, NoStackIsLostFromTheCount) {
  for (const trace::Study& study : short_study()) {
    if (study.measure == "energy") continue;
    int failed = 0, all = 0;
    for (const trace::StudySeries& series : study.series) {
      double before = 0;
      for (const trace::StudyPoint& point : series.points) {
        EXPECT_GT(point.parameter, before);
        before = point.parameter;
        EXPECT_EQ(point.of, 1);
        EXPECT_EQ(point.error.has_value(), point.failed == 0);
        EXPECT_GT(point.nanoseconds.min, 0);
        failed += point.failed;
        all += point.of;
      }
    }
    EXPECT_THAT(study.reference, testing::HasSubstr(std::to_string(all) + " stacks"));
    EXPECT_LT(failed, all);
  }
}

}  // namespace
}  // namespace contactscope
