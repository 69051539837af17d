#pragma once

#include <map>
#include <string>
#include <vector>

#include "app/cli/verbs.h"

namespace contactscope::app {

/// `versus --rollout`: each engine steps the scenarios itself. Prints a table and draws a picture
/// per scenario, or prints JSON. `programs` are by engine name, without this program.
ExitCode run_rollout(const Options& options, const std::vector<std::string>& engines,
                     const std::map<std::string, std::string>& programs);

}  // namespace contactscope::app
