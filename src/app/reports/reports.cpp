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

std::string accept_command(const Told& told, const std::string& keys) {
  std::string command = "contactscope check --accept " + keys;
  if (told.options.out != Options().out) command += " --out " + for_shell(told.options.out);
  return command;
}

}  // namespace contactscope::app
