#include <iostream>
#include <nlohmann/json.hpp>

#include "app/cli/faults.h"
#include "app/cli/narrow.h"
#include "snapshot/store.h"

namespace contactscope::app {
namespace {

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
  const KnownFindings known(options);
  const lint::LintOptions linter = linter_options(options);
  bool clean = true;
  std::set<std::string> shapes;
  const auto note_shapes = [&](const auto& all) {
    for (const auto& shape : all) shapes.insert(shape.name);
  };
  nlohmann::ordered_json json{{"schema", kLintSchema}, {"files", nlohmann::ordered_json::array()}};
  const auto report = [&](const std::string& file, std::vector<lint::Finding> findings) {
    nlohmann::ordered_json one{{"file", file}, {"findings", nlohmann::ordered_json::array()}};
    int known_here = 0, new_here = 0;
    std::size_t printed = 0;  // findings before this one
    for (std::size_t i = 0; i < findings.size(); ++i) {
      lint::Finding& finding = findings[i];
      const bool knows = known.knows(file, finding), is_fault = lint::is_reported(finding);
      const bool is_known = is_fault && knows;
      nlohmann::ordered_json entry = to_json(finding);
      if (is_known) entry["known"] = true;
      if (!options.write_known.empty())
        for (const lint::OfPair& pair : finding.pairs)
          entry["pairs"].push_back({pair.a, pair.b, pair.count});
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
        if (options.frames && !options.quiet)
          std::cerr
              << "note: only these frames are read, so changes from and to others are not seen\n";
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
