#pragma once

#include <vector>

#include "scenario/scenario.h"
#include "scenario/toml_reader.h"

namespace contactscope::scenario_file {

/// Most pairs of one scenario, listed or by default.
inline constexpr std::size_t kMaxPairs = 4096;

/// [pipeline].
PipelineSettings read_pipeline(const toml_reader::Value& value);

/// [[pairs]]; each starts from `settings` and may override all of them but the scalar.
std::vector<ScenarioPair> read_pairs(const toml_reader::Value& value,
                                     const std::vector<ScenarioShape>& shapes,
                                     const PipelineSettings& settings);

/// Takes out the pairs that make no contacts, planes and meshes with each other: where nothing was
/// looked for, "separated" would be a lie. Returns one sentence for each two kinds of them.
std::vector<std::string> leave_out_uncollided(std::vector<ScenarioPair>& pairs,
                                              const std::vector<ScenarioShape>& shapes);

/// Every pair of `shapes` in file order, each with `settings`; where some are dynamic, every pair of
/// which one is. More than kMaxPairs throw, at `at`.
std::vector<ScenarioPair> every_pair(const std::vector<ScenarioShape>& shapes,
                                     const PipelineSettings& settings,
                                     const toml_reader::Value& at);

/// Index of the shape that `value` names.
int shape_named(const toml_reader::Value& value, const std::vector<ScenarioShape>& shapes);

}  // namespace contactscope::scenario_file
