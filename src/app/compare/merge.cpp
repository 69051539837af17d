#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "app/check/reports/report.h"
#include "app/check/review.h"
#include "app/cli/verbs.h"
#include "app/render/origin.h"
#include "core/input_error.h"
#include "snapshot/report_folder.h"
#include "snapshot/store.h"

namespace contactscope::app {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct Part {
  std::string from;  // folder
  snapshot::Outcome outcome;
  snapshot::Shard shard{};
};

/// Shard reports in an --out folder, or the folder itself if it is a report.
std::vector<fs::path> reports_in(const std::string& name) {
  if (fs::exists(fs::path(name) / "findings.json")) return {name};
  std::vector<fs::path> folders;
  if (fs::is_directory(name)) {
    for (const fs::directory_entry& entry : fs::directory_iterator(name))
      if (entry.path().filename().string().starts_with("check_") &&
          fs::exists(entry.path() / "findings.json"))
        folders.push_back(entry.path());
  }
  if (folders.empty())
    throw InputError(
        name, 0, 0,
        "there is no report of a shard here; write one with contactscope check --shard 1/4 --out " +
            for_shell(name));
  std::ranges::sort(folders);
  return folders;
}

std::vector<Part> read_parts(const std::vector<std::string>& names) {
  std::vector<Part> parts;
  for (const std::string& name : names) {
    for (const fs::path& folder : reports_in(name)) {
      Part& part = parts.emplace_back();
      part.from = folder.generic_string();
      part.outcome = snapshot::read_outcome(folder);
      if (!part.outcome.shard)
        throw InputError(part.from, 0, 0, "this is the report of a whole run, not of a shard");
      part.shard = *part.outcome.shard;
    }
  }
  std::ranges::sort(parts, {}, [](const Part& part) { return part.shard.part; });
  return parts;
}

void require_every_shard(const std::vector<Part>& parts) {
  const int shards = parts.front().shard.of;
  const auto name = [&](int part) {
    return "shard " + std::to_string(part) + " of " + std::to_string(shards);
  };
  int wanted = 1;
  for (const Part& one : parts) {
    if (one.shard.part < wanted)
      throw UsageError(name(one.shard.part) + " is there twice, in " + one.from + " too");
    if (one.shard.part > wanted) break;
    ++wanted;
  }
  if (wanted <= shards) throw UsageError(name(wanted) + " is missing");
}

/// Checks that all shards of one run are present, each shard and scenario once. Throws UsageError.
void require_whole(const std::vector<Part>& parts) {
  const snapshot::Outcome& first = parts.front().outcome;
  for (const Part& part : parts) {
    const snapshot::Outcome& outcome = part.outcome;
    const std::string both = part.from + " and " + parts.front().from + " are ";
    if (part.shard.of != parts.front().shard.of || outcome.all != first.all ||
        outcome.snapshots != first.snapshots || outcome.facts_only != first.facts_only)
      throw UsageError(both +
                       "reports of different commands, so they are not parts of one run; run all "
                       "shards on the same files with the same options");
    if (outcome.made_of != first.made_of)
      throw UsageError(both +
                       "from different programs or scenario files, so one of them is from an "
                       "earlier run; run its shard again");
  }
  require_every_shard(parts);
  std::map<std::string, std::string> owners;
  for (const Part& part : parts)
    for (const snapshot::ScenarioOutcome& scenario : part.outcome.scenarios) {
      const auto [owner, is_new] = owners.emplace(scenario.scenario, part.from);
      if (!is_new)
        throw UsageError(scenario.scenario + " is in " + owner->second + " and in " + part.from +
                         "; the shards had different --times");
    }
  for (const std::string& name : first.all)
    if (!owners.contains(name))
      throw UsageError(name + " is in no shard; they had different --times");
}

ExitCode run_merge(const Options& options) {
  const std::vector<Part> parts = read_parts(options.scenarios);
  require_whole(parts);
  snapshot::ReportFolder report(options.out);
  snapshot::Outcome outcome{parts.front().outcome.snapshots, parts.front().outcome.facts_only};
  Json times = Json::object();
  for (const Part& part : parts) {
    for (const snapshot::ScenarioOutcome& scenario : part.outcome.scenarios) {
      outcome.scenarios.push_back(scenario);
      for (const snapshot::Finding& finding : scenario.findings) {
        for (const std::string& file :
             {finding.candidate, finding.expected, finding.difference, finding.layers_picture})
          if (!file.empty()) report.copy_file(fs::path(part.from) / file, file);
        for (const char* which : {"actual", "expected"}) {
          const std::string viewer = viewer_path(finding.candidate, which);
          if (!viewer.empty() && fs::exists(fs::path(part.from) / viewer))
            report.copy_file(fs::path(part.from) / viewer, viewer);
        }
      }
    }
    if (const auto text = snapshot::read_text_file(fs::path(part.from) / "times.json"))
      times.update(Json::parse(*text));
  }
  std::ranges::stable_sort(outcome.scenarios, {}, &snapshot::ScenarioOutcome::scenario);
  report.add_file("times.json", times.dump(1) + "\n");
  rewrite_page(report.aside(), outcome, options);
  report.publish(outcome);
  write_reports({outcome, report_folder(options), options});
  return exit_code(outcome);
}

}  // namespace

Verb merge_verb() {
  return {
      "merge", "Join the parts of check --shard", &run_merge,
      "Examples:\n"
      "  contactscope merge shards --out out --junit junit.xml\n"
      "Exit codes: 0 no difference, 1 a difference, 2 an error, such as a part that is missing."};
}

}  // namespace contactscope::app
