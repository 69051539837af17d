#pragma once

#include "app/cli/verbs.h"

/// Report formats of `check`. They read only the Outcome and the folder of its candidates.
namespace contactscope::app {

struct ReportInput {
  const snapshot::Outcome& outcome;
  std::filesystem::path folder;  // of findings.json, as the user named it
  const Options& options;
};

using Report = void(const ReportInput& input);
Report report_page, report_terminal, report_junit, report_github, report_markdown;

/// For verbs that run or read a check. Trouble if a scenario is unreadable, even if others differ.
ExitCode exit_code(const snapshot::Outcome& outcome);

/// Writes all requested reports.
void write_reports(const ReportInput& input);

/// Path of a page in 3D next to a candidate trace; `which`: "actual" or "expected". Empty for
/// other candidates.
std::string viewer_path(const std::string& candidate, const std::string& which);

/// Path of a file in the report folder, relative to the current directory.
std::string path_in(const ReportInput& input, const std::string& file);

/// " --out DIR" if commands on this report need it, else empty.
std::string out_argument(const ReportInput& input);

/// Shell command that accepts findings by keys, or whole folders of them.
std::string accept_command(const ReportInput& input, const std::vector<std::string>& keys);

/// Remedy for one finding: the command that accepts it, or a sentence.
std::string remedy(const ReportInput& input, const snapshot::Finding& finding);

/// Remedy for all findings of a cause, described by the first.
std::string remedy(const ReportInput& input, const snapshot::Cause& cause);

/// Writes report.html into the report folder: before it is published, and after a review.
void rewrite_page(const std::filesystem::path& folder, const snapshot::Outcome& outcome,
                  const Options& options);

}  // namespace contactscope::app
