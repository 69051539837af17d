#pragma once

#include "app/check/reports/report.h"

namespace contactscope::app {

// Each is defined in the file of its name.
extern const Report kPageReport, kTerminalReport, kJsonReport, kJunitReport, kGithubReport,
    kMarkdownReport;

}  // namespace contactscope::app
