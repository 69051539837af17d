#include "app/check/lint.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>

#include "app/cli/narrow.h"
#include "app/cli/progress.h"
#include "app/cli/verbs.h"
#include "core/at.h"
#include "core/input_error.h"
#include "core/key_table.h"
#include "scenario/run.h"
#include "snapshot/store.h"

namespace contactscope::app {

std::string record(const std::string& file, const lint::Finding& finding) {
  std::string text = file + ":" + std::to_string(std::max(finding.line, 1)) +
                     ":1: " + (finding.is_hint ? "hint: " : "") + finding.what;
  if (finding.of > 0)
    text += ", " + std::to_string(finding.count) + " of " + std::to_string(finding.of);
  else if (finding.count > 1)
    text += ", " + std::to_string(finding.count) + " times";
  if (!finding.below.empty())
    text += ", below the " + finding.below + " that is reported; --strict reports all";
  text += " [" + finding.cause + "]";
  if (!finding.below.empty()) return text;
  if (!finding.a.empty()) {
    text += "\n  frame " + std::to_string(finding.frame) + ", " + finding.a +
            (finding.b.empty() ? "" : "-" + finding.b);
    if (!finding.said.empty()) text += ": " + finding.said;
    if (!finding.is.empty()) text += "; " + finding.is;
  }
  return text + "\n  " + finding.remedy;
}

nlohmann::ordered_json to_json(const lint::Finding& finding) {
  nlohmann::ordered_json json{{"cause", finding.cause},
                              {"what", finding.what},
                              {"remedy", finding.remedy},
                              {"count", finding.count}};
  if (finding.of > 0) json["of"] = finding.of;
  json["gross"] = std::round(1000 * finding.gross) / 1000;
  if (finding.line > 0) json["line"] = finding.line;
  if (!finding.below.empty()) json["below"] = finding.below;
  if (finding.a.empty()) return json;
  json["frame"] = finding.frame;
  json["a"] = finding.a;
  if (!finding.b.empty()) json["b"] = finding.b;
  if (!finding.said.empty()) json["said"] = finding.said;
  if (!finding.is.empty()) json["is"] = finding.is;
  nlohmann::ordered_json& marks = json["marks"] = nlohmann::ordered_json::array();
  for (const lint::Mark& mark : finding.marks) {
    marks.push_back({{"frame", mark.frame}, {"a", mark.a}});
    if (!mark.b.empty()) marks.back()["b"] = mark.b;
  }
  return json;
}

namespace {

constexpr const char* kSchema = "contactscope.lint/1";

/// How often a finding occurs, and how gross it is, by the name of its file and its cause.
struct Known {
  double share = 0, gross = 0;
};
constexpr double kAnySize = 1e9;  // files of earlier versions have no 'gross'
using Shares = std::map<std::pair<std::string, std::string>, Known>;

Shares::key_type key_of(const std::string& file, const std::string& cause) {
  return {std::filesystem::path(file).filename().string(), cause};
}
double share(int count, int of) { return of > 0 ? static_cast<double>(count) / of : count; }

/// The findings of a file that --json or --write-known has written. Throws InputError.
Shares known_findings(const std::string& path) {
  Shares shares;
  if (path.empty()) return shares;
  try {
    const std::optional<std::string> text = snapshot::read_text_file(path);
    if (!text) throw std::invalid_argument("there is no such file");
    const auto json = nlohmann::json::parse(*text);
    if (json.at("schema") != kSchema) throw std::invalid_argument("another schema");
    for (const nlohmann::json& file : json.at("files"))
      for (const nlohmann::json& one : file.at("findings"))
        shares[key_of(file.at("file"), one.at("cause"))] = {
            share(one.at("count"), one.value("of", 0)), one.value("gross", kAnySize)};
  } catch (const std::exception& error) {
    throw InputError(path, 1, 1,
                     std::string("no findings of lint can be read here (") + error.what() +
                         "); write them with `contactscope lint RUN.jsonl --write-known FILE`");
  }
  return shares;
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
  const Shares known = known_findings(options.known);
  constexpr double kMore = 1.5, kGrosser = 3;  // times as frequent, or as large: a new finding
  constexpr double kSmall = 0.05;  // relative to the smaller shape; less is never grosser
  const lint::LintOptions linter = linter_options(options);
  bool clean = true;
  std::set<std::string> shapes;
  const auto note_shapes = [&](const auto& all) {
    for (const auto& shape : all) shapes.insert(shape.name);
  };
  nlohmann::ordered_json json{{"schema", kSchema}, {"files", nlohmann::ordered_json::array()}};
  const auto report = [&](const std::string& file, const std::vector<lint::Finding>& findings) {
    nlohmann::ordered_json one{{"file", file}, {"findings", nlohmann::ordered_json::array()}};
    int known_here = 0;
    bool clean_here = true;
    std::size_t printed = 0;  // findings before this one
    for (std::size_t i = 0; i < findings.size(); ++i) {
      const lint::Finding& finding = findings[i];
      const bool is_fault = lint::is_reported(finding);
      const auto before = known.find(key_of(file, finding.cause));
      const bool is_known = is_fault && before != known.end() &&
                            share(finding.count, finding.of) <= kMore * before->second.share &&
                            finding.gross <= std::max(kSmall, kGrosser * before->second.gross);
      nlohmann::ordered_json entry = to_json(finding);
      if (is_known) entry["known"] = true;
      one[is_fault ? "findings" : finding.is_hint ? "hints" : "below"].push_back(entry);
      known_here += is_known;
      if (is_fault && !is_known) clean_here = false;
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
    clean = clean && clean_here;
    json["files"].push_back(one);
    if (!clean_here || options.json || options.quiet) return;
    std::cout << "ok  " << file;
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
    snapshot::write_text(options.write_known, json.dump(1) + "\n");
    return ExitCode::Same;
  }
  return clean ? ExitCode::Same : ExitCode::Different;
}

}  // namespace

Verb lint_verb() {
  return {"lint", "Check the contacts in a trace against its own shapes and poses", &run_lint,
          "Examples:\n"
          "  contactscope lint run.jsonl\n"
          "  contactscope lint run.jsonl --write-known known.json   # the findings so far\n"
          "  contactscope lint run.jsonl --known known.json         # exits with 0 if none is new\n"
          "Exit codes: 0 nothing is wrong, or new; 1 a claim is wrong; 2 an error."};
}

lint::LintOptions linter_options(const Options& options) {
  lint::LintOptions to{.strict = options.strict, .tolerance = options.tolerance};
  const std::vector<std::string_view> causes = lint::causes();
  for (const std::string& text : options.ignored) {
    const std::size_t colon = std::min(text.find(':'), text.size());
    const std::string cause = text.substr(0, colon);
    if (std::ranges::find(causes, cause) == causes.end()) {
      const std::string near = did_you_mean(cause, causes);
      throw UsageError("--ignore: '" + cause + "' is not a cause of findings; " +
                       (near.empty() ? "there is " + quoted_list(causes) : near));
    }
    to.ignored.push_back({cause, colon < text.size() ? text.substr(colon + 1) : ""});
  }
  return to;
}

std::vector<lint::Finding> lint_scenario(const Scenario& scenario, const std::vector<int>& frames,
                                         const lint::LintOptions& options) {
  trace::Stages stages = trace::Stages::none();
  stages.reduction = true;  // shows which points were dropped on purpose
  Runner runner(scenario, stages);
  lint::Linter linter(runner.header(), options);
  for (const int frame : frames) {
    trace::Frame facts = runner.frame(frame);
    facts.line = frame + 2;
    linter.frame(std::move(facts));
  }
  return linter.findings();
}

std::vector<lint::Finding> lint_trace(TraceFile& file, const lint::LintOptions& options,
                                      const std::optional<FrameRange>& frames,
                                      const std::function<void(const trace::Frame&)>& look) {
  lint::Linter linter(file.header(), options);
  bool any = false;
  while (std::optional<trace::Frame> frame = file.next()) {
    stop_if_interrupted();
    if (look) look(*frame);
    if (frames && !frames->names(frame->frame)) {
      linter.shapes(frame->shapes);
      continue;
    }
    any = true;
    linter.frame(std::move(*frame));
  }
  if (!any) throw UsageError("--frames names no frame of " + file.name());
  std::vector<lint::Finding> findings = linter.findings();
  if (const std::optional<trace::Torn>& torn = file.torn(); torn)
    findings.push_back(
        {"torn", "the file is cut off within its last line",
         "the lines before it were checked; the process that wrote it crashed, or is still writing",
         1, 0, torn->line, 0});
  return findings;
}

void add_faults(const Input& input, const std::vector<int>& drawn, std::vector<View>& views) {
  if (std::ranges::none_of(views, [](const View& view) { return view.shows(Panel::Lint); })) return;
  const lint::LintOptions options{.marked = drawn};
  std::vector<lint::Finding> findings;
  if (!input.file.empty()) {
    if (input.file == "standard input")
      throw UsageError("the panel lint reads a trace twice; write it to a file first");
    TraceFile file(input.file);
    findings = lint_trace(file, options);
  } else {
    std::vector<int> all(static_cast<std::size_t>(input.scenario.frames));
    std::iota(all.begin(), all.end(), 0);
    findings = lint_scenario(input.scenario, all, options);
  }
  std::erase_if(findings, [](const lint::Finding& one) { return !lint::is_reported(one); });
  const std::vector<Fault> faults = mapped(findings, [](const lint::Finding& one) {
    return Fault{one.cause, one.count, one.of, one.frame,
                 mapped(one.marks, [](const lint::Mark& mark) {
                   return Fault::Place{mark.frame, mark.a, mark.b, mark.at};
                 })};
  });
  for (View& view : views)
    if (view.shows(Panel::Lint)) view.faults = faults;
}

}  // namespace contactscope::app
