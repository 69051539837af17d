#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "app/cli/catalogue.h"
#include "lint/linter.h"

namespace contactscope::app {

/// Findings about the pipeline's results for a scenario, with their lines in the frames + 1 lines
/// of `contactscope trace`.
std::vector<lint::Finding> lint_scenario(const Input& input, const Options& options);

/// Findings about a trace, hints and those below a threshold included, for the frames of --frames, and the line where it breaks off. `look` is
/// called with every frame. Throws InputError and UsageError.
std::vector<lint::Finding> lint_trace(TraceFile& file, const Options& options,
                                      const std::function<void(const trace::Frame&)>& look = {});

/// Text of a finding: two or three lines, without the last line break.
std::string record(const std::string& file, const lint::Finding& finding);

/// JSON of a finding.
nlohmann::ordered_json to_json(const lint::Finding& finding);

}  // namespace contactscope::app
