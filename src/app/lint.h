#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "app/catalogue.h"
#include "lint/linter.h"

namespace contactscope::app {

/// What is wrong with the claims of what a scenario's pipeline computes, each with its line among the
/// frames + 1 as `contactscope trace` writes it.
std::vector<lint::Finding> lint_scenario(const Input& input);

/// The same of a trace as it stands, of the frames that --frames names; and where it is cut off. `look` sees
/// all frames in passing. Throws InputError and UsageError.
std::vector<lint::Finding> lint_trace(TraceFile& file, const Options& options,
                                      const std::function<void(const trace::Frame&)>& look = {});

/// One finding for people: two lines, or three, without the last line break.
std::string told(const std::string& file, const lint::Finding& finding);

/// The same for programs.
nlohmann::ordered_json to_json(const lint::Finding& finding);

}  // namespace contactscope::app
