#include <algorithm>

#include "app/origin.h"
#include "app/reports/rows.h"
#include "snapshot/accept.h"

namespace contactscope::app {

const std::vector<Report>& reports() {
  static const std::vector<Report> all = {kTerminalReport, kJsonReport, kJunitReport, kGithubReport,
                                          kMarkdownReport};
  return all;
}

ExitCode exit_code(const snapshot::Outcome& outcome) {
  const snapshot::Tally counts = snapshot::tally(outcome);
  if (counts.kinds[static_cast<std::size_t>(snapshot::FindingKind::UnreadableScenario)] > 0)
    return ExitCode::Trouble;
  return counts.failing == 0 ? ExitCode::Same : ExitCode::Different;
}

void tell_all(const Told& told) {
  for (const Report& report : reports())
    if (report.is_wanted(told)) report.tell(told);
}

std::string path_in(const Told& told, const std::string& file) {
  return (told.folder / file).lexically_normal().generic_string();
}

void retell_page(const std::filesystem::path& folder, const snapshot::Outcome& outcome,
                 const Options& options) {
  const Told told{outcome, folder, options};
  if (kPageReport.is_wanted(told)) kPageReport.tell(told);
}

std::string out_argument(const Told& told) {
  if (told.options.out == Options().out) return {};
  return " --out " + for_shell(told.options.out);
}

std::string accept_command(const Told& told, const std::vector<std::string>& keys) {
  std::string command = "contactscope check --accept";
  for (const std::string& key : keys) command += " " + for_shell(snapshot::pattern_of(key));
  return command + out_argument(told);
}

std::string remedy(const Told& told, const snapshot::Finding& finding) {
  if (finding.is_acceptable()) return accept_command(told, {finding.key()});
  if (finding.kind == snapshot::FindingKind::UnreadableScenario)
    return "fix the file, and run check again; what is stored of it was left as it is";
  if (finding.file.empty()) return "mend the expectation in its scenario, or what fails it";
  return "mend what brings it back, or remove " + told.outcome.snapshots + "/" + finding.file +
         " where it is right after all";
}

std::string remedy(const Told& told, const snapshot::Cause& cause) {
  constexpr std::size_t kMostNames = 12;
  const snapshot::Finding& first = *cause.findings.front();
  if (!first.is_acceptable()) return remedy(told, first);
  std::vector<std::string> names = cause.scenarios;
  names.resize(std::min(names.size(), kMostNames));
  return accept_command(told, names);
}

}  // namespace contactscope::app
