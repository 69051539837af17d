#include "study/random_cases.h"
#include "study/solver_stack.h"
#include "study/study.h"

namespace contactscope {
namespace {

constexpr double kAllOfItsPush = 1e6;                // metres per second: Baumgarte as in the talk
constexpr int kCounts[] = {1, 2, 4, 8, 16, 32, 64};  // iterations, or sub-steps
constexpr int kHeights[] = {20, 14, 9, 6, 4, 3, 2};  // boxes; the tallest is the top row of a map
constexpr int kRatioSteps = 13;                      // two per decade, from 1 to 10^6
constexpr int kMapCases = 2;                         // stacks per cell
constexpr int kPointCases = 8, kPointBoxes = 6;      // stacks per number of points; equal boxes

struct SolverMethod {
  const char* name;
  PositionCorrection correction;
  bool warm_start;
  const char* map_name;
  int map_iterations, map_substeps;
};

// In maps every method has sixteen sweeps per frame: projection and soft contacts spend half of
// theirs on positions.
constexpr SolverMethod kSolverMethods[] = {
    {"baumgarte, warm", PositionCorrection::Baumgarte, true, "baumgarte, warm: 16 sweeps", 16, 1},
    {"projection, warm", PositionCorrection::Projection, true, "projection, warm: 8 + 8", 8, 1},
    {"soft, warm", PositionCorrection::Soft, true, "soft, warm: 4 × (2 + 2)", 2, 4},
    // In this order each cold method has a colour close to its warm one's.
    {"soft, cold", PositionCorrection::Soft, false, "soft, cold: 4 × (2 + 2)", 2, 4},
    {"projection, cold", PositionCorrection::Projection, false, "projection, cold: 8 + 8", 8, 1},
    {"baumgarte, cold", PositionCorrection::Baumgarte, false, "baumgarte, cold: 16 sweeps", 16, 1},
};

struct CurveStack {
  const char* suffix;  // of the measure's name
  const char* title;   // appended to the measure's
  int boxes;
  double ratio;
  int cases;  // stacks per point
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

/// One value of an outcome, and its names.
struct StackMeasure {
  const char* name;
  const char* title;
  const char* error;
  const char* unit;
  double StackOutcome::*value;
  // Set for measures that also have maps; others exist for the first stack only.
  const char* map_name = nullptr;
  const char* map_error = nullptr;
};
constexpr StackMeasure kStackMeasures[] = {
    {"penetration", "How far boxes sink into each other", "deepest overlap after 3 s", "m",
     &StackOutcome::penetration, "map", "deepest overlap after 3 s (mm)"},
    {"worst", "How deep boxes have been in each other", "deepest overlap of any frame", "m",
     &StackOutcome::worst_penetration},
    {"drift", "How far the top of a stack drifts", "way of the highest box after 3 s", "m",
     &StackOutcome::drift, "drift_map", "way of the highest box after 3 s (mm)"},
    {"jitter", "How still a stack stands", "speed of the fastest box, third second", "m/s",
     &StackOutcome::jitter, "jitter_map", "speed of the fastest box, third second (mm/s)"},
    {"load", "How well contacts carry what is above them",
     "force / weight − 1, worst contact, third second", "", &StackOutcome::load_error},
    {"ids", "How many contact points are new", "share of new ids a frame, third second", "",
     &StackOutcome::ids_changed},
};
// Ten metres up, float's resolution of a box's position is about a micrometre.
constexpr double kStackResolution = 1e-6;

/// Collects lines; every method and setting has the same stacks at each point.
class StackResults {
 public:
  /// `call` names a measure; without a name it is omitted.
  template <class Call>
  StackResults(const StudyOptions& options, int cases, const char* parameter, trace::StudyForm form,
               const Call& call)
      : options_(options), cases_(options.cases.value_or(cases)) {
    std::vector<StudyMeasure> measures;
    for (const StackMeasure& measure : kStackMeasures) {
      const StudyMeasure called = call(measure);
      if (called.name.empty()) continue;
      measures.push_back(called);
      values_.push_back(measure.value);
    }
    results = results_of("solver", "float", parameter, "", measures, form);
  }

  /// Thread-safe.
  Measurement judge(int boxes, double ratio, const SolverMethod& method, int iterations,
                    int substeps, std::optional<int> max_points = {}, bool contacts_alone = false) {
    SolverSettings settings;
    settings.position_correction = method.correction;
    settings.warm_start = method.warm_start;
    settings.push_speed = kAllOfItsPush;
    settings.iterations = iterations;
    settings.substeps = substeps;
    Measurement measured(values_.size(), cases_);
    for (int i = 0; i < cases_; ++i) {
      std::mt19937_64 engine = case_engine(options_.seed, i, boxes, ratio);
      const StackOutcome outcome =
          run_stack(stack_plan(engine, boxes, ratio), settings,
                    options_.frames.value_or(kStackFrames), max_points, contacts_alone);
      {
        const std::lock_guard lock(counting_);
        ++faults_[static_cast<std::size_t>(outcome.fault)];
      }
      measured.times.add(outcome.nanoseconds);
      if (outcome.fault != StackFault::None) ++measured.failed;
      for (std::size_t m = 0; m < values_.size() && outcome.fault == StackFault::None; ++m)
        measured.errors[m].add(outcome.*values_[m]);
    }
    return measured;
  }

