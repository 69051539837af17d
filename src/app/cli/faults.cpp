#include "app/cli/faults.h"

#include <nlohmann/json.hpp>

#include "app/cli/progress.h"
#include "core/key_table.h"
#include "scenario/run.h"

namespace contactscope::app {

std::string record(const std::string& file, const lint::Finding& finding) {
  std::string text = file + ":" + std::to_string(std::max(finding.line, 1)) +
                     ":1: " + (finding.is_hint ? "hint: " : "") + finding.what;
  if (finding.of > 0)
    text += ", " + std::to_string(finding.count) + " of " + std::to_string(finding.of) + " " +
            std::string(finding.cases);
  else if (finding.count > 1)
    text += ", " + std::to_string(finding.count) + " times";
  if (!finding.below.empty())
    text += ", below the threshold of " + finding.below + " (--strict reports all)";
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

std::vector<lint::Finding> lint_input(const Input& input, const lint::LintOptions& options) {
  if (input.file == "standard input")
    throw UsageError("lint reads a trace twice here; write it to a file first");
  if (!input.file.empty()) {
    TraceFile file(input.file);
    return lint_trace(file, options);
  }
  return lint_scenario(input.scenario, Options{}.selected(input.scenario.frames), options);
}

std::string add_faults(const Input& input, const std::vector<int>& drawn, const Options& options,
                       std::vector<View>& views) {
  const auto has_faults = [](const View& view) {
    return view.shows(Panel::Lint) || view.focus == Focus::Worst;
  };
  if (std::ranges::none_of(views, has_faults)) return {};
  const auto is_drawn = [&](int frame) { return std::ranges::binary_search(drawn, frame); };
  const auto is_of_pair = [&](const std::string& a, const std::string& b) {
    return options.pair.size() != 2 ||
           std::minmax(a, b) == std::minmax(options.pair[0], options.pair[1]);
  };
  lint::LintOptions to_lint = linter_options(options);
  to_lint.is_marked = is_drawn;
  std::vector<Fault> faults;
  std::string first;
  for (const lint::Finding& one : lint_input(input, to_lint)) {
    if (!lint::is_reported(one)) continue;
    Fault& fault = faults.emplace_back(Fault{one.cause, one.count, one.of, one.frame});
    fault.frames = one.frames;
    if (!one.said.empty()) fault.detail = one.said + "; " + one.is;
    for (const lint::Mark& mark : one.marks)
      if (is_drawn(mark.frame) && is_of_pair(mark.a, mark.b))
        fault.places.push_back({mark.frame, mark.a, mark.b, mark.at});
    if (first.empty() && !one.a.empty() && !fault.places.empty()) first = one.what;
    std::stable_partition(fault.places.begin(), fault.places.end(), [&](const Fault::Place& place) {
      return place.frame == one.frame && place.a == one.a && place.b == one.b;
    });
  }
  for (View& view : views)
    if (has_faults(view)) view.faults = faults, view.ignores_faults = !options.ignored.empty();
  return first;
}

}  // namespace contactscope::app
