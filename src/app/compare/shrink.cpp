#include "shrink/shrink.h"

#include <iostream>

#include "app/cli/narrow.h"
#include "app/compare/engine_runs.h"
#include "snapshot/store.h"
#include "versus/request.h"

namespace contactscope::app {
namespace {

namespace fs = std::filesystem;
using shrink::PairOfTwo;

/// Where to search for a pair: the frames of a scenario or trace.
struct Source {
  std::string name;                    // "hull/face_contact", or the file name of a trace
  std::optional<Scenario> scenario{};  // unset for a trace
  trace::Trace trace{};
};

Source read_source(const Options& options) {
  const std::string& path = options.scenarios.front();
  if (is_trace_file(path)) return {path, std::nullopt, load_trace(path)};
  std::vector<Scenario> scenarios = load_scenarios(options);
  if (scenarios.size() != 1) throw UsageError("shrink takes one scenario or trace");
  Source source{scenarios.front().name, std::move(scenarios.front()), {}};
  source.trace = run_frames(*source.scenario, options.selected(source.scenario->frames));
  return source;
}

find::Expression read_expression(const Options& options, const Source& source) {
  if (options.condition.empty())
    throw UsageError(
        "shrink needs a condition to preserve: --while 'float.points != double.points', "
        "--while lint.flipped_normals, --while unmet");
  find::Expression expression = condition_of("--while", options.condition, shrink::vocabulary());
  if (source.scenario && expression.sides().contains("recorded"))
    throw UsageError(
        "--while: nothing is recorded in a scenario; write float, double, or the name of an "
        "engine");
  return expression;
}

/// Engines among the sides of an expression.
std::map<std::string, shrink::Engine> engines_of(const find::Expression& expression,
                                                 const Options& options) {
  std::vector<std::string> names;
  for (const std::string& side : expression.sides())
    if (!side.empty() && side != "float" && side != "double" && side != "recorded" &&
        side != "lint" && side != "unmet")
      names.push_back(side);
  std::map<std::string, shrink::Engine> engines;
  for (const auto& [name, program] : programs_of(names))
    engines[name] = [name = name, program = program,
                     limit = options.time_limit](const trace::Trace& request) {
      return run_engine(name, program, "contacts", request, limit).trace;
    };
  return engines;
}

struct Found {
  PairOfTwo pair;
  int frame = 0;
  std::string a, b;
};

/// The first pair of the first frame for which the expression holds in isolation.
std::optional<Found> first_pair(const Source& source, const Options& options,
                                shrink::Judge& judge) {
  for (const trace::Frame& frame : source.trace.frames) {
    if (options.frames && !options.frames->names(frame.frame)) continue;
    for (const trace::Pair& pair : frame.pairs) {
      stop_if_interrupted();
      if (!options.pair.empty() &&
          !std::ranges::is_permutation(std::vector{pair.a, pair.b}, options.pair))
        continue;
      const auto two = shrink::pair_of_frame(source.trace.header, frame, pair,
                                             source.scenario ? &*source.scenario : nullptr);
      if (!two) continue;
      if (!two->expectation.empty()) judge.remember_unmet(*two);
      if (judge.holds(*two)) return Found{*two, frame.frame, pair.a, pair.b};
    }
  }
  return std::nullopt;
}

/// Without expectations, expects the result of double precision.
void expect_what_double_has(PairOfTwo& pair) {
  if (!pair.expectation.empty()) return;
  const std::optional<trace::Pair> right = shrink::Judge::in_double(pair);
  if (!right) return;
  if (right->overlap) {
    pair.expectation.emplace_back("overlap", *right->overlap ? "true" : "false");
    return;
  }
  pair.expectation.emplace_back("state", shrink::quoted(right->state));
  if (right->manifolds.empty()) return;
  const int points = count_of(joined(right->manifolds, &trace::Manifold::points));
  pair.expectation.emplace_back("points", std::to_string(points));
  if (right->manifolds.size() == 1)
    pair.expectation.emplace_back("normal", shrink::spell(right->manifolds.front().normal));
  pair.expectation.emplace_back("separation", shrink::spell(right->separation));
}

/// "hull_face_contact" for "hull/face_contact" or "runs/hull_face_contact.jsonl".
std::string stem_of(const Source& source) {
  std::string stem = source.scenario ? source.name : fs::path(source.name).stem().string();
  std::ranges::replace(stem, '/', '_');
  return stem == "-" || stem.empty() ? "trace" : stem;
}

ExitCode run_shrink(const Options& options) {
  note_interrupts();
  const Source source = read_source(options);
  const find::Expression expression = read_expression(options, source);
  shrink::Judge judge(expression, engines_of(expression, options));
  const std::optional<Found> found = first_pair(source, options, judge);
  if (!found) {
    std::cerr << "in no frame of " << source.name << " do two shapes alone satisfy "
              << expression.text() << "; " << counted(judge.requested(), "pair was", "pairs were")
              << " tried. A condition that needs more than two shapes, or earlier frames, cannot "
                 "be shrunk\n";
    return ExitCode::Different;
  }
  shrink::Shrunk shrunk =
      shrink::shrink(found->pair, judge, [](const PairOfTwo&) { stop_if_interrupted(); });
  expect_what_double_has(shrunk.pair);

  const fs::path folder = fs::path(options.out) / "shrink";
  fs::create_directories(folder);
  const fs::path file = folder / (stem_of(source) + ".toml");
  const std::string place = source.name + ", frame " + std::to_string(found->frame) + ", " +
                            found->a + " and " + found->b;
  snapshot::write_text(file,
                       shrink::to_scenario(shrunk.pair, expression.text(), "shrunk from " + place));
  std::optional<fs::path> claims;
  if (shrunk.pair.claims) {
    claims = folder / (stem_of(source) + ".jsonl");
    snapshot::write_text(*claims, versus::to_text(shrink::Judge::trace_of(shrunk.pair)));
  }
  const int before = found->pair.vertex_count(), after = shrunk.pair.vertex_count();
  if (options.json) {
    nlohmann::ordered_json json{{"while", expression.text()},
                                {"from", source.name},
                                {"frame", found->frame},
                                {"a", found->a},
                                {"b", found->b},
                                {"vertices", {before, after}},
                                {"tried", shrunk.tried},
                                {"scenario", file.string()}};
    if (claims) json["trace"] = claims->string();
    std::cout << json.dump() << '\n';
    return ExitCode::Same;
  }
  std::cout << place << ": " << before << " vertices -> " << after << ", " << shrunk.tried
            << " pairs tried\n"
            << file.string() << '\n';
  if (claims) std::cout << claims->string() << '\n';
  return ExitCode::Same;
}

}  // namespace

Verb shrink_verb() {
  return {"shrink",
          "Find the smallest pair for which a condition still holds, and write it as a scenario",
          &run_shrink};
}

}  // namespace contactscope::app
