#include <iostream>

#include "app/cli/catalogue.h"
#include "scenario/run.h"

namespace contactscope::app {
namespace {

// Prints the facts without opening OpenGL.
ExitCode run_trace(const Options& options) {
  const std::vector<Scenario> scenarios = load_scenarios(options);
  if (scenarios.size() != 1) throw UsageError("trace takes one scenario");
  const Scenario& scenario = scenarios.front();
  trace::Stages stages;
  stages.decisions = true;
  Runner runner(scenario, stages);
  std::cout << trace::to_json_line(runner.header()) << '\n';
  for (const int frame : options.selected(scenario.frames))
    std::cout << trace::to_json_line(runner.frame(frame)) << '\n';
  return ExitCode::Same;
}

}  // namespace

Verb trace_verb() { return {"trace", "Print the pipeline's facts as JSON lines", &run_trace}; }

}  // namespace contactscope::app
