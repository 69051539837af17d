#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>

#include "study/limits_study.h"
#include "study/measurement.h"
#include "study/solver_stack.h"

namespace contactscope {
namespace {

constexpr int kCounts[] = {1, 2, 4, 8, 16, 32, 64};  // iterations, or sub-steps
constexpr int kHeights[] = {20, 14, 9, 6, 4, 3, 2};  // boxes; the tallest is the upper row of a map
constexpr int kRatioSteps = 13;                      // two a decade, from 1 to 10^6
constexpr int kMapCases = 2;                         // stacks a cell

struct SolverMethod {
  const char* name;
  PositionCorrection correction;
  bool warm_start;
  const char* map_name;
  int map_iterations, map_substeps;
};

// The maps give every method sixteen sweeps a frame: projection and soft contacts spend half of
// theirs on positions.
constexpr SolverMethod kSolverMethods[] = {
    {"baumgarte, warm", PositionCorrection::Baumgarte, true, "baumgarte, warm: 16 sweeps", 16, 1},
    {"projection, warm", PositionCorrection::Projection, true, "projection, warm: 8 + 8", 8, 1},
    {"soft, warm", PositionCorrection::Soft, true, "soft, warm: 4 × (2 + 2)", 2, 4},
    // In this order each has a colour in the plots that is near its warm brother's.
    {"soft, cold", PositionCorrection::Soft, false, "soft, cold: 4 × (2 + 2)", 2, 4},
    {"projection, cold", PositionCorrection::Projection, false, "projection, cold: 8 + 8", 8, 1},
    {"baumgarte, cold", PositionCorrection::Baumgarte, false, "baumgarte, cold: 16 sweeps", 16, 1},
};

struct CurveStack {
  const char* suffix;  // of the measure's name
  const char* title;   // follows the measure's
  int boxes;
  double ratio;
  int cases;  // stacks a point
};
constexpr CurveStack kCurveStacks[] = {
    {"", ": ten equal boxes", 10, 1, 4},
    {"_heavy", ": two boxes under a hundred times their mass", 3, 100, 4},
    {"_two", ": two equal boxes", 2, 1, 4},
    {"_twenty", ": twenty equal boxes", 20, 1, 2},
};

struct CurvePanel {
  const char* name;
  const char* parameter;
  bool substeps;
};
constexpr CurvePanel kCurvePanels[] = {
    {"More iterations, no sub-steps", "iterations", false},
    {"More sub-steps, an iteration each", "sub-steps", true},
};

/// One number of an outcome, and how it is called.
struct StackMeasure {
  const char* name;
  const char* title;
  const char* error;
  const char* unit;
  double StackOutcome::*value;
  bool of_all_stacks;  // else of the first alone
};
constexpr StackMeasure kStackMeasures[] = {
    {"penetration", "How far boxes sink into each other", "deepest overlap after 3 s", "m",
     &StackOutcome::penetration, true},
    {"worst", "How deep boxes have been in each other", "deepest overlap of any frame", "m",
     &StackOutcome::worst_penetration, false},
    {"drift", "How far the top of a stack drifts", "way of the highest box after 3 s", "m",
     &StackOutcome::drift, true},
    {"jitter", "How still a stack stands", "speed of the fastest box, third second", "m/s",
     &StackOutcome::jitter, true},
    {"load", "How well contacts carry what is above them",
     "force / weight − 1, worst contact, third second", "", &StackOutcome::load_error, false},
    {"ids", "How many contact points are new", "share of new ids a frame, third second", "",
     &StackOutcome::ids_changed, false},
};
// Floats cannot tell a box's place ten metres up from the next one a millionth of a metre above.
constexpr double kStackResolution = 1e-6;

/// How many stacks came to grief how.
struct FaultCounts {
  std::array<int, 4> counts{};

