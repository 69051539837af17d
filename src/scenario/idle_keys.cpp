#include "scenario/readers.h"

namespace contactscope::scenario_file {
namespace {

using Sentences = std::vector<std::string>;

/// Warns that `key` of `table` has no effect, if the file has it.
void report(const Value& table, const char* key, const std::string& why, Sentences& sentences) {
  if (const auto value = table.find(key))
    sentences.push_back(
        "line " + std::to_string(value->line()) + ": " +
        (value->is_table() ? "[" + value->name() + "]" : "'" + value->name() + "'") +
        " has no effect: " + why);
}

/// Why a query key has no effect on a pair; empty if it has one.
std::string idle_question(std::string_view key, const Question& question) {
  const std::string requested =
      std::string("the pair's query is \"") + to_string(question.kind) + "\"";
  if (question.kind == QueryKind::Manifold)
    return requested + "; set query = \"overlap\", or remove it";
  const bool is_overlap = question.kind == QueryKind::Overlap;
  if (key == "comparison")
    return is_overlap ? "" : requested + ", and only \"overlap\" is compared; remove it";
  if (key == "tolerance")
    return is_overlap || question.kind == QueryKind::Touching
               ? ""
               : requested + ", whose result is in metres; remove it";
  if (question.bounds != QueryMethod::Obb)
    return "only oriented boxes are tested along axes; set bounds = \"obb\", or remove it";
  if (key == "skip_up_to" && question.test.axes != ObbAxes::Fifteen)
    return "only the test of fifteen axes has a threshold; set axes = \"fifteen\", or remove it";
  return "";
}

constexpr const char* kContactKeys[] = {
    "manifold",   "reducer",     "max_points",        "margin",         "cache",
    "preference", "degenerate",  "internal_edges",    "mesh_manifolds", "triangle",
    "field",      "core_margin", "breaking_distance", "confirm",        "too_close"};
constexpr const char* kQuestionKeys[] = {"comparison", "tolerance", "axes", "skip_up_to"};

/// Why `key` has no effect on a pair; empty if it has one.
std::string idle_reason(std::string_view key, const ScenarioPair& pair, const Scenario& scenario) {
  const bool incremental = pair.pipeline.manifold == ManifoldKind::Incremental;
  const bool hull_a = scenario.shape(pair.a).hull() != nullptr;
  const bool hull_b = scenario.shape(pair.b).hull() != nullptr;
  const Question& question = pair.pipeline.question;
  if (key == "traversal")
    return starts_somewhere(scenario, pair)
               ? ""
               : "only a query of two meshes, or of two convex shapes, without bounds has a start "
                 "to choose; set query = \"overlap\", or remove it";
  if (key == "distance")
    return hull_a && hull_b && question.kind != QueryKind::Manifold && !question.bounds
               ? ""
               : "only a query of two hulls (boxes, hulls, cylinders, cones), without bounds, can "
                 "walk over their features; set query = \"distance\", or remove it";
  if (std::ranges::find(kQuestionKeys, key) != std::end(kQuestionKeys))
    return idle_question(key, question);
  if (question.kind != QueryKind::Manifold) {
    if (key == "penetration" && question.kind == QueryKind::Penetration && (hull_a || hull_b))
      return "";
    return std::string("the pair's query is \"") + to_string(question.kind) +
           "\", which makes no contacts; remove it";
  }
  if (key == "penetration")
    return incremental || (hull_a && hull_b)
               ? ""
               : "it needs two hulls (boxes, hulls, cylinders, cones) or an incremental manifold";
  if (key == "field") {
    const auto is_field = [&](int i) {
      return kind_of(*scenario.shape(i).geometry) == ShapeKind::Field;
    };
    return is_field(pair.a) || is_field(pair.b)
               ? ""
               : "neither shape is a distance field (type = \"sdf\"); remove it";
  }
  if (key == "triangle") {
    for (const int i : {pair.a, pair.b})
      if (const Mesh<double>* const mesh = std::get_if<Mesh<double>>(&*scenario.shape(i).geometry))
        return pair.pipeline.triangle < mesh->triangle_count()
                   ? ""
                   : "'" + scenario.shape(i).name + "' has triangles 0 to " +
                         std::to_string(mesh->triangle_count() - 1);
    return "neither shape is a mesh; remove it";
  }
  const bool of_incremental =
      key == "core_margin" || key == "breaking_distance" || key == "confirm" || key == "too_close";
  if (!of_incremental) return "";
  if (!incremental) return "the manifold is one-shot; set manifold = \"incremental\", or remove it";
  if (key == "core_margin" && !hull_a && !hull_b) return "only hulls have a core margin; remove it";
  return "";
}

/// Warns of keys of `table` that affect none of `pairs`.
void report_pair_keys(const Value& table, std::span<const ScenarioPair> pairs,
                      const Scenario& scenario, Sentences& sentences) {
  const auto report_where_idle = [&](const char* key) {
    const auto reason = [&](const ScenarioPair& pair) { return idle_reason(key, pair, scenario); };
    const auto idle = [&](const ScenarioPair& pair) { return !reason(pair).empty(); };
    if (!pairs.empty() && std::ranges::all_of(pairs, idle))
      report(table, key, reason(pairs[0]), sentences);
  };
  report_where_idle("penetration");
  report_where_idle("distance");
  report_where_idle("traversal");
  std::ranges::for_each(kContactKeys, report_where_idle);
  std::ranges::for_each(kQuestionKeys, report_where_idle);
}

/// The pair of a [[pairs]] entry; empty if it was left out.
std::span<const ScenarioPair> pair_of(const Value& entry, const Scenario& scenario) {
  const auto label = entry.find("label");
  const auto pair = std::ranges::find_if(scenario.pairs, [&](const ScenarioPair& made) {
    return scenario.shape(made.a).name == entry.find("a")->string() &&
           scenario.shape(made.b).name == entry.find("b")->string() &&
           made.label == (label ? label->string() : "");
  });
  return {pair, pair == scenario.pairs.end() ? pair : pair + 1};
}

/// Warns of [solver] keys for another position correction.
void report_solver_keys(const Value& table, PositionCorrection correction, Sentences& sentences) {
  constexpr struct {
    const char* key;
    PositionCorrection of;
  } kKeys[] = {{"baumgarte", PositionCorrection::Baumgarte},
               {"push_speed", PositionCorrection::Baumgarte},
               {"hertz", PositionCorrection::Soft},
               {"damping_ratio", PositionCorrection::Soft}};
  for (const auto& [key, of] : kKeys)
    if (correction != of)
      report(table, key,
             std::string("position_correction is \"") + to_string(correction) +
                 "\"; set position_correction = \"" + to_string(of) + "\", or remove it",
             sentences);
}

}  // namespace

void warn_of_idle_keys(const Value& file, Scenario& scenario) {
  Sentences& sentences = scenario.warnings;
  if (const auto pipeline = file.find("pipeline"))
    report_pair_keys(*pipeline, scenario.pairs, scenario, sentences);
  if (const auto pairs = file.find("pairs"))
    for (const Value& entry : pairs->array_of_tables())
      report_pair_keys(entry, pair_of(entry, scenario), scenario, sentences);
  const std::vector<Value> shapes = file.require("shapes").members();
  for (int i = 0; i < count_of(shapes); ++i)
    if (!scenario.shape(i).deforms())
      report(at(shapes, i), "tree",
             "the mesh does not deform; give it motion = { deform = .. }, or remove it", sentences);
  if (std::ranges::any_of(scenario.shapes, &ScenarioShape::dynamic)) {
    if (const auto solver = file.find("solver"))
      report_solver_keys(*solver, scenario.solver.position_correction, sentences);
    return;
  }
  for (const char* name : {"world", "solver"}) {
    // A broad phase also uses [world] without dynamic shapes.
    if (name == std::string_view("world") && !scenario.broad_phase.empty()) continue;
    report(file, name,
           "no shape is dynamic; give one motion = { dynamic = true, mass = 1.0 }, or remove it",
           sentences);
  }
  for (const Value& shape : shapes)
    for (const char* key : {"friction", "restitution"})
      report(shape, key, "no shape is dynamic, and only the solver uses it; remove it", sentences);
}

}  // namespace contactscope::scenario_file
