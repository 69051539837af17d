#include "scenario/idle_keys.h"

#include <algorithm>

namespace contactscope::scenario_file {
namespace {

using toml_reader::Table;
using toml_reader::Value;

using Sentences = std::vector<std::string>;

void tell(const Value& at, const std::string& what, const std::string& why, Sentences& sentences) {
  sentences.push_back("line " + std::to_string(at.line()) + ": " + what + " has no effect: " + why);
}

constexpr const char* kPairKeys[] = {"penetration", "core_margin", "breaking_distance", "confirm"};

/// Why `key` changes nothing of a pair; empty: it does.
std::string idle_reason(const std::string& key, const ScenarioPair& pair,
                        const std::vector<ScenarioShape>& shapes) {
  const bool incremental = pair.pipeline.manifold == ManifoldKind::Incremental;
  const bool hull_a = shapes[static_cast<std::size_t>(pair.a)].hull() != nullptr;
  const bool hull_b = shapes[static_cast<std::size_t>(pair.b)].hull() != nullptr;
  if (key == "penetration")
    return incremental || (hull_a && hull_b)
               ? ""
               : "it is of two hulls (boxes, hulls, cylinders, cones), or of incremental manifolds";
  if (!incremental) return "the manifold is one-shot; set manifold = \"incremental\", or remove it";
  if (key == "core_margin" && !hull_a && !hull_b)
    return "only cores of hulls lie within a margin; remove it";
  return "";
}

/// Keys of `table` that change none of `pairs`.
void tell_pair_keys(const Value& table, const std::vector<const ScenarioPair*>& pairs,
                    const std::vector<ScenarioShape>& shapes, Sentences& sentences) {
  if (pairs.empty()) return;
  for (const char* key : kPairKeys) {
    const auto value = table.peek(key);
    if (!value) continue;
    const auto idle = [&](const ScenarioPair* pair) {
      return !idle_reason(key, *pair, shapes).empty();
    };
    if (std::ranges::all_of(pairs, idle))
      tell(*value, "'" + std::string(key) + "'", idle_reason(key, *pairs[0], shapes), sentences);
  }
}

/// The pair that an entry of [[pairs]] has become; null where the entry was left out.
const ScenarioPair* pair_of(const Value& entry, const Scenario& scenario) {
  const auto name = [&](int shape) {
    return scenario.shapes[static_cast<std::size_t>(shape)].name;
  };
  const auto label = entry.peek("label");
  for (const ScenarioPair& pair : scenario.pairs) {
    if (name(pair.a) == entry.peek("a")->string() && name(pair.b) == entry.peek("b")->string() &&
        pair.label == (label ? label->string() : ""))
      return &pair;
  }
  return nullptr;
}

/// Keys of [solver] that belong to another position correction.
void tell_solver_keys(const Value& table, PositionCorrection correction, Sentences& sentences) {
  constexpr struct {
    const char* key;
    PositionCorrection of;
  } kKeys[] = {{"baumgarte", PositionCorrection::Baumgarte},
               {"hertz", PositionCorrection::Soft},
               {"damping_ratio", PositionCorrection::Soft}};
  for (const auto& [key, of] : kKeys) {
    const auto value = table.peek(key);
    if (!value || correction == of) continue;
    tell(*value, "'" + std::string(key) + "'",
         std::string("overlaps are worked off by \"") + to_string(correction) +
             "\"; set position_correction = \"" + to_string(of) + "\", or remove it",
         sentences);
  }
}

}  // namespace

std::vector<std::string> idle_keys(const Table& file, const Scenario& scenario) {
  Sentences sentences;
  if (const auto pipeline = file.find("pipeline")) {
    std::vector<const ScenarioPair*> all;
    for (const ScenarioPair& pair : scenario.pairs) all.push_back(&pair);
    tell_pair_keys(*pipeline, all, scenario.shapes, sentences);
  }
  if (const auto pairs = file.find("pairs")) {
    for (const Value& entry : pairs->array_of_tables()) {
      if (const ScenarioPair* pair = pair_of(entry, scenario))
        tell_pair_keys(entry, {pair}, scenario.shapes, sentences);
    }
  }
  const bool moves = std::ranges::any_of(
      scenario.shapes, [](const ScenarioShape& shape) { return shape.body.has_value(); });
  for (const char* name : {"world", "solver"}) {
    const auto table = file.find(name);
    if (table && !moves)
      tell(*table, "[" + std::string(name) + "]",
           "no shape is dynamic; give one motion = { dynamic = true, mass = 1.0 }, or remove it",
           sentences);
  }
  if (!moves) {
    for (const Value& shape : file.require("shapes", "").members()) {
      for (const char* key : {"friction", "restitution"}) {
        if (const auto value = shape.peek(key))
          tell(*value, "'" + std::string(key) + "'",
               "no shape is dynamic, and only the solver goes by it; remove it", sentences);
      }
    }
  }
  if (const auto solver = file.find("solver"); solver && moves)
    tell_solver_keys(*solver, scenario.solver.position_correction, sentences);
  return sentences;
}

}  // namespace contactscope::scenario_file
