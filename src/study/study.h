#pragma once

#include <chrono>

#include "core/workers.h"
#include "study/picture.h"

namespace contactscope {

struct Scenario;

struct StudyOptions {
  std::uint64_t seed = 1;                   // the same seed gives the same cases and errors
  std::optional<int> cases;                 // per point, >= 1; each study has its own default
  std::optional<int> repetitions;           // of timed passes, >= 1; likewise
  std::optional<int> frames;                // frames simulated by the solver study, >= 1; likewise
  std::vector<std::string> peer_folders{};  // of other libraries' programs; $PATH is searched too
  const std::vector<Scenario>* scenarios = nullptr;  // for studies of scenarios
  std::vector<int> only_frames{};                    // of the scenarios; empty: all
  int threads = 0;  // for untimed work; 0: one per hardware thread. Does not affect errors
  int thread_count() const { return threads > 0 ? threads : hardware_threads(); }
  std::string seeded() const { return ", seed " + std::to_string(seed); }
};

/// Called for each step, from any thread but never concurrently; may throw to stop the study.
using StudyProgress = std::function<void(int done, int total, const std::string& what)>;

/// Returns one result per measure of error, the main one first.
using RunStudy = std::vector<trace::Study>(const StudyOptions& options,
                                           const StudyProgress& progress);

// Each is documented in the file of its name.
RunStudy study_reducers, study_hull_precision, study_penetration, study_limits,
    study_manifold_stability, study_solver, study_overlap, study_broad_phase, study_meshes,
    study_triangles, study_time_of_impact, study_tunnelling, study_distance_field,
    study_flip_distance, study_ghosts, study_phase, study_box_path, study_bounding_trees,
    study_distance;

struct StudyInfo {
  std::string name;
  std::string summary;  // one line
  RunStudy* run;
  bool of_scenarios = false;  // needs scenarios
};

/// Every study, in listing order.
const std::vector<StudyInfo>& studies();

/// Processor, compiler and build of this program, and the current time.
trace::StudyContext study_context(const std::string& scalar);

/// Mean and worst error over the cases that did not fail; empty if all did.
struct Errors {
  double sum = 0, worst = 0;
  int count = 0;

  void add(double error) {
    sum += error;
    worst = std::max(worst, error);
    ++count;
  }
};

/// Reports the next step of a study.
using StudyStep = std::function<void(const std::string& what)>;

/// Counts up to `total`. `progress` must outlive it.
inline StudyStep counted(const StudyProgress& progress, int total) {
  return [&progress, total, done = 0](const std::string& what) mutable {
    progress(++done, total, what);
  };
}

/// Times of one method, nanoseconds per call, one per repetition.
class PassTimes {
 public:
  /// Times `calls` calls of `call(i)`, and uses their results, so that they are not optimised away.
  template <class Call> void measure(int calls, const Call& call) {
    double used = 0;
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < calls; ++i) used += call(i);
    const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - begin;
    add(time.count() / calls);
    sink_ = used;
  }
  template <class Call> void measure(int repetitions, int calls, const Call& call) {
    for (int i = 0; i < repetitions; ++i) measure(calls, call);
  }
  void add(double nanoseconds) { times_.push_back(nanoseconds); }

  std::vector<double> sorted() const;
  /// Requires at least one repetition.
  trace::Nanoseconds summary() const;

 private:
  std::vector<double> times_;
  volatile double sink_ = 0;
};

/// Results of one method at one parameter: errors for each measure of its study, and times.
struct Measurement {
  std::vector<Errors> errors;
  PassTimes times{};
  int failed = 0;  // cases without an error
  int of = 0;
  explicit Measurement(std::size_t measures, int cases = 0) : errors(measures), of(cases) {}
  trace::StudyPoint point(double parameter, std::size_t measure) const;
};

/// One of the errors that a study measures.
struct StudyMeasure {
  std::string name, title;
  std::string error;  // its name
  std::string unit{};
  double resolution = 0;  // errors up to this one are rounding noise
};

/// One result for each measure of a study, without lines.
std::vector<trace::Study> results_of(const std::string& study, const std::string& scalar,
                                     const std::string& parameter, const std::string& reference,
                                     const std::vector<StudyMeasure>& measures,
                                     trace::StudyForm form = trace::StudyForm::WorkPrecision);

/// Makes the worst of each share the share itself; `least`: drawn for shares of none.
void finish_share(trace::Study& study, double least = 0);

