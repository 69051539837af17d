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

/// One sentence for each two kinds of shapes that are paired and make no contacts.
std::vector<std::string> pairs_without_contact(const std::vector<ScenarioPair>& pairs,
                                               const std::vector<ScenarioShape>& shapes);

/// Every pair of `shapes` in file order, each with `settings`; where some are dynamic, every pair of
/// which one is. More than kMaxPairs throw, at `at`.
std::vector<ScenarioPair> every_pair(const std::vector<ScenarioShape>& shapes,
                                     const PipelineSettings& settings,
                                     const toml_reader::Value& at);

/// Index of the shape that `value` names.
int shape_named(const toml_reader::Value& value, const std::vector<ScenarioShape>& shapes);

}  // namespace contactscope::scenario_file
