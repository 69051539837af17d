#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "app/cli/verbs.h"
#include "snapshot/finding.h"

namespace contactscope::app {

/// Folder of a check's report.
std::filesystem::path report_folder(const Options& options);

/// Findings that match the patterns, each once. Throws UsageError if a pattern matches none.
std::vector<snapshot::Finding*> findings_named(snapshot::Outcome& outcome,
                                               const std::vector<std::string>& patterns);

/// `check --accept PATTERN...`: stores candidates of the last report, without running anything.
ExitCode run_accept(const Options& options);

enum class TerminalPictures { None, HalfBlocks, Kitty };

/// Capability of the terminal on standard output, by its environment; None without a terminal.
TerminalPictures terminal_pictures();

/// Prints a finding with its details, and its pictures or their paths.
void show(const snapshot::Finding& finding, const std::string& folder, TerminalPictures how,
          std::ostream& out);

}  // namespace contactscope::app
