#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "study/study.h"

namespace contactscope {

/// Mean and worst error over the cases that did not fail; none where there is no such case.
struct Errors {
  double sum = 0, worst = 0;
  int count = 0;

  void add(double error) {
    sum += error;
    worst = std::max(worst, error);
    ++count;
  }
};

/// Tells of the next step of a study.
using StudyStep = std::function<void(const std::string& what)>;

/// One that counts up to `total`. `progress` must outlive it.
inline StudyStep counted(const StudyProgress& progress, int total) {
  return [&progress, total, done = 0](const std::string& what) mutable {
    progress(++done, total, what);
  };
}

/// Times of one method, nanoseconds a call, one a repetition.
class PassTimes {
 public:
  /// Times `calls` calls of `call(i)`, i = 0 .. calls - 1. What `call` returns is used, so that the
  /// compiler cannot leave it out.
  template <class Call>
  void measure(int calls, const Call& call) {
    double used = 0;
    const double begin = now();
    for (int i = 0; i < calls; ++i) used += call(i);
    add((now() - begin) / calls);
    sink_ = used;
  }
  void add(double nanoseconds) { times_.push_back(nanoseconds); }

  std::vector<double> sorted() const;
  /// At least one repetition was measured.
  trace::Nanoseconds summary() const;

 private:
  static double now();  // nanoseconds on a clock that never runs backwards

  std::vector<double> times_;
  volatile double sink_ = 0;
};

/// What one method came to at one parameter: errors for each measure of its study, and its times.
struct Measurement {
  std::vector<Errors> errors;
  PassTimes times{};
  int failed = 0;  // cases that have no error
  int of = 0;      // cases

  explicit Measurement(std::size_t measures) : errors(measures) {}
  trace::StudyPoint point(double parameter, std::size_t measure) const;
};

/// The same study by another measure: its name, its title, and what its error is called.
trace::Study by_measure(trace::Study study, const char* measure, const char* title,
                        const char* error);

/// Begins a line in each result of a study.
void begin_series(std::vector<trace::Study>& results, const trace::StudySeries& series);

/// Ends the line of each result with what was measured at a parameter; a measure a result.
void add_point(std::vector<trace::Study>& results, double parameter, const Measurement& measured);

/// Methods that are measured at the same parameters, on the same cases.
struct StudyGrid {
  std::vector<std::string> methods;
  std::vector<double> parameters;
  int cases;  // a parameter
  int repetitions;

  /// `list`: anything with a `name` each. The options go before the study's own numbers.
  template <class Methods>
  StudyGrid(const StudyOptions& options, const Methods& list, std::span<const int> every_parameter,
            int own_cases, int own_repetitions)
      : parameters(every_parameter.begin(), every_parameter.end()),
        cases(options.cases.value_or(own_cases)),
        repetitions(options.repetitions.value_or(own_repetitions)) {
    for (const auto& method : list) methods.emplace_back(method.name);
  }
};

/// Steps: for each parameter make its cases, `prepare(p)`, and let each method be judged by them,
/// `judge(m, p, measurement)`; then time passes over all cases, `call(m, p, i)`, methods in turn
/// within a repetition and each repetition beginning with another one, so that a slow moment of the
/// machine falls on all alike. The lines are added to the results.
template <class Prepare, class Judge, class Call>
void measure_grid(const StudyGrid& grid, std::vector<trace::Study>& results,
                  const StudyProgress& progress, const Prepare& prepare, const Judge& judge,
                  const Call& call) {
  const std::size_t methods = grid.methods.size(), parameters = grid.parameters.size();
  Measurement empty(results.size());
  empty.of = grid.cases;
  std::vector<std::vector<Measurement>> measured(methods, {parameters, empty});
  const StudyStep step = counted(progress, static_cast<int>(parameters) + grid.repetitions);
  for (std::size_t p = 0; p < parameters; ++p) {
    prepare(p);
    for (std::size_t m = 0; m < methods; ++m) judge(m, p, measured[m][p]);
    step("errors of " + std::to_string(static_cast<int>(grid.parameters[p])) + " " +
         results.front().parameter);
  }
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
    begin_series(results, {grid.methods[m], {}});
    for (std::size_t p = 0; p < parameters; ++p)
      add_point(results, grid.parameters[p], measured[m][p]);
  }
}

}  // namespace contactscope
