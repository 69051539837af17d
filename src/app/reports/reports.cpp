#include <algorithm>

#include "app/origin.h"
#include "app/reports/rows.h"

namespace contactscope::app {

const std::vector<Report>& reports() {
  static const std::vector<Report> all = {kTerminalReport, kJsonReport, kJunitReport, kGithubReport,
                                          kMarkdownReport};
  return all;
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

std::string accept_command(const Told& told, const std::string& keys) {
  return "contactscope check --accept " + keys + out_argument(told);
}

std::string remedy(const Told& told, const snapshot::Finding& finding) {
  if (finding.is_acceptable()) return accept_command(told, finding.key());
  if (finding.file.empty()) return "mend the expectation in its scenario, or what fails it";
  return "mend what brings it back, or remove " + told.outcome.snapshots + "/" + finding.file +
         " where it is right after all";
}

std::string remedy(const Told& told, const snapshot::Cause& cause) {
  constexpr std::size_t kMostNames = 12;
  const snapshot::Finding& first = *cause.findings.front();
  if (!first.is_acceptable()) return remedy(told, first);
  std::string names;
  for (std::size_t i = 0; i < std::min(cause.scenarios.size(), kMostNames); ++i)
    names += (i == 0 ? "" : " ") + cause.scenarios[i];
  return accept_command(told, names);
}

}  // namespace contactscope::app
