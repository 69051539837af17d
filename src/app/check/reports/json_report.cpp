#include <iostream>

#include "app/check/reports/report.h"
#include "snapshot/outcome_json.h"

namespace contactscope::app {

/// Prints findings.json to standard output.
const Report kJsonReport{
    [](const ReportInput& input) { return input.options.json; },
    [](const ReportInput& input) { std::cout << snapshot::to_json(input.outcome); }};

}  // namespace contactscope::app
