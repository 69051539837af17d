#include <iostream>
#include <nlohmann/json.hpp>

#include "app/cli/faults.h"
#include "app/cli/narrow.h"
#include "app/cli/verbs.h"
#include "core/input_error.h"
#include "core/key_table.h"
#include "snapshot/store.h"

namespace contactscope::app {
namespace {

constexpr const char* kSchema = "contactscope.lint/1";

/// How often a finding occurs, and how gross it is, by the name of its file and its cause.
struct Known {
  double share = 0, gross = 0;
};
constexpr double kAnySize = 1e9;  // files of earlier versions have no 'gross'
struct AllKnown : std::map<std::pair<std::string, std::string>, Known> {
  bool have_below = false;  // files of earlier versions have no findings below a threshold
};

AllKnown::key_type key_of(const std::string& file, const std::string& cause) {
  return {std::filesystem::path(file).filename().string(), cause};
}
double share(int count, int of) { return of > 0 ? static_cast<double>(count) / of : count; }

/// The findings of a file that --json or --write-known has written: by file, or for any file if they
/// are of one. Throws InputError.
AllKnown known_findings(const std::string& path) {
  AllKnown known;
  if (path.empty()) return known;
  try {
    const std::optional<std::string> text = snapshot::read_text_file(path);
    if (!text) throw std::invalid_argument("there is no such file");
    const auto json = nlohmann::json::parse(*text);
    if (json.at("schema") != kSchema) throw std::invalid_argument("another schema");
    const bool is_one = json.at("files").size() == 1;
    for (const nlohmann::json& file : json.at("files")) {
      known.have_below = known.have_below || file.contains("below");
      for (const char* const list : {"findings", "below"})
        for (const nlohmann::json& one : file.value(list, nlohmann::json::array()))
          known[key_of(is_one ? "" : file.at("file"), one.at("cause"))] = {
              share(one.at("count"), one.value("of", 0)), one.value("gross", kAnySize)};
    }
  } catch (const std::exception& error) {
    throw InputError(path, 1, 1,
                     std::string("no findings of lint can be read here (") + error.what() +
                         "); write them with `contactscope lint RUN.jsonl --write-known FILE`");
  }
  return known;
}

/// One finding for several that differ in their shapes alone, such as hints about margins: adds the
/// names of the next three, and the number of the others.
lint::Finding gathered(const std::vector<lint::Finding>& all, std::size_t first, std::size_t end) {
  lint::Finding one = all[first];
  const std::size_t named = std::min(end, first + 4);
  std::vector<std::string_view> names;
  for (std::size_t i = first + 1; i < named; ++i) names.push_back(all[i].a);
  if (!names.empty())
    one.what += "; likewise of " + quoted_list(names, end == named ? " and " : ", ");
  if (end > named) one.what += " and " + std::to_string(end - named) + " more (--verbose)";
  return one;
}

ExitCode run_lint(const Options& options) {
  const AllKnown known = known_findings(options.known);
  constexpr double kMore = 1.5, kGrosser = 3;  // times as frequent, or as large: a new finding
  constexpr int kChance = 3;       // so many more, below a threshold, are no new finding
  constexpr double kSmall = 0.05;  // relative to the smaller shape; less is never grosser
  const lint::LintOptions linter = linter_options(options);
  bool clean = true;
  std::set<std::string> shapes;
  const auto note_shapes = [&](const auto& all) {
    for (const auto& shape : all) shapes.insert(shape.name);
  };
  nlohmann::ordered_json json{{"schema", kSchema}, {"files", nlohmann::ordered_json::array()}};
  const auto report = [&](const std::string& file, std::vector<lint::Finding> findings) {
    nlohmann::ordered_json one{{"file", file}, {"findings", nlohmann::ordered_json::array()}};
    int known_here = 0, new_here = 0;
    std::size_t printed = 0;  // findings before this one
    for (std::size_t i = 0; i < findings.size(); ++i) {
      lint::Finding& finding = findings[i];
      auto before = known.find(key_of(file, finding.cause));
      if (before == known.end()) before = known.find(key_of("", finding.cause));
      const Known was = before == known.end() ? Known() : before->second;
      if (!finding.below.empty() && known.have_below &&
          finding.count > kMore * was.share * std::max(finding.of, 1) + kChance) {
        finding.below.clear();
        finding.what += ", more often than " + options.known + " knows it";
      }
      const bool is_fault = lint::is_reported(finding);
      const bool is_known = is_fault && before != known.end() &&
                            share(finding.count, finding.of) <= kMore * was.share &&
                            finding.gross <= std::max(kSmall, kGrosser * was.gross);
      nlohmann::ordered_json entry = to_json(finding);
      if (is_known) entry["known"] = true;
      one[is_fault ? "findings" : finding.is_hint ? "hints" : "below"].push_back(entry);
      known_here += is_known;
      new_here += is_fault && !is_known;
      const bool is_shown = is_fault ? !is_known : !options.quiet;
      if (options.json || !is_shown || i < printed) continue;
      const auto is_another = [&](const lint::Finding& other) {
        return other.cause != finding.cause || other.remedy != finding.remedy || !other.b.empty();
      };
      const auto end =
          std::find_if(findings.begin() + std::ptrdiff_t(i + 1), findings.end(), is_another);
      printed = options.verbose || !finding.b.empty() ? i + 1 : std::size_t(end - findings.begin());
      std::cout << record(file, gathered(findings, i, printed)) << '\n';
    }
    clean = clean && new_here == 0;
    json["files"].push_back(one);
    if (options.json || options.quiet || (new_here > 0 && known_here == 0)) return;
    std::cout << (new_here > 0 ? counted(new_here, "new finding") + "  " : "ok  ") << file;
    if (known_here > 0) std::cout << ", " << counted(known_here, "known finding");
    std::cout << '\n';
  };
  each_input(
      options,
      [&](const Input& input) {
        note_shapes(input.scenario.shapes);
        report(input.scenario.path, lint_scenario(input.scenario, input.frames, linter));
      },
      [&](TraceFile& file) {
        report(file.name(), lint_trace(file, linter, options.frames));
        note_shapes(file.header().shapes);
      });
  for (const lint::Ignored& one : linter.ignored)
    if (!one.shape.empty()) require_shape({shapes.begin(), shapes.end()}, "--ignore", one.shape);
  if (options.json) std::cout << json.dump() << '\n';
  if (!options.write_known.empty()) {
    for (nlohmann::ordered_json& file : json["files"]) {
      file.erase("hints");
      if (!file.contains("below")) file["below"] = nlohmann::ordered_json::array();
      for (const char* const list : {"findings", "below"})
        for (nlohmann::ordered_json& one : file[list]) one.erase("marks");
    }
    snapshot::write_text(options.write_known, json.dump(1) + "\n");
    return ExitCode::Same;
  }
  return clean ? ExitCode::Same : ExitCode::Different;
}

}  // namespace

Verb lint_verb() {
  return {"lint", "Check the contacts in a trace against its own shapes and poses", &run_lint};
}

}  // namespace contactscope::app
