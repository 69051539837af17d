#include "app/cli/faults.h"

#include <algorithm>
#include <numeric>

#include "app/cli/progress.h"
#include "core/at.h"
#include "core/nearest_word.h"
#include "scenario/run.h"

namespace contactscope::app {

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