  /// Adds the number of failed stacks by cause.
  std::vector<trace::Study> finished() {
    const auto count = [&](StackFault fault) {
      return std::to_string(faults_[static_cast<std::size_t>(fault)]);
    };
    for (trace::Study& study : results)
      study.reference = "the static solution; a call is a frame; " +
                        std::to_string(std::accumulate(faults_.begin(), faults_.end(), 0)) +
                        " stacks, of which " + count(StackFault::Fallen) + " fell, " +
                        count(StackFault::Energy) + " gained energy, " +
                        count(StackFault::NotFinite) + " lost their numbers; seed " +
                        std::to_string(options_.seed);
    return results;
  }

  std::vector<trace::Study> results;

 private:
  const StudyOptions& options_;
  int cases_;
  std::vector<double StackOutcome::*> values_;  // one per result
  std::mutex counting_;
  std::array<int, 4> faults_{};
};

std::vector<trace::Study> curves(const CurveStack& stack, const StudyOptions& options,
                                 const StudyStep& step) {
  StackResults stacks(options, stack.cases, "iterations or sub-steps",
                      trace::StudyForm::WorkPrecision, [&](const StackMeasure& m) -> StudyMeasure {
                        if (&stack != kCurveStacks && m.map_name == nullptr) return {};
                        return {std::string(m.name) + stack.suffix,
                                std::string(m.title) + stack.title, m.error, m.unit,
                                kStackResolution};
                      });
  for (const CurvePanel& panel : kCurvePanels) {
    for (const SolverMethod& method : kSolverMethods) {
      add_line(stacks.results, {method.name, {}, panel.name, panel.parameter}, kCounts,
               [&](int count) {
                 return stacks.judge(stack.boxes, stack.ratio, method, panel.substeps ? 1 : count,
                                     panel.substeps ? count : 1);
               });
      step(std::string(method.name) + ", " + panel.parameter);
    }
  }
  return stacks.finished();
}

/// Catto 2007, "Manifold Reduction": what points beyond the fourth cost, what the others are worth.
std::vector<trace::Study> by_points(const StudyOptions& options, const StudyStep& step) {
  constexpr int kPointCounts[] = {1, 2, 3, 4, 5, 6, 7, 8};
  StackResults stacks(options, kPointCases, "points kept", trace::StudyForm::Curves,
                      [&](const StackMeasure& m) -> StudyMeasure {
                        if (m.value != &StackOutcome::jitter) return {};
                        return {"max_points", "How many points of a contact a stack needs", m.error,
                                m.unit, kStackResolution};
                      });
  for (const SolverMethod& method : kSolverMethods) {
    if (!method.warm_start) continue;
    for (const bool contacts_alone : {false, true})
      add_line(stacks.results,
               {method.name + std::string(contacts_alone ? ", contacts alone" : ""), {}},
               kPointCounts, [&](int most) {
                 return stacks.judge(kPointBoxes, 1, method, method.map_iterations,
                                     method.map_substeps, most, contacts_alone);
               });
    step(std::string(method.name) + ", points kept");
  }
  return stacks.finished();
}

std::vector<trace::Study> maps(const StudyOptions& options, const StudyStep& step) {
  constexpr const char* kParameter = "top mass / others";
  constexpr auto kMap = trace::StudyForm::Map;
  StackResults stacks(options, kMapCases, kParameter, kMap, [](const StackMeasure& m) {
    if (m.map_name == nullptr) return StudyMeasure{};
    return StudyMeasure{m.map_name, std::string(m.title) + ", by height and mass", m.map_error};
  });
  for (trace::Study& study : stacks.results) study.row = "stack";
  std::vector<double> ratios;
  for (int i = 0; i < kRatioSteps; ++i) ratios.push_back(std::pow(10.0, 0.5 * i));
  struct Row {
    const SolverMethod& method;
    int boxes;
    std::vector<Measurement> cells;
    int judged = 0;
    std::string name() const { return std::to_string(boxes) + " boxes"; }
  };
  std::vector<Row> rows;
  for (const std::size_t turn : {0, 1, 2, 5, 4, 3})  // warm above cold
    for (const int boxes : kHeights)
      rows.push_back({kSolverMethods[turn], boxes, {ratios.size(), Measurement(0)}});
  // A map has no times, so its stacks run in parallel.
  std::mutex labelled;
  Workers(options.thread_count()).for_each(count_of(rows) * kRatioSteps, [&](int piece, int) {
    Row& row = at(rows, piece / kRatioSteps);
    const int i = piece % kRatioSteps;
    at(row.cells, i) = stacks.judge(row.boxes, at(ratios, i), row.method, row.method.map_iterations,
                                    row.method.map_substeps);
    const std::lock_guard lock(labelled);
    if (++row.judged == kRatioSteps) step(std::string(row.method.name) + ", " + row.name());
  });
  for (const Row& row : rows) {
    auto next = row.cells.begin();
    add_line(stacks.results, {row.name(), {}, row.method.map_name, kParameter}, ratios,
             [&](double) { return *next++; });
  }
  for (trace::Study& study : stacks.results) record::scale_errors(study, 1000);  // millimetres
  return stacks.finished();
}

struct EnergyMethod {
  const char* name;
  PositionCorrection correction;
  double push_speed = 0;  // m/s
};
constexpr EnergyMethod kEnergyMethods[] = {
    {"Baumgarte", PositionCorrection::Baumgarte, 0},
    {"projection", PositionCorrection::Projection, 0},
    {"soft contacts", PositionCorrection::Soft, 0},
    {kAllPushKept, PositionCorrection::Baumgarte, kAllOfItsPush},
};
constexpr int kEnergySubsteps[] = {1, 2, 4, 8, 16, 32};
constexpr double kEnergyResolution = 1e-4;  // relative to the initial energy

trace::Study energies(const StudyOptions& options, const StudyStep& step) {
  std::vector<trace::Study> results =
      results_of("solver", "double", "sub-steps of a frame",
                 "energy at the start and the work of taking out its overlaps; twenty scenes",
                 {{"energy", "How much energy a solver adds", "energy gained", trace::kShare,
                   kEnergyResolution}},
                 trace::StudyForm::Curves);
  const std::vector<EnergyScene> scenes = energy_scenes();
  for (const EnergyMethod& method : kEnergyMethods) {
    add_line(results, {method.name, {}}, kEnergySubsteps, [&](int substeps) {
      SolverSettings settings;
      settings.position_correction = method.correction;
      settings.push_speed = method.push_speed;
      settings.substeps = substeps;
      Measurement measured(1, count_of(scenes));
      measured.times.measure(count_of(scenes), [&](int i) {
        EnergyScene scene = at(scenes, i);
        scene.frames = std::min(scene.frames, options.frames.value_or(scene.frames));
        const double gained = std::max(energy_gained(std::move(scene), settings), 0.0);
        measured.errors[0].add(gained);
        return gained;
      });
      return measured;
    });
    step(method.name);
  }
  return results.front();
}

}  // namespace

/// Stacks of boxes by position method (Baumgarte, projection, soft), with and without warm
/// starting, compared with the static solution: every box at its height, every contact carrying the
/// weight above. Stacks and measures are those of solver_stack.h; three seconds, in float, 60
/// frames per second. A stack fails if it has values that are not finite, gains energy, or falls.
///
/// "penetration" (at the end), "worst" (in any frame), "drift", "jitter", "load" and "ids" against
/// the run time of a frame, over iterations without sub-steps and over sub-steps of one iteration
/// each: ten equal boxes. "penetration", "drift" and "jitter" also with "_heavy": two boxes under a
/// third of a hundred times their mass, and with "_two" and "_twenty" equal boxes. (Under ten
/// thousand times their mass none of these settings keeps two boxes standing.)
///
/// "map", "drift_map", "jitter_map": stacks of 2 to 20 boxes, the highest of 1 to 10^6 times the
/// others' mass, at sixteen sweeps per frame for every method.
///
/// "max_points": jitter of six equal boxes, of whose contacts the usual reducer keeps at most 1 to 8
/// points; times are of a frame, contacts and reduction included, or of these alone.
///
/// "energy": largest energy gain of any frame of a scene, over sub-steps, mean and worst of the
/// twenty scenes of solver_stack.h; also for Baumgarte with its whole push kept as velocity.
std::vector<trace::Study> study_solver(const StudyOptions& options, const StudyProgress& progress) {
  constexpr int kSteps =
      static_cast<int>(std::size(kCurveStacks) * std::size(kCurvePanels) + std::size(kHeights)) *
          static_cast<int>(std::size(kSolverMethods)) +
      static_cast<int>(std::size(kEnergyMethods)) +
      static_cast<int>(std::ranges::count(kSolverMethods, true, &SolverMethod::warm_start));
  const StudyStep step = counted(progress, kSteps);
  std::vector<trace::Study> result;
  for (const CurveStack& stack : kCurveStacks)
    std::ranges::move(curves(stack, options, step), std::back_inserter(result));
  std::ranges::move(by_points(options, step), std::back_inserter(result));
  std::ranges::move(maps(options, step), std::back_inserter(result));
  result.push_back(energies(options, step));
  return result;
}

}  // namespace contactscope