/// Lines of one panel, a line per name in each result of a study.
class StudyLines {
 public:
  template <class Names>
  StudyLines(std::vector<trace::Study>& results, const Names& names, const std::string& panel,
             const std::string& parameter)
      : results_(results), first_(results.front().series.size()) {
    for (trace::Study& study : results)
      for (const auto& named : names) study.series.push_back({named.name, {}, panel, parameter});
  }
  void add(std::size_t line, double parameter, const Measurement& measured) const {
    for (std::size_t i = 0; i < results_.size(); ++i)
      points(i, line).push_back(measured.point(parameter, i));
  }
  std::vector<trace::StudyPoint>& points(std::size_t result, std::size_t line) const {
    return results_[result].series[first_ + line].points;
  }

 private:
  std::vector<trace::Study>& results_;
  std::size_t first_;
};

/// Adds a line to each result of a study, from `judge(parameter)` at each parameter.
template <class Parameters, class Judge>
void add_line(std::vector<trace::Study>& results, const trace::StudySeries& series,
              const Parameters& parameters, const Judge& judge) {
  for (trace::Study& study : results) study.series.push_back(series);
  for (const auto parameter : parameters) {
    const Measurement& measured = judge(parameter);
    for (std::size_t i = 0; i < results.size(); ++i)
      results[i].series.back().points.push_back(measured.point(parameter, i));
  }
}

/// Methods measured at the same parameters, on the same cases.
struct StudyGrid {
  std::vector<std::string> methods;
  std::vector<int> parameters;
  int cases;  // per parameter
  int repetitions;
  int threads;
  std::string panel{}, axis{};  // of the lines

  /// `list`: items with a `name`. The options override the study's own numbers.
  template <class Methods>
  StudyGrid(const StudyOptions& options, const Methods& list, std::span<const int> every_parameter,
            int own_cases, int own_repetitions)
      : parameters(every_parameter.begin(), every_parameter.end()),
        cases(options.cases.value_or(own_cases)),
        repetitions(options.repetitions.value_or(own_repetitions)),
        threads(options.thread_count()) {
    for (const auto& method : list) methods.emplace_back(method.name);
  }
};

/// Steps: for each parameter create its cases, `prepare(p)`; test each method on them, `judge(m, p,
/// measurement)`, in parallel; then, in one thread, time passes over all cases, `call(m, p, i)`.
/// Methods alternate within a repetition and each repetition starts with another one, so that a
/// slow moment affects all alike. Adds the lines to the results.
template <class Prepare, class Judge, class Call>
void measure_grid(const StudyGrid& grid, std::vector<trace::Study>& results,
                  const StudyProgress& progress, const Prepare& prepare, const Judge& judge,
                  const Call& call) {
  const std::size_t methods = grid.methods.size(), parameters = grid.parameters.size();
  std::vector<std::vector<Measurement>> measured(
      methods, {parameters, Measurement(results.size(), grid.cases)});
  const StudyStep step = counted(progress, static_cast<int>(parameters) + grid.repetitions);
  for (std::size_t p = 0; p < parameters; ++p) prepare(p);
  std::mutex labelled;
  std::vector<std::size_t> judged(parameters);
  Workers(grid.threads).for_each(static_cast<int>(methods * parameters), [&](int piece, int) {
    const std::size_t p = static_cast<std::size_t>(piece) / methods;
    const std::size_t m = static_cast<std::size_t>(piece) % methods;
    judge(m, p, measured[m][p]);
    const std::lock_guard lock(labelled);
    if (++judged[p] == methods)
      step("errors of " + std::to_string(grid.parameters[p]) + " " + results.front().parameter);
  });
  for (int repetition = 0; repetition < grid.repetitions; ++repetition) {
    for (std::size_t p = 0; p < parameters; ++p) {
      for (std::size_t turn = 0; turn < methods; ++turn) {
        const std::size_t m = (turn + static_cast<std::size_t>(repetition)) % methods;
        measured[m][p].times.measure(
            grid.cases, [&](int i) { return call(m, p, static_cast<std::size_t>(i)); });
      }
    }
    step("times");
  }
  for (std::size_t m = 0; m < methods; ++m) {
    auto next = measured[m].begin();
    add_line(results, {grid.methods[m], {}, grid.panel, grid.axis}, grid.parameters,
             [&](int) { return *next++; });
  }
}

}  // namespace contactscope
