#pragma once

#include <vector>

#include "scenario/scenario.h"
#include "scenario/toml_reader.h"

namespace contactscope::scenario_file {

/// [[expect]] of a scenario whose shapes, pairs and frames have been read.
std::vector<Expectation> read_expectations(const toml_reader::Value& value,
                                           const Scenario& scenario);

}  // namespace contactscope::scenario_file
