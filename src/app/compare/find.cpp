#include <iostream>
#include <nlohmann/json.hpp>

#include "app/cli/faults.h"
#include "app/cli/narrow.h"
#include "app/cli/table.h"
#include "trace/find.h"

namespace contactscope::app {
namespace {

using find::Hit;
using find::Unit;
using Fact = find::Expression::Fact;

/// A number in the unit of its column.
std::string cell_of(const find::Value& value, Unit unit) {
  if (const auto* const text = std::get_if<std::string>(&value)) return *text;
  const double number = std::get<double>(value);
  if (std::isnan(number)) return "-";
  if (unit == Unit::Metres) return millimetres(number);
  return printed(unit == Unit::Count ? "%.9g" : "%.4g", number);
}

std::string heading_of(const Fact& fact) {
  constexpr const char* kUnits[] = {"", "", "", " mm", " deg", " s", " N s"};
  return fact.name() + kUnits[static_cast<std::size_t>(fact.unit)];
}

void print_table(const std::vector<Hit>& hits, const std::vector<Fact>& facts) {
  constexpr std::size_t kMaxRows = 1000;
  const std::set<std::string> in_each_row = {"frame", "time", "a", "b"};
  Table table{{"frame", "time s", "a", "b"}};
  for (const Fact& fact : facts)
    if (!in_each_row.contains(fact.name())) table.front().push_back(heading_of(fact));
  for (const Hit& hit : hits) {
    if (table.size() > kMaxRows) break;
    const std::string label = hit.label.empty() ? "" : " (" + hit.label + ")";
    table.push_back({std::to_string(hit.frame), printed("%.6g", hit.time), hit.a, hit.b + label});
    for (std::size_t i = 0; i < facts.size(); ++i)
      if (!in_each_row.contains(facts[i].name()))
        table.back().push_back(cell_of(hit.values[i], facts[i].unit));
  }
  print(table, std::cout);
  if (hits.size() > kMaxRows)
    std::cout << "and " << hits.size() - kMaxRows << " more, which --json lists\n";
}

/// Written entry by entry, since there may be very many.
void print_json(const std::vector<Hit>& hits, const find::Expression& expression, int frames,
                const std::string& file) {
  using Json = nlohmann::ordered_json;
  const std::string begin = Json{
      {"schema", "contactscope.find/1"},
      {"file", file},
      {"where", expression.text()},
      {"frames", frames}}.dump();
  std::cout << begin.substr(0, begin.size() - 1) << ",\"found\":[";
  for (const Hit& hit : hits) {
    Json json{{"frame", hit.frame}, {"time", hit.time}, {"a", hit.a}, {"b", hit.b}};
    if (!hit.label.empty()) json["label"] = hit.label;
    for (std::size_t i = 0; i < hit.values.size(); ++i)
      std::visit([&](const auto& value) { json["values"][expression.facts()[i].name()] = value; },
                 hit.values[i]);
    std::cout << (&hit == &hits.front() ? "" : ",") << json.dump();
  }
  std::cout << "]}\n";
}

/// Texts that a condition on names compares with, and that name no shape.
void note_unknown(const find::Expression& expression, const std::vector<std::string_view>& names) {
  if (std::ranges::none_of(expression.facts(), [](const Fact& fact) {
        return fact.name() == "a" || fact.name() == "b";
      }))
    return;
  for (const std::string& text : expression.texts())
    if (std::ranges::find(names, text) == names.end())
      std::cerr << "note: no shape is named '" << text << "'; " << did_you_mean(text, names)
                << "names are case-sensitive\n";
}

ExitCode run_find(const Options& options) {
  note_interrupts();
  if (std::error_code none; std::filesystem::exists(options.condition, none))
    throw UsageError("the file comes first: contactscope find FILE EXPRESSION");
  find::Finder finder(condition_of("EXPRESSION", options.condition));
  TraceFile file(options.scenarios.front(),
                 finder.wants_lint() ? TraceFile::Passes::Several : TraceFile::Passes::One);
  if (finder.wants_lint()) {
    const auto& only = options.frames;
    lint::LintOptions to_lint = linter_options(options);
    to_lint.is_marked = [&](int frame) { return !only || only->names(frame); };
    std::vector<lint::Finding> findings = lint_trace(file, to_lint);
    const KnownFindings known(options);
    std::erase_if(findings, [&](auto& one) { return known.knows(file.name(), one); });
    for (const std::string& below : finder.take(findings)) std::cerr << "note: " << below << '\n';
    file.rewind();
  }
  Workers workers(hardware_threads());
  std::vector<Hit> hits;
  std::set<int> found;
  int frames = 0;
  for (;;) {
    stop_if_interrupted();
    std::vector<trace::Frame> some = file.next(finder.parts(), workers);
    if (some.empty()) break;
    if (finder.wants_ids())
      workers.for_each(count_of(some),
                       [&](int i, int) { trace::name_points(file.header().shapes, at(some, i)); });
    for (trace::Frame& frame : some) {
      const bool is_wanted = !options.frames || options.frames->names(frame.frame);
      frames += is_wanted;
      for (Hit& hit : finder.next(std::move(frame))) {
        if (!is_wanted) continue;
        found.insert(hit.frame);
        hits.push_back(std::move(hit));
      }
    }
  }
  file.report_torn();
  if (frames == 0) throw UsageError("--frames names no frame of " + file.name());
  if (options.json)
    print_json(hits, finder.expression(), frames, file.name());
  else if (!hits.empty())
    print_table(hits, finder.expression().facts());
  if (hits.empty()) note_unknown(finder.expression(), names_in(file.header().shapes));
  if (options.quiet) return hits.empty() ? ExitCode::Different : ExitCode::Same;
  for (const std::string& assumption : finder.expression().assumptions())
    std::cerr << "note: " << assumption << ", because no unit follows\n";
  std::cerr << found.size() << " of " << counted(frames, "frame") << '\n';
  return hits.empty() ? ExitCode::Different : ExitCode::Same;
}

}  // namespace

Verb find_verb() {
  return {"find", "Find the frames and pairs of a trace for which a condition holds", &run_find};
}

}  // namespace contactscope::app
