#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "lint/linter.h"

namespace contactscope::app {

/// Text of a finding: two or three lines, without the last line break.
std::string record(const std::string& file, const lint::Finding& finding);

/// JSON of a finding.
nlohmann::ordered_json to_json(const lint::Finding& finding);

}  // namespace contactscope::app