  std::string spelled() const {
    const auto count = [&](StackFault fault) {
      return std::to_string(counts[static_cast<std::size_t>(fault)]);
    };
    return std::to_string(std::accumulate(counts.begin(), counts.end(), 0)) + " stacks, of which " +
           count(StackFault::Fallen) + " fell, " + count(StackFault::Energy) + " gained energy, " +
           count(StackFault::NotFinite) + " lost their numbers";
  }
};

/// Runs `cases` stacks, the same for every method and setting.
Measurement judge(int boxes, double ratio, const SolverSettings& settings, int cases,
                  std::span<const std::size_t> measures, const StudyOptions& options,
                  FaultCounts& faults) {
  Measurement measured(measures.size());
  for (int i = 0; i < cases; ++i) {
    std::mt19937_64 engine = case_engine(options.seed, i, boxes, ratio);
    const StackOutcome outcome = run_stack(stack_plan(engine, boxes, ratio), settings,
                                           options.frames.value_or(kStackFrames));
    ++faults.counts[static_cast<std::size_t>(outcome.fault)];
    ++measured.of;
    measured.times.add(outcome.nanoseconds);
    if (outcome.fault != StackFault::None) {
      ++measured.failed;
      continue;
    }
    for (std::size_t m = 0; m < measures.size(); ++m)
      measured.errors[m].add(outcome.*kStackMeasures[measures[m]].value);
  }
  return measured;
}

SolverSettings settings_of(const SolverMethod& method, int iterations, int substeps) {
  SolverSettings settings;
  settings.position_correction = method.correction;
  settings.warm_start = method.warm_start;
  settings.iterations = iterations;
  settings.substeps = substeps;
  return settings;
}

trace::Study described(const StackMeasure& measure) {
  trace::Study study;
  study.study = "solver";
  study.measure = measure.name;
  study.title = measure.title;
  study.context = study_context("float");
  study.error = measure.error;
  study.unit = measure.unit;
  return study;
}

void refer(std::vector<trace::Study>& studies, const FaultCounts& faults,
           const StudyOptions& options) {
  for (trace::Study& study : studies)
    study.reference = "the static solution; a call is a frame; " + faults.spelled() + "; seed " +
                      std::to_string(options.seed);
}

std::vector<trace::Study> curves(const CurveStack& stack, const StudyOptions& options,
                                 const StudyStep& step) {
  std::vector<trace::Study> studies;
  std::vector<std::size_t> measures;  // of each
  for (std::size_t m = 0; m < std::size(kStackMeasures); ++m) {
    if (&stack != kCurveStacks && !kStackMeasures[m].of_all_stacks) continue;
    measures.push_back(m);
    trace::Study& study = studies.emplace_back(described(kStackMeasures[m]));
    study.measure += stack.suffix;
    study.title += stack.title;
    study.parameter = "iterations or sub-steps";
    study.resolution = kStackResolution;
  }
  FaultCounts faults;
  for (const CurvePanel& panel : kCurvePanels) {
    for (const SolverMethod& method : kSolverMethods) {
      begin_series(studies, {method.name, {}, panel.name, panel.parameter});
      for (const int count : kCounts) {
        const SolverSettings settings =
            settings_of(method, panel.substeps ? 1 : count, panel.substeps ? count : 1);
        add_point(studies, count,
                  judge(stack.boxes, stack.ratio, settings, options.cases.value_or(stack.cases),
                        measures, options, faults));
      }
      step(std::string(method.name) + ", " + panel.parameter);
    }
  }
  refer(studies, faults, options);
  return studies;
}

std::vector<trace::Study> maps(const StudyOptions& options, const StudyStep& step) {
  constexpr std::size_t kMapped[] = {0, 2, 3};
  constexpr const char* kNames[] = {"map", "drift_map", "jitter_map"};
  constexpr const char* kErrors[] = {"deepest overlap after 3 s (mm)",
                                     "way of the highest box after 3 s (mm)",
                                     "speed of the fastest box, third second (mm/s)"};
  std::vector<trace::Study> studies;
  for (std::size_t i = 0; i < std::size(kMapped); ++i) {
    trace::Study& study = studies.emplace_back(described(kStackMeasures[kMapped[i]]));
    study.measure = kNames[i];
    study.title += ", by height and mass";
    study.error = kErrors[i];
    study.unit = {};
    study.parameter = "top mass / others";
    study.row = "stack";
    study.form = trace::StudyForm::Map;
  }
  FaultCounts faults;
  for (const std::size_t turn : {0, 1, 2, 5, 4, 3}) {  // a method's brothers under each other
    const SolverMethod& method = kSolverMethods[turn];
    for (const int boxes : kHeights) {
      const std::string row = std::to_string(boxes) + " boxes";
      begin_series(studies, {row, {}, method.map_name, studies.front().parameter});
      const SolverSettings settings =
          settings_of(method, method.map_iterations, method.map_substeps);
      for (int i = 0; i < kRatioSteps; ++i) {
        const double ratio = std::pow(10.0, 0.5 * i);
        Measurement measured = judge(boxes, ratio, settings, options.cases.value_or(kMapCases),
                                     kMapped, options, faults);
        add_point(studies, ratio, measured);
      }
      step(std::string(method.name) + ", " + row);
    }
  }
  for (trace::Study& study : studies) {
    for (trace::StudySeries& series : study.series) {
      for (trace::StudyPoint& point : series.points) {  // metres to millimetres
        if (point.error) point.error = 1000 * *point.error;
        if (point.error_worst) point.error_worst = 1000 * *point.error_worst;
      }
    }
  }
  refer(studies, faults, options);
  return studies;
}

}  // namespace

/// How stacks of boxes stand, by position method (Baumgarte, projection, soft), with and without warm
/// starting, against the static solution: every box at its height, every contact carrying what is
/// above it. Stacks and measures are those of solver_stack.h; three seconds, in float, 60 frames a
/// second. A stack that blows up (no numbers, energy from nowhere, a box fallen) counts as failed.
///
/// "penetration" (at the end), "worst" (in any frame), "drift", "jitter", "load" and "ids" against the
/// run time of a frame, over iterations without sub-steps and over sub-steps of one iteration each:
/// ten equal boxes. "penetration", "drift" and "jitter" likewise with "_heavy" for two boxes
/// under a third of a hundred times their mass, with "_two" and "_twenty" for so many equal boxes.
/// (Under ten thousand times their mass none of these settings keeps two boxes standing.)
///
/// "map", "drift_map", "jitter_map": stacks of 2 to 20 boxes, the highest of 1 to 10^6 times the
/// others' mass, at sixteen sweeps a frame for every method.
std::vector<trace::Study> study_solver(const StudyOptions& options, const StudyProgress& progress) {
  constexpr int kSteps =
      static_cast<int>(std::size(kCurveStacks) * std::size(kCurvePanels) + std::size(kHeights)) *
      static_cast<int>(std::size(kSolverMethods));
  const StudyStep step = counted(progress, kSteps);
  std::vector<trace::Study> result;
  for (const CurveStack& stack : kCurveStacks)
    std::ranges::move(curves(stack, options, step), std::back_inserter(result));
  std::ranges::move(maps(options, step), std::back_inserter(result));
  return result;
}

}  // namespace contactscope
