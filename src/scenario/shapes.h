#pragma once

#include <vector>

#include "scenario/scenario.h"
#include "scenario/shape_values.h"
#include "scenario/toml_reader.h"

namespace contactscope::scenario_file {

/// Most points that a hull may be built from.
inline constexpr std::size_t kMaxHullPoints = 100000;

/// The [shapes] table, in file order. `end_time` is the time of the last frame in seconds.
std::vector<ScenarioShape> read_shapes(const toml_reader::Value& value,
                                       const Surroundings& surroundings, double end_time);

}  // namespace contactscope::scenario_file
