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

}  // namespace contactscope::app
