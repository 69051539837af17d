#pragma once

#include <vector>

#include "app/catalogue.h"
#include "snapshot/finding.h"

namespace contactscope::app {

/// Runs and draws scenarios, and holds them against what is stored. What came of it is in the folder of the report, and is
/// returned; who is told of it is not known here. Of a trace, which expects nothing, its first, middle and last
/// frame are stored. Throws InputError where there is no folder of snapshots and none is to be written.
snapshot::Outcome run_check(std::vector<Input>& inputs, const Options& options);

}  // namespace contactscope::app
