#pragma once

#include <vector>

#include "app/cli/catalogue.h"
#include "snapshot/finding.h"

namespace contactscope::app {

/// Runs and draws scenarios, compares them with snapshots, writes the report folder and returns the
/// outcome; the caller prints it. The first, middle and last frames of a trace are stored. Throws
/// InputError if there is no snapshot folder and none is to be written.
snapshot::Outcome run_check(std::vector<Input>& inputs, const Options& options);

}  // namespace contactscope::app
