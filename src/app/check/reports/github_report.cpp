#include <iostream>

#include "app/check/reports/report.h"

namespace contactscope::app {
namespace {

/// Escapes for workflow commands: "docs.github.com, Workflow commands for GitHub Actions".
std::string escaped(const std::string& text, bool is_property) {
  std::string all;
  for (const char c : text) {
    if (c == '%')
      all += "%25";
    else if (c == '\n')
      all += "%0A";
    else if (c == '\r')
      all += "%0D";
    else if (is_property && c == ':')
      all += "%3A";
    else if (is_property && c == ',')
      all += "%2C";
    else
      all += c;
  }
  return all;
}

/// "line=22,": sentences of expectations start with "FILE:22: ".
std::string line_in(const std::string& file, const snapshot::Finding& finding) {
  const std::string begin = file + ":";
  if (!finding.sentence.starts_with(begin)) return {};
  const std::string line = finding.sentence.substr(
      begin.size(), finding.sentence.find_first_not_of("0123456789", begin.size()) - begin.size());
  return line.empty() ? "" : "line=" + line + ",";
}

/// One annotation per cause at its first scenario's file: a pull request shows only ten.
void report_github(const ReportInput& input) {
  for (const snapshot::Cause& cause : snapshot::causes(input.outcome)) {
    const snapshot::Finding& first = *cause.findings.front();
    std::string place;
    for (const snapshot::ScenarioOutcome& scenario : input.outcome.scenarios)
      if (scenario.scenario == first.scenario && !scenario.file.empty())
        place = "file=" + escaped(scenario.file, true) + "," + line_in(scenario.file, first);
    std::string text = first.sentence;
    if (cause.scenarios.size() > 1)
      text += "\nthe same cause in " + std::to_string(cause.scenarios.size()) + " scenarios";
    text += "\n" + remedy(input, cause);
    std::cout << "::error " << place << "title=" << escaped(first.key(), true)
              << "::" << escaped(text, false) << '\n';
  }
}

}  // namespace

const Report kGithubReport{[](const ReportInput& input) { return input.options.github; },
                           &report_github};

}  // namespace contactscope::app
