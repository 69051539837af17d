#pragma once

#include "scenario/scenario.h"
#include "scenario/toml_reader.h"

namespace contactscope::scenario_file {

/// A sentence, with its line, for each key of [pipeline], [[pairs]], [world] and [solver], and each
/// shape's friction or restitution, that is written down and changes nothing in this scene: another
/// method goes by it, or the shapes it is of are not there. `scenario` has its shapes, pairs and solver
/// already.
std::vector<std::string> idle_keys(const toml_reader::Table& file, const Scenario& scenario);

}  // namespace contactscope::scenario_file
