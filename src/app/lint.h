#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "app/catalogue.h"
#include "lint/linter.h"

namespace contactscope::app {

/// What is wrong with the claims of an input: of a trace as it stands, of a scenario of what its pipeline
/// computes, with its line among the frames + 1 as `contactscope trace` writes it.
std::vector<lint::Finding> lint_input(const Input& input);

/// One finding for people: two lines, or three, without the last line break.
std::string told(const std::string& file, const lint::Finding& finding);

/// The same for programs.
nlohmann::ordered_json to_json(const lint::Finding& finding);

}  // namespace contactscope::app
