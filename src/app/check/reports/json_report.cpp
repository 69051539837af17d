#include <iostream>

#include "app/check/reports/rows.h"
#include "snapshot/outcome_json.h"

namespace contactscope::app {

/// Prints findings.json to standard output.
const Report kJsonReport{
    "json", [](const ReportInput& input) { return input.options.json; },
    [](const ReportInput& input) { std::cout << snapshot::to_json(input.outcome); }};

}  // namespace contactscope::app
