#pragma once

#include <nlohmann/json_fwd.hpp>

#include "app/cli/catalogue.h"
#include "lint/linter.h"

/// Findings of `lint` in the contacts of scenarios and traces.
namespace contactscope::app {

/// Text of a finding: two or three lines, without the last line break.
std::string record(const std::string& file, const lint::Finding& finding);

nlohmann::ordered_json to_json(const lint::Finding& finding);

/// The options of `lint`. Throws UsageError.
lint::LintOptions linter_options(const Options& options);

/// Findings about the pipeline's results for a scenario, with their lines in the frames + 1 lines
/// of `contactscope trace`.
std::vector<lint::Finding> lint_scenario(const Scenario& scenario, const std::vector<int>& frames,
                                         const lint::LintOptions& options);

/// Findings about a trace, hints and those below a threshold included, for these frames (all
/// without), and the line where it breaks off. `look` is called with every frame. Throws InputError
/// and UsageError.
std::vector<lint::Finding> lint_trace(TraceFile& file, const lint::LintOptions& options,
                                      const std::optional<FrameRange>& frames = {},
                                      const std::function<void(const trace::Frame&)>& look = {});

/// Findings about all frames of an input. Throws InputError and UsageError.
std::vector<lint::Finding> lint_input(const Input& input, const lint::LintOptions& options);

/// If a view has the panel `lint` or the focus `worst`, adds the findings of lint_input(), with their
/// places in the frames that are drawn, to such views: first the place that `lint` names; with
/// --pair only those of this pair. Returns what the first of them says.
std::string add_faults(const Input& input, const std::vector<int>& drawn, const Options& options,
                       std::vector<View>& views);

}  // namespace contactscope::app
