#include <iostream>

#include "app/check/reports/report.h"
#include "app/render/figure_canvas.h"
#include "snapshot/report_folder.h"

namespace contactscope::app {

ExitCode exit_code(const snapshot::Outcome& outcome) {
  const snapshot::Tally counts = snapshot::tally(outcome);
  if (counts.kinds[static_cast<std::size_t>(snapshot::FindingKind::UnreadableScenario)] > 0)
    return ExitCode::Trouble;
  return counts.failing == 0 ? ExitCode::Same : ExitCode::Different;
}

void write_reports(const ReportInput& input) {
  const Options& options = input.options;
  if (options.json)
    std::cout << snapshot::to_json(input.outcome);
  else
    report_terminal(input);
  if (!options.junit.empty()) report_junit(input);
  if (options.github) report_github(input);
  if (!options.markdown.empty()) report_markdown(input);
}

std::string viewer_path(const std::string& candidate, const std::string& which) {
  if (!candidate.ends_with(".jsonl")) return {};
  return std::filesystem::path(candidate)
      .replace_filename("viewer." + which + ".html")
      .generic_string();
}

std::string path_in(const ReportInput& input, const std::string& file) {
  return (input.folder / file).lexically_normal().generic_string();
}

void rewrite_page(const std::filesystem::path& folder, const snapshot::Outcome& outcome,
                  const Options& options) {
  if (snapshot::tally(outcome).failing > 0 || std::filesystem::exists(folder / "report.html"))
    report_page({outcome, folder, options});
}

std::string out_argument(const ReportInput& input) {
  if (input.options.out == Options().out) return {};
  return " --out " + for_shell(input.options.out);
}

std::string accept_command(const ReportInput& input, const std::vector<std::string>& keys) {
  std::string command = "contactscope check --accept";
  for (const std::string& key : keys) command += " " + for_shell(snapshot::pattern_of(key));
  return command + out_argument(input);
}

std::string remedy(const ReportInput& input, const snapshot::Finding& finding) {
  if (finding.is_acceptable()) return accept_command(input, {finding.key()});
  if (finding.kind == snapshot::FindingKind::UnreadableScenario)
    return "fix the file, and run check again; its snapshots were not changed";
  if (finding.file.empty())
    return "fix the expectation in its scenario, or the cause of the failure";
  return "fix the bug that came back, or remove " + input.outcome.snapshots + "/" + finding.file +
         " if the result is right";
}

std::string remedy(const ReportInput& input, const snapshot::Cause& cause) {
  constexpr std::size_t kMaxNames = 12;
  const snapshot::Finding& first = *cause.findings.front();
  if (!first.is_acceptable()) return remedy(input, first);
  std::vector<std::string> names = cause.scenarios;
  names.resize(std::min(names.size(), kMaxNames));
  return accept_command(input, names);
}

}  // namespace contactscope::app
