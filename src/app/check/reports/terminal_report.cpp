#include <iomanip>
#include <iostream>

#include "app/check/reports/report.h"

namespace contactscope::app {
namespace {

using snapshot::Cause;
using snapshot::Finding;
using snapshot::FindingKind;
using snapshot::ScenarioOutcome;

constexpr int kIndent = 12;

void put_line(const std::string& begin, const std::string& text) {
  std::cout << std::left << std::setw(kIndent) << begin << text << '\n';
}

std::string kind_in_words(const Finding& finding) {
  std::string name(snapshot::name_of(finding.kind));
  std::ranges::replace(name, '_', ' ');
  return name == "unmet expectation" || name == "unreadable scenario"
             ? name.substr(0, name.find(' '))
             : name;
}

std::string list_of(const std::vector<std::string>& names, std::size_t most) {
  std::string text = separated(std::span(names).first(std::min(most, names.size())), ", ");
  if (names.size() > most) text += " and " + std::to_string(names.size() - most) + " more";
  return text;
}

/// Prints a cause: its sentence and the other affected scenarios.
void put_cause(const Cause& cause, bool is_verbose) {
  constexpr std::size_t kMaxSentences = 5, kMaxNames = 12;
  const Finding& first = *cause.findings.front();
  put_line(kind_in_words(first), first.sentence);
  if (cause.scenarios.size() > 1) {
    int pictures = 0;
    for (const Finding* finding : cause.findings) pictures += finding->is_picture();
    put_line("", "the same cause in " + counted(cause.scenarios.size(), "scenario") +
                     (pictures > 0 ? " and " + counted(pictures, "picture") : "") + ": " +
                     list_of(cause.scenarios, is_verbose ? cause.scenarios.size() : kMaxNames));
  }
  // New, missing and orphaned files all have the same message.
  const bool is_of_files = first.kind == FindingKind::New || first.kind == FindingKind::Missing ||
                           first.kind == FindingKind::Orphaned;
  const bool is_reported_once = is_of_files || cause.scenarios.size() > 1;
  const std::size_t most = is_verbose         ? cause.findings.size()
                           : is_reported_once ? 1
                                              : kMaxSentences;
  for (std::size_t i = 0; i < cause.findings.size() && i < most; ++i) {
    const Finding& finding = *cause.findings[i];
    if (i > 0) put_line("", finding.sentence);
    const bool is_named = finding.kind == FindingKind::UnmetExpectation || is_verbose ||
                          (finding.pixels && finding.pixels->allowed != PixelLimits{});
    for (const std::string& detail : finding.details)
      if (is_named && detail != finding.sentence) put_line("", "  " + detail);
  }
  if (most < cause.findings.size() && cause.scenarios.size() == 1 && first.kind != FindingKind::New)
    put_line("", "and " + std::to_string(cause.findings.size() - most) + " more of it");
}

/// "stored  crates/beam, 6 files" or "updated  crates/beam, 6 files, 1 of them new and 2 removed".
void print_written(const ScenarioOutcome& scenario) {
  using snapshot::Done;
  const auto count = [&](Done done) {
    return static_cast<int>(std::ranges::count(scenario.findings, done, &Finding::done));
  };
  const int stored = count(Done::Written), removed = count(Done::Removed);
  const bool is_one = stored == scenario.written || removed == scenario.written;
  std::string text = scenario.scenario + ", " + counted(scenario.written, "file");
  if (!is_one && stored > 0) text += ", " + std::to_string(stored) + " of them new";
  if (!is_one && removed > 0)
    text += (stored > 0 ? " and " : ", ") + std::to_string(removed) + " removed";
  put_line(!is_one ? "updated" : stored > 0 ? "stored" : "removed", text);
}

/// Commands that accept or fix everything.
std::string what_to_do(const ReportInput& input, const snapshot::Tally& counts) {
  const std::vector<Cause> causes = snapshot::causes(input.outcome);
  const auto count = [&](FindingKind kind) { return counts.kinds[static_cast<std::size_t>(kind)]; };
  std::string scenario, fixed;
  for (const Cause& cause : causes)
    for (const Finding* finding : cause.findings) {
      if (scenario.empty() && finding->is_acceptable()) scenario = finding->scenario;
      if (fixed.empty() && !finding->is_acceptable()) fixed = remedy(input, *finding);
    }
  if (scenario.empty()) return fixed;
  const int absent = count(FindingKind::New) + count(FindingKind::Missing);
  const int all = count_of(joined(causes, &Cause::findings));
  const std::string store = "contactscope check --write-missing stores what is missing";
  const std::string review = "contactscope review shows them one by one, " +
                             accept_command(input, {scenario}) + " accepts one";
  return absent == 0 ? review : absent == all ? store : review + ", " + store;
}

/// One line, or with --verbose one per decision.
void print_brittle(const snapshot::Outcome& outcome, bool is_verbose) {
  int decisions = 0, scenarios = 0;
  for (const ScenarioOutcome& scenario : outcome.scenarios) {
    decisions += static_cast<int>(scenario.brittle.size());
    scenarios += !scenario.brittle.empty();
    for (const std::string& sentence : scenario.brittle)
      if (is_verbose) std::cerr << scenario.scenario << ": " << sentence << '\n';
  }
  if (decisions == 0 || is_verbose) return;
  std::cerr << counted(decisions, "decision") << " in " << counted(scenarios, "scenario")
            << (decisions == 1 ? " is" : " are")
            << " within rounding: another machine may decide differently; --verbose lists "
            << (decisions == 1 ? "it" : "them") << '\n';
}

}  // namespace

void report_terminal(const ReportInput& input) {
  const snapshot::Outcome& outcome = input.outcome;
  const Options& options = input.options;
  for (const ScenarioOutcome& scenario : outcome.scenarios) {
    if (scenario.fails()) continue;
    if (scenario.written > 0 && !options.quiet)
      print_written(scenario);
    else if (options.verbose)
      put_line("same", scenario.scenario);
  }
  for (const Cause& cause : snapshot::causes(outcome)) put_cause(cause, options.verbose);
  const snapshot::Tally counts = snapshot::tally(outcome);
  std::cout.flush();
  if (options.quiet) return;
  print_brittle(outcome, options.verbose);
  std::vector<std::string> notes;
  for (const ScenarioOutcome& scenario : outcome.scenarios)
    for (const std::string& note : scenario.notes) notes.push_back(scenario.scenario + ": " + note);
  const std::size_t most = options.verbose ? notes.size() : 3;
  for (std::size_t i = 0; i < notes.size() && i < most; ++i) std::cerr << notes[i] << '\n';
  if (most < notes.size()) std::cerr << "and " << notes.size() - most << " more such notes\n";
  std::cerr << snapshot::summary(counts) << '\n';
  if (counts.failing == 0) return;
  std::cerr << "see " << path_in(input, "report.html") << "; " << what_to_do(input, counts) << '\n';
}

}  // namespace contactscope::app
