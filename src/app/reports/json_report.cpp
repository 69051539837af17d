#include <iostream>

#include "app/reports/rows.h"
#include "snapshot/outcome_json.h"

namespace contactscope::app {

/// Prints findings.json to standard output.
const Report kJsonReport{"json", [](const Told& told) { return told.options.json; },
                         [](const Told& told) { std::cout << snapshot::to_json(told.outcome); }};

}  // namespace contactscope::app
