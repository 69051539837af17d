#pragma once

#include <string>
#include <vector>

#include "app/ledger.h"
#include "app/options.h"
#include "scenario/scenario.h"
#include "trace/trace.h"

namespace contactscope::app {

/// A scenario with its whole trace.
struct Sequence {
  trace::Header header;
  std::vector<trace::Frame> frames;
  std::vector<double> nanoseconds;  // measured pipeline time of each frame; empty unless asked for
};

/// Runs the pipeline over all frames and records `stages`.
Sequence run_sequence(const Scenario& scenario, const trace::Stages& stages, bool timing,
                      Ledger& ledger);

}  // namespace contactscope::app
