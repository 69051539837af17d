#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "app/verbs.h"
#include "snapshot/finding.h"

/// Who is told what a check found: a row each in reports.cpp, a file each beside it. All of them read the Outcome and the
/// folder of its candidates, and nothing else.
namespace contactscope::app {

struct Told {
  const snapshot::Outcome& outcome;
  std::filesystem::path folder;  // of findings.json, as the reader names it
  const Options& options;
};

struct Report {
  std::string_view name;
  /// Whether somebody asked for it.
  bool (*is_wanted)(const Told& told);
  void (*tell)(const Told& told);
};

const std::vector<Report>& reports();

/// Of a verb that ran or read a check: Trouble where a scenario could not be read, whatever else differs.
ExitCode exit_code(const snapshot::Outcome& outcome);

/// Tells everybody who asked.
void tell_all(const Told& told);

/// A path below the folder of the report, as the shell where we run would name it.
std::string path_in(const Told& told, const std::string& file);

/// " --out DIR" where commands on this report need it, else nothing.
std::string out_argument(const Told& told);

/// The shell command that accepts findings by their keys, or all of some folders.
std::string accept_command(const Told& told, const std::vector<std::string>& keys);

/// What to do about one finding: the command that accepts it, or a sentence where none does.
std::string remedy(const Told& told, const snapshot::Finding& finding);

/// The same for all findings of a cause, of which the first one tells.
std::string remedy(const Told& told, const snapshot::Cause& cause);

/// Writes report.html into the folder of the report, before that is put in its place; and again after a review.
void retell_page(const std::filesystem::path& folder, const snapshot::Outcome& outcome,
                 const Options& options);

}  // namespace contactscope::app
