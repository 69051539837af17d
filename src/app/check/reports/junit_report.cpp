#include <sstream>

#include "app/check/reports/report.h"
#include "snapshot/store.h"
#include "vector/markup.h"

namespace contactscope::app {
namespace {

using snapshot::Finding;
using snapshot::ScenarioOutcome;

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

}  // namespace

const Report kJunitReport{[](const ReportInput& input) { return !input.options.junit.empty(); },
                          &report_junit};

}  // namespace contactscope::app
