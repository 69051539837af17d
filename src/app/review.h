#pragma once

#include <filesystem>
#include <vector>

#include "app/verbs.h"
#include "snapshot/finding.h"

namespace contactscope::app {

/// Where a check leaves its report.
std::filesystem::path report_folder(const Options& options);

/// Those that any of the patterns names, each once. Throws UsageError for a pattern that names none.
std::vector<snapshot::Finding*> findings_named(snapshot::Outcome& outcome,
                                               const std::vector<std::string>& patterns);

/// `check --accept PATTERN...`: stores candidates of the last report, without running anything.
ExitCode run_accept(const Options& options);

}  // namespace contactscope::app
