#pragma once

#include <map>
#include <string>
#include <vector>

#include "app/verbs.h"

namespace contactscope::app {

/// `versus --rollout`: each engine steps the scenarios by itself. A table and a picture a scenario, or JSON.
/// `programs`: of each engine but this program, by its name.
ExitCode run_rollout(const Options& options, const std::vector<std::string>& engines,
                     const std::map<std::string, std::string>& programs);

}  // namespace contactscope::app
