#include "app/sequence.h"

#include <algorithm>
#include <limits>

#include "scenario/run.h"

namespace contactscope::app {
namespace {

// Shortest of a few unrecorded runs of a runner's next frame: what the pipeline costs without being
// watched.
double measure(const Runner& before, int frame) {
  constexpr int kRuns = 25;
  double best = std::numeric_limits<double>::max();
  for (int i = 0; i < kRuns; ++i) {
    Runner runner = before;
    const auto begin = std::chrono::steady_clock::now();
    runner.frame_unrecorded(frame);
    const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - begin;
    best = std::min(best, time.count());
  }
  return best;
}

}  // namespace

Sequence run_sequence(const Scenario& scenario, const trace::Stages& stages, bool timing,
                      Ledger& ledger) {
  const Timed timed(ledger, "pipeline");
  Sequence sequence;
  Runner runner(scenario, stages);
  sequence.header = runner.header();
  for (int frame = 0; frame < scenario.frames; ++frame) {
    if (timing) sequence.nanoseconds.push_back(measure(runner, frame));
    sequence.frames.push_back(runner.frame(frame));
  }
  return sequence;
}

}  // namespace contactscope::app
