#include "find/finder.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>
#include <set>

#include "app/cli/catalogue.h"
#include "app/cli/narrow.h"
#include "app/cli/progress.h"
#include "app/cli/table.h"
#include "app/cli/trace_file.h"
#include "app/cli/verbs.h"
#include "scenario/run.h"
#include "snapshot/finding.h"

namespace contactscope::app {
namespace {

using find::Finder;
using find::Hit;
using find::Unit;

struct Searched {
  int frames = 0;
  std::vector<Hit> hits{};
};

/// Searches a trace with all threads, or the frames that a scenario's run gives.
Searched search(Finder& finder, const Options& options) {
  Searched searched;
  const auto add = [&](trace::Frame frame) {
    const int number = frame.frame;
    const bool is_wanted = !options.frames || options.frames->names(number);
    searched.frames += is_wanted;
    std::vector<Hit> hits = finder.next(std::move(frame));
    for (Hit& hit : hits)
      if (is_wanted && is_pair_named(hit.a, hit.b, options.pair))
        searched.hits.push_back(std::move(hit));
  };
  const std::string& path = options.scenarios.front();
  if (is_trace_file(path)) {
    TraceFile file(path);
    Workers workers(hardware_threads());
    for (;;) {
      stop_if_interrupted();
      std::vector<trace::Frame> frames = file.next(finder.parts(), workers);
      if (frames.empty()) break;
      for (trace::Frame& frame : frames) add(std::move(frame));
    }
    require_pair(file.header(), options);
    file.report_torn();
  } else {
    const std::vector<Scenario> scenarios = load_scenarios(options);
    if (scenarios.size() != 1) throw UsageError("find takes one scenario or trace");
    Runner runner(scenarios.front(), trace::Stages::none());
    require_pair(runner.header(), options);
    for (int frame = 0; frame < scenarios.front().frames; ++frame) {
      stop_if_interrupted();
      add(runner.frame(frame));
    }
  }
  if (searched.frames == 0) throw UsageError("--frames names no frame of " + path);
  return searched;
}

/// A number in the unit of its column.
std::string spelled(const find::Value& value, Unit unit) {
  if (const auto* const text = std::get_if<std::string>(&value)) return *text;
  const double number = std::get<double>(value);
  if (std::isnan(number)) return "-";
  return unit == Unit::Metres ? millimetres(number)
                              : spelled(unit == Unit::Count ? "%.9g" : "%.4g", number);
}

std::string heading(const find::Expression::Fact& fact) {
  const bool has_unit = fact.unit > Unit::Text;
  constexpr const char* kUnits[] = {" mm", " deg", " s", " N s"};
  return fact.name() +
         (has_unit ? kUnits[static_cast<int>(fact.unit) - static_cast<int>(Unit::Metres)] : "");
}

/// Whether every row of the table has it anyway.
bool is_in_each_row(const find::Expression::Fact& fact) {
  return fact.side.empty() && (fact.quantity == "frame" || fact.quantity == "time" ||
                               fact.quantity == "a" || fact.quantity == "b");
}

void print_table(const Searched& searched, const find::Expression& expression) {
  constexpr std::size_t kMaxRows = 1000;
  Table table{{"frame", "time s", "a", "b"}};
  for (const find::Expression::Fact& fact : expression.facts())
    if (!is_in_each_row(fact)) table.front().push_back(heading(fact));
  for (const Hit& hit : searched.hits) {
    if (table.size() > kMaxRows) break;
    std::vector<std::string>& row = table.emplace_back(std::vector<std::string>{
        std::to_string(hit.frame), spelled("%.6g", hit.time), hit.a, hit.b});
    if (!hit.label.empty()) row.back() += " (" + hit.label + ")";
    for (std::size_t i = 0; i < hit.values.size(); ++i)
      if (!is_in_each_row(expression.facts()[i]))
        row.push_back(spelled(hit.values[i], expression.facts()[i].unit));
  }
  print(table, std::cout);
  if (searched.hits.size() > kMaxRows)
    std::cout << "and " << searched.hits.size() - kMaxRows << " more, which --json lists\n";
}

/// Written entry by entry, since there may be very many.
void print_json(const Searched& searched, const find::Expression& expression,
                const std::string& file) {
  std::cout << R"({"schema":"contactscope.find/1","file":)" << nlohmann::json(file).dump()
            << R"(,"where":)" << nlohmann::json(expression.text()).dump() << R"(,"frames":)"
            << searched.frames << R"(,"found":[)";
  for (const Hit& hit : searched.hits) {
    nlohmann::ordered_json json{
        {"frame", hit.frame}, {"time", hit.time}, {"a", hit.a}, {"b", hit.b}};
    if (!hit.label.empty()) json["label"] = hit.label;
    json["values"] = nlohmann::ordered_json::object();
    for (std::size_t i = 0; i < hit.values.size(); ++i)
      std::visit([&](const auto& value) { json["values"][expression.facts()[i].name()] = value; },
                 hit.values[i]);
    std::cout << (&hit == &searched.hits.front() ? "" : ",") << json.dump();
  }
  std::cout << "]}\n";
}

ExitCode run_find(const Options& options) {
  note_interrupts();
  Finder finder(condition_of("EXPRESSION", options.condition));
  const Searched searched = search(finder, options);
  if (options.json)
    print_json(searched, finder.expression(), options.scenarios.front());
  else if (!searched.hits.empty())
    print_table(searched, finder.expression());
  std::set<int> frames;
  std::set<std::pair<std::string, std::string>> pairs;
  for (const Hit& hit : searched.hits) {
    frames.insert(hit.frame);
    pairs.emplace(hit.a, hit.b);
  }
  if (!options.quiet)
    std::cerr << frames.size() << " of " << snapshot::counted(searched.frames, "frame") << ", "
              << snapshot::counted(static_cast<int>(pairs.size()), "pair") << '\n';
  return searched.hits.empty() ? ExitCode::Different : ExitCode::Same;
}

}  // namespace

Verb find_verb() {
  return {
      "find", "Find the frames and pairs of a trace for which a condition holds", &run_find,
      R"(The condition consists of quantities of a pair in a frame, numbers, also with a unit (m, cm, mm, um, nm,
deg, rad, s, ms, N s), and texts in quotes, with + - * /, == != < <= > >=, and, or, not, parentheses and
abs(x). Without a unit lengths are in metres, angles in degrees.
Of the frame: frame, time, a, b, label (the names of the pair), points, manifolds, separation (negative in
overlap), overlap (0 when separated), touching, impulse (normal, sum over the points), axis, type, ids,
normal_x, normal_y, normal_z. previous.QUANTITY is the value in the frame before.
Since the frame before: normal_turn, overlap_change, impulse_change, points_gained, points_lost, ids_gained,
ids_lost, and of the shape that moves more motion (of its origin) and turn. age: frames of contact without a
break, 0 in the first. away: frames without contact before that. In the first frame without a pair that was
there, it has no points.

Examples:
  contactscope find run.jsonl 'overlap > 5 mm and normal_turn > 20 deg'
  contactscope find run.jsonl 'points_lost > 0 and motion < 1 mm'     # contacts that flicker
  contactscope find run.jsonl 'age == 0 and away <= 2' --pair crate,floor
  contactscope find run.jsonl "ids != previous.ids and a == 'floor'" --json
  contactscope render run.jsonl --where 'overlap > 5 mm'              # draws what is found
Exit codes: 0 something is found, 1 nothing is, 2 an error.)"};
}

}  // namespace contactscope::app
