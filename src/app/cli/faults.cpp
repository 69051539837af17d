#include "app/cli/faults.h"

#include <nlohmann/json.hpp>

#include "app/cli/progress.h"
#include "scenario/run.h"
#include "snapshot/store.h"

namespace contactscope::app {
namespace {

double share(int count, int of) { return of > 0 ? static_cast<double>(count) / of : count; }
std::string name_of_file(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

}  // namespace

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

KnownFindings::KnownFindings(const Options& options)
    : path_(options.known), is_strict_(options.strict) {
  constexpr double kAnySize = 1e9;  // files of earlier versions have no 'gross'
  if (path_.empty()) return;
  try {
    const std::optional<std::string> text = snapshot::read_text_file(path_);
    if (!text) throw std::invalid_argument("there is no such file");
    if (!nlohmann::json::accept(*text)) throw std::invalid_argument("it is not JSON");
    const auto json = nlohmann::json::parse(*text);
    if (json.at("schema") != kLintSchema) throw std::invalid_argument("another schema");
    // The findings of one file hold for traces of any name.
    const bool is_one = json.at("files").size() == 1;
    for (const nlohmann::json& file : json.at("files")) {
      have_below_ = have_below_ || file.contains("below");
      for (const char* const list : {"findings", "below"})
        for (const nlohmann::json& one : file.value(list, nlohmann::json::array())) {
          Known& known = known_[{is_one ? "" : name_of_file(file.at("file")), one.at("cause")}];
          known.share = share(one.at("count"), one.value("of", 0));
          known.gross = one.value("gross", kAnySize);
          for (const nlohmann::json& pair : one.value("pairs", nlohmann::json::array()))
            known.pairs[{pair.at(0), pair.at(1)}] = pair.at(2), have_pairs_ = true;
        }
    }
  } catch (const std::exception& error) {
    throw InputError(path_, 1, 1,
                     std::string("no findings of lint can be read here (") + error.what() +
                         "); write them with `contactscope lint RUN.jsonl --write-known FILE`");
  }
}

bool KnownFindings::knows(const std::string& file, lint::Finding& finding) const {
  constexpr double kMore = 1.5, kGrosser = 3;  // times as frequent, or as large: a new finding
  constexpr int kChance = 3;                   // so many more, of a few, are no new finding
  constexpr double kSmall = 0.05;  // relative to the smaller shape; less is never grosser
  if (path_.empty() || finding.is_hint) return false;
  auto found = known_.find({name_of_file(file), finding.cause});
  if (found == known_.end()) found = known_.find({"", finding.cause});
  const Known was = found == known_.end() ? Known() : found->second;
  if (!finding.below.empty() && have_below_ &&
      finding.count > kMore * was.share * std::max(finding.of, 1) + kChance) {
    finding.below.clear();
    finding.what += ", more often than " + path_ + " knows it";
    return false;
  }
  for (const lint::OfPair& one : finding.pairs) {
    if (!is_strict_ || !have_pairs_) break;
    const auto before = was.pairs.find({one.a, one.b});
    if (before != was.pairs.end() && one.count <= kMore * before->second + kChance) continue;
    finding.line = one.line, finding.frame = one.frame;
    finding.a = one.a, finding.b = one.b;
    finding.said = one.said, finding.is = one.is;
    finding.what += ", in a pair where " + path_ + " has none";
    return false;
  }
  return lint::is_reported(finding) && found != known_.end() &&
         share(finding.count, finding.of) <= kMore * was.share &&
         finding.gross <= std::max(kSmall, kGrosser * was.gross);
}

lint::LintOptions linter_options(const Options& options) {
  lint::LintOptions to{.strict = options.strict, .tolerance = options.tolerance};
  const std::vector<std::string_view> causes = lint::causes();
  for (const std::string& text : options.ignored) {
    const std::size_t colon = std::min(text.find(':'), text.size());
    const std::string cause = text.substr(0, colon);
    if (std::ranges::find(causes, cause) == causes.end())
      throw UsageError("--ignore: '" + cause + "' is not a cause of findings; " +
                       near_or_all(cause, causes));
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
    return options.pair.empty() ||
           std::minmax(a, b) == std::minmax(options.pair[0], options.pair[1]);
  };
  lint::LintOptions to_lint = linter_options(options);
  to_lint.is_marked = is_drawn;
  std::vector<Fault> faults;
  std::string first;
  const KnownFindings known(options);
  for (lint::Finding& one : lint_input(input, to_lint)) {
    const bool is_known = known.knows(input.file, one);
    if (is_known || !lint::is_reported(one)) continue;
    Fault& fault = faults.emplace_back(Fault{one.cause, one.count, one.of, one.frame});
    fault.frames = one.frames, fault.fits = one.fits;
    if (!one.said.empty()) fault.detail = one.said + "; " + one.is;
    for (const lint::Mark& mark : one.marks)
      if (is_drawn(mark.frame) && is_of_pair(mark.a, mark.b))
        fault.places.push_back({mark.frame, mark.a, mark.b, mark.at, mark.normal, mark.path});
    if (first.empty() && !one.a.empty() && !fault.places.empty()) first = one.what;
    std::stable_partition(fault.places.begin(), fault.places.end(), [&](const Fault::Place& place) {
      return place.frame == one.frame && place.a == one.a && place.b == one.b &&
             (!one.at || place.at == one.at);
    });
  }
  for (View& view : views)
    if (has_faults(view)) view.faults = faults, view.ignores_faults = !options.ignored.empty();
  return first;
}

}  // namespace contactscope::app
