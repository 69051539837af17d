#include "snapshot/finding.h"

namespace contactscope::snapshot {
namespace {

/// Order of reports: expectations, then facts, then pictures by the size of their difference.
int weight(const Finding& finding) {
  if (finding.kind == FindingKind::UnmetExpectation ||
      finding.kind == FindingKind::UnreadableScenario)
    return 1 << 30;
  if (!finding.is_picture()) return 1 << 29;
  return finding.pixels ? finding.pixels->differing : 0;
}

int largest(const Cause& cause) {
  int most = 0;
  for (const Finding* finding : cause.findings)
    if (finding->pixels) most = std::max(most, finding->pixels->differing);
  return most;
}

/// More scenarios than an author edits by hand: then the program reads or builds them differently.
constexpr std::size_t kMaxEdited = 5;

/// Splits a cause by scenario.
std::vector<Cause> by_scenario(const Cause& cause) {
  std::vector<Cause> all;
  for (const std::string& scenario : cause.scenarios) {
    Cause& own = all.emplace_back();
    own.scenarios = {scenario};
    std::ranges::copy_if(cause.findings, std::back_inserter(own.findings),
                         [&](const Finding* finding) { return finding->scenario == scenario; });
  }
  return all;
}

}  // namespace

Tally tally(const Outcome& outcome) {
  Tally tally;
  for (const ScenarioOutcome& scenario : outcome.scenarios) {
    const bool is_there = !scenario.file.empty();
    tally.scenarios += is_there;
    tally.failing += scenario.fails();
    tally.without_file += scenario.fails() && !is_there;
    tally.same += is_there && scenario.findings.empty();
    tally.frames += scenario.frames;
    tally.pictures += scenario.pictures;
    tally.written += scenario.written;
    for (const Finding& finding : scenario.findings) {
      tally.accepted += finding.review == Review::Accepted;
      if (!finding.fails()) continue;
      ++tally.kinds[static_cast<std::size_t>(finding.kind)];
      tally.rejected += finding.review == Review::Rejected;
    }
  }
  return tally;
}

std::string summary(const Tally& tally) {
  const int own = tally.failing - tally.without_file;
  std::string text = counted(tally.scenarios, "scenario") + ": ";
  text += tally.failing == 0 && tally.same == tally.scenarios
              ? "all the same"
              : std::to_string(tally.same) + " the same, " + std::to_string(own) +
                    (own == 1 ? " fails" : " fail");
  if (tally.without_file > 0)
    text += ", " + std::to_string(tally.without_file) + " more stored without a file";
  if (tally.failing > 0) {
    std::string kinds;
    for (std::size_t kind = 0; kind < kFindingKinds.size(); ++kind) {
      const bool is_rare = kind == static_cast<std::size_t>(FindingKind::UnreadableScenario);
      if (is_rare && tally.kinds[kind] == 0) continue;
      std::string name(kFindingKinds[kind]);
      std::ranges::replace(name, '_', ' ');
      if ((is_rare || name == "unmet expectation") && tally.kinds[kind] != 1) name += "s";
      kinds += (kinds.empty() ? "" : ", ") + std::to_string(tally.kinds[kind]) + " " + name;
    }
    text += " (" + kinds + ")";
  }
  if (tally.accepted > 0) text += ", " + std::to_string(tally.accepted) + " accepted";
  if (tally.rejected > 0) text += ", " + std::to_string(tally.rejected) + " rejected";
  if (tally.written > 0) text += ", " + counted(tally.written, "file") + " written or removed";
  return text;
}

std::vector<Cause> causes(const Outcome& outcome) {
  std::map<std::string, Cause> by_cause;
  for (const ScenarioOutcome& scenario : outcome.scenarios) {
    for (const Finding& finding : scenario.findings) {
      if (!finding.fails()) continue;
      Cause& cause = by_cause[finding.cause];
      cause.findings.push_back(&finding);
      if (cause.scenarios.empty() || cause.scenarios.back() != finding.scenario)
        cause.scenarios.push_back(finding.scenario);
    }
  }
  std::vector<Cause> all;
  for (auto& [name, cause] : by_cause) {
    std::ranges::stable_sort(
        cause.findings, [](const Finding* a, const Finding* b) { return weight(*a) > weight(*b); });
    if (name.starts_with(kInputCause) && cause.scenarios.size() <= kMaxEdited)
      std::ranges::move(by_scenario(cause), std::back_inserter(all));
    else
      all.push_back(std::move(cause));
  }
  std::ranges::stable_sort(all, [](const Cause& a, const Cause& b) {
    if (a.scenarios.size() != b.scenarios.size()) return a.scenarios.size() > b.scenarios.size();
    if (largest(a) != largest(b)) return largest(a) > largest(b);
    return a.findings.front()->key() < b.findings.front()->key();
  });
  return all;
}

}  // namespace contactscope::snapshot
