#include <iostream>

#include "app/check/reports/report.h"
#include "snapshot/store.h"
#include "vector/svg.h"

namespace contactscope::app {
namespace {

using snapshot::Cause;
using snapshot::Finding;
using snapshot::ScenarioOutcome;

/// Escapes for workflow commands: "docs.github.com, Workflow commands for GitHub Actions".
std::string escaped(const std::string& text, bool is_property) {
  const std::string_view special = is_property ? "%\n\r:," : "%\n\r";
  std::string all;
  for (const char c : text)
    all += special.find(c) == special.npos ? std::string(1, c) : printed("%%%02X", int{c});
  return all;
}

/// "line=22,": sentences of expectations start with "FILE:22: ".
std::string line_in(const std::string& file, const Finding& finding) {
  const std::string begin = file + ":";
  if (!finding.sentence.starts_with(begin)) return {};
  const std::string line = finding.sentence.substr(
      begin.size(), finding.sentence.find_first_not_of("0123456789", begin.size()) - begin.size());
  return line.empty() ? "" : "line=" + line + ",";
}

// $GITHUB_STEP_SUMMARY is limited to one MiB.
constexpr std::size_t kMaxBytes = 900000;

/// A small picture embedded in the text.
std::string inline_picture(const ReportInput& input, const char* what, const std::string& file) {
  if (file.empty() || !file.ends_with(".png")) return "| ";
  constexpr int kWidth = 320;
  const std::vector<std::uint8_t> png =
      encode_png(shrunk(read_png((input.folder / file).string()), kWidth), 9);
  return "| ![" + std::string(what) + "](data:image/png;base64," +
         base64({reinterpret_cast<const char*>(png.data()), png.size()}) + ") ";
}

/// Escapes Markdown characters.
std::string plain(const std::string& text) {
  std::string all;
  for (const char c : text) {
    if (std::string_view("\\`*_{}[]<>#|!").find(c) != std::string_view::npos) all += '\\';
    all += c == '\n' ? ' ' : c;
  }
  return all;
}

/// A name as code, fenced by more backticks than it contains.
std::string code(const std::string& text) {
  std::string fence = "`";
  while (text.find(fence) != std::string::npos) fence += '`';
  const std::string pad = fence.size() > 1 ? " " : "";
  return fence + pad + text + pad + fence;
}

}  // namespace

/// JUnit XML for Jenkins, GitLab and others: a suite per group, a case per scenario. Attachments
/// have the form that the JUnit attachments plugin and GitLab expect.
void report_junit(const ReportInput& input) {
  std::ostringstream out;
  const snapshot::Tally counts = snapshot::tally(input.outcome);
  out << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"contactscope check\" "
         "tests=\""
      << input.outcome.scenarios.size() << "\" failures=\"" << counts.failing << "\">\n";
  std::string group;
  for (std::size_t i = 0; i < input.outcome.scenarios.size(); ++i) {
    const ScenarioOutcome& scenario = input.outcome.scenarios[i];
    const std::size_t slash = scenario.scenario.find('/');
    if (scenario.scenario.substr(0, slash) != group) {
      if (!group.empty()) out << " </testsuite>\n";
      group = scenario.scenario.substr(0, slash);
      int tests = 0, failures = 0;
      for (const ScenarioOutcome& other : input.outcome.scenarios) {
        if (!other.scenario.starts_with(group + "/")) continue;
        ++tests;
        failures += other.fails();
      }
      out << " <testsuite name=\"" << vector::escaped(group) << "\" tests=\"" << tests
          << "\" failures=\"" << failures << "\">\n";
    }
    out << "  <testcase classname=\"" << vector::escaped(group) << "\" name=\""
        << vector::escaped(scenario.scenario.substr(slash + 1)) << "\"";
    if (!scenario.file.empty()) out << " file=\"" << vector::escaped(scenario.file) << "\"";
    out << ">\n";
    std::string pictures, others;  // one per line; GitLab shows the first
    for (const Finding& finding : scenario.findings) {
      if (!finding.fails()) continue;
      out << "   <failure type=\"" << snapshot::name_of(finding.kind) << "\" message=\""
          << vector::escaped(finding.sentence) << "\">";
      for (const std::string& detail : finding.details) out << vector::escaped(detail) << '\n';
      out << vector::escaped(remedy(input, finding)) << "</failure>\n";
      for (const std::string& file : {finding.expected, finding.candidate, finding.difference}) {
        if (file.empty()) continue;
        const std::filesystem::path path = std::filesystem::absolute(input.folder / file);
        (finding.is_picture() ? pictures : others) +=
            "[[ATTACHMENT|" + vector::escaped(path.lexically_normal().string()) + "]]\n";
      }
    }
    if (!pictures.empty() || !others.empty())
      out << "   <system-out>\n" << pictures << others << "</system-out>\n";
    out << "  </testcase>\n";
  }
  if (!group.empty()) out << " </testsuite>\n";
  out << "</testsuites>\n";
  snapshot::write_text(input.options.junit, out.str());
}

/// One annotation per cause at its first scenario's file: a pull request shows only ten.
void report_github(const ReportInput& input) {
  for (const Cause& cause : snapshot::causes(input.outcome)) {
    const Finding& first = *cause.findings.front();
    std::string place;
    for (const ScenarioOutcome& scenario : input.outcome.scenarios)
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

void report_markdown(const ReportInput& input) {
  std::ostringstream out;
  const std::vector<Cause> causes = snapshot::causes(input.outcome);
  out << "## contactscope check\n\n" << snapshot::summary(snapshot::tally(input.outcome)) << "\n";
  std::size_t bytes = 0;
  for (const Cause& cause : causes) {
    const Finding& first = *cause.findings.front();
    out << "\n### " << plain(first.key()) << "\n\n" << plain(first.sentence) << "\n\n";
    if (cause.scenarios.size() > 1) {
      out << "One cause in " << cause.scenarios.size() << " scenarios:";
      for (const std::string& scenario : cause.scenarios) out << " " << code(scenario);
      out << "\n\n";
    }
    for (const Finding* finding : cause.findings) {
      if (!finding->is_picture() || finding->candidate.empty()) continue;
      const std::string row = inline_picture(input, "expected", finding->expected) +
                              inline_picture(input, "actual", finding->candidate) +
                              inline_picture(input, "difference", finding->difference) + "|\n\n";
      if (bytes + row.size() > kMaxBytes) break;
      bytes += row.size();
      out << "| expected | actual | difference |\n|---|---|---|\n" << row;
      break;  // only the largest difference of each cause
    }
    out << (first.is_acceptable() ? "    " + remedy(input, cause) : plain(remedy(input, cause)))
        << "\n";
  }
  snapshot::write_text(input.options.markdown, out.str());
}

}  // namespace contactscope::app
