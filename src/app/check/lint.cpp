#include "app/check/lint.h"

#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>

#include "app/cli/progress.h"
#include "app/cli/verbs.h"
#include "scenario/run.h"

namespace contactscope::app {

std::vector<lint::Finding> lint_scenario(const Input& input) {
  trace::Stages stages = trace::Stages::none();
  stages.reduction = true;  // shows which points were dropped on purpose
  Runner runner(input.scenario, stages);
  lint::Linter linter(runner.header());
  for (const int frame : input.frames) {
    trace::Frame facts = runner.frame(frame);
    facts.line = frame + 2;
    linter.frame(std::move(facts));
  }
  return linter.findings();
}

std::vector<lint::Finding> lint_trace(TraceFile& file, const Options& options,
                                      const std::function<void(const trace::Frame&)>& look) {
  lint::Linter linter(file.header());
  bool any = false;
  while (std::optional<trace::Frame> frame = file.next()) {
    stop_if_interrupted();
    if (look) look(*frame);
    if (options.frames && !options.frames->names(frame->frame)) {
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

std::string record(const std::string& file, const lint::Finding& finding) {
  std::string text = file + ":" + std::to_string(std::max(finding.line, 1)) + ":1: " + finding.what;
  if (finding.of > 0)
    text += ", " + std::to_string(finding.count) + " of " + std::to_string(finding.of);
  else if (finding.count > 1)
    text += ", " + std::to_string(finding.count) + " times";
  text += " [" + finding.cause + "]";
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
  if (finding.line > 0) json["line"] = finding.line;
  if (!finding.a.empty()) {
    json["frame"] = finding.frame;
    json["a"] = finding.a;
    if (!finding.b.empty()) json["b"] = finding.b;
    if (!finding.said.empty()) json["said"] = finding.said;
    if (!finding.is.empty()) json["is"] = finding.is;
  }
  return json;
}

namespace {

ExitCode run_lint(const Options& options) {
  bool clean = true;
  nlohmann::ordered_json json{{"schema", "contactscope.lint/1"},
                              {"files", nlohmann::ordered_json::array()}};
  const auto report = [&](const std::string& file, const std::vector<lint::Finding>& findings) {
    clean = clean && findings.empty();
    nlohmann::ordered_json one{{"file", file}, {"findings", nlohmann::ordered_json::array()}};
    for (const lint::Finding& finding : findings) {
      one["findings"].push_back(to_json(finding));
      if (!options.json) std::cout << record(file, finding) << '\n';
    }
    json["files"].push_back(one);
    if (findings.empty() && !options.json && !options.quiet) std::cout << "ok  " << file << '\n';
  };
  each_input(
      options, [&](const Input& input) { report(input.scenario.path, lint_scenario(input)); },
      [&](TraceFile& file) { report(file.name(), lint_trace(file, options)); });
  if (options.json) std::cout << json.dump() << '\n';
  return clean ? ExitCode::Same : ExitCode::Different;
}

}  // namespace

Verb lint_verb() {
  return {"lint", "Check the contacts in a trace against its own shapes and poses", &run_lint,
          "Examples:\n"
          "  contactscope lint run.jsonl\n"
          "Exit codes: 0 nothing is wrong, 1 a claim is wrong, 2 an error."};
}

}  // namespace contactscope::app
