#include "broadphase/broad_phase.h"
#include "scenario/readers.h"

namespace contactscope::scenario_file {
namespace {

constexpr std::size_t kMaxPairs = 4096;  // per scenario, listed or by default

/// Rejects an incremental pair whose points cannot persist; `where` is the key that made it so.
void check_incremental(const ScenarioPair& pair, const std::vector<ScenarioShape>& shapes,
                       const Value& where) {
  if (pair.pipeline.manifold != ManifoldKind::Incremental || !pair.pipeline.makes_contacts())
    return;
  for (const int index : {pair.a, pair.b}) {
    const ScenarioShape& shape = at(shapes, index);
    if (kind_of(*shape.geometry) >= ShapeKind::Mesh)
      where.fail("incremental manifolds are made of spheres, capsules, hulls and planes, and '" +
                 shape.name + "' is a " + to_string(kind_of(*shape.geometry)) +
                 "; give its pairs manifold = \"one-shot\" in [[pairs]]");
  }
}

/// Reads the query of a pair; contradictions are errors of the key that causes them.
void read_question(const Value& table, Question& question) {
  table.read("query", question.kind);
  table.read("bounds", question.bounds);
  table.read("comparison", question.comparison);
  table.read("tolerance", question.tolerance);
  table.read("axes", question.test.axes);
  table.read("skip_up_to", question.test.skip_up_to);
  if (!question.inclusive() && question.tolerance > 0) {
    const auto key = table.find("tolerance") ? table.find("tolerance") : table.find("comparison");
    key->fail(
        "'tolerance' contradicts a comparison that leaves out touching; remove 'tolerance', or set "
        "comparison = "
        "\"inclusive\"");
  }
  if (question.bounds && (question.kind == QueryKind::Manifold)) {
    const auto key = table.find("bounds") ? table.find("bounds") : table.find("query");
    key->fail(
        "bounds have no contacts; set query = \"overlap\", \"touching\" or \"distance\", or "
        "remove 'bounds'");
  }
}

/// Rejects a [[pairs]] entry whose query is not supported. See also leave_out_unanswered().
void check_question(const ScenarioPair& pair, const std::vector<ScenarioShape>& shapes,
                    const Value& entry) {
  const Question& question = pair.pipeline.question;
  if (question.kind == QueryKind::Manifold) return;
  const auto kind = [&](int i) { return kind_of(*at(shapes, i).geometry); };
  const auto reason = refusal(question, kind(pair.a), kind(pair.b));
  if (!reason) return;
  const auto key = entry.find("query");
  (key ? *key : entry)
      .fail("'" + at(shapes, pair.a).name + "' and '" + at(shapes, pair.b).name +
            "' cannot be queried for \"" + to_string(question.kind) + "\": " + *reason);
}

/// Rejects a [[pairs]] entry with `continuous` if the time of impact of its shapes cannot be
/// computed. Under [pipeline] such pairs are skipped.
void check_continuous(const ScenarioPair& pair, const std::vector<ScenarioShape>& shapes,
                      const Value& entry) {
  const auto key = entry.find("continuous");
  if (!key || !pair.pipeline.continuous) return;
  const ScenarioShape &a = at(shapes, pair.a), &b = at(shapes, pair.b);
  if (const auto reason = impact_refusal(a, b, *pair.pipeline.continuous))
    key->fail("'" + a.name + "' and '" + b.name + "' have no continuous query: " + *reason);
}

/// The settings that [pipeline] and [[pairs]] share; all keys are checked, even without effect.
PipelineSettings read_settings(const Value& table, PipelineSettings settings) {
  table.read("manifold", settings.manifold);
  table.read("core_margin", settings.incremental.core_margin);
  table.read("breaking_distance", settings.incremental.breaking_distance);
  table.read("confirm", settings.incremental.confirm);
  table.read("too_close", settings.incremental.too_close);
  table.read("reducer", settings.reducer,
             [](const Value& value) { return value.one_of(names_in(reducers()), "reducer"); });
  table.read("max_points", settings.max_points);
  table.read("margin", settings.margin);
  table.read("cache", settings.cache);
  table.read("preference", settings.preference);
  table.read("penetration", settings.penetration);
  settings.question.penetration = settings.penetration;
  table.read("distance", settings.question.distance);
  read_question(table, settings.question);
  table.read("continuous", settings.continuous, [](const Value& value) {
    const int word = value.word();  // the first is "discrete"
    return word > 0 ? std::optional(static_cast<ImpactMethod>(word - 1)) : std::nullopt;
  });
  table.read("traversal", settings.traversal);
  table.read("field", settings.field);
  table.read("internal_edges", settings.internal_edges);
  table.read("mesh_manifolds", settings.mesh_manifolds);
  table.read("triangle", settings.triangle);
  table.read("degenerate", settings.degenerate);
  return settings;
}

/// Calls report(a, b) for all pairs of these shapes; if the scenario has dynamic shapes, only for
/// pairs with a dynamic one, since the solver cannot separate others. Returns the number of pairs.
template <class Report>
std::size_t pairs_among(const std::vector<int>& indices, const std::vector<ScenarioShape>& shapes,
                        const Report& report) {
  const bool any_dynamic = std::ranges::any_of(shapes, &ScenarioShape::dynamic);
  std::size_t count = 0;
  for (auto a = indices.begin(); a != indices.end(); ++a) {
    for (auto b = a + 1; b != indices.end(); ++b) {
      if (any_dynamic && !at(shapes, *a).dynamic() && !at(shapes, *b).dynamic()) continue;
      report(*a, *b);
      ++count;
    }
  }
  return count;
}

/// [x, y, z, separation], metres.
ContactPoint<double> read_patch_point(const Value& value) {
  if (!value.is_array() || value.array().size() != 4)
    value.fail("'" + value.name() +
               "' is a point with its separation; write [x, y, z, separation] in metres, where a "
               "negative separation is an overlap");
  const std::vector<double> numbers = value.numbers(4);
  return {{numbers[0], numbers[1], numbers[2]}, numbers[3], FeatureId()};
}

ScenarioPatch read_patch(const Value& value, std::size_t place) {
  const Value table = value.table({"patch"});
  ScenarioPatch patch;
  patch.name = "patch " + std::to_string(place + 1);
  table.read("name", patch.name, &Value::non_empty_string);
  patch.normal = read_direction(table.require("normal"));
  const Value points = table.require("points");
  patch.points = mapped(points.array(), read_patch_point);
  if (patch.points.empty())
    points.fail("'points' is empty; a patch has at least one, as [x, y, z, separation] in metres");
  if (patch.points.size() > kMaxManifoldPoints)
    points.fail("'points' has " + std::to_string(patch.points.size()) +
                " entries; a patch may have " + std::to_string(kMaxManifoldPoints));
  return patch;
}

/// Keys of [pipeline] that apply to patches; all others control how points are found.
constexpr std::string_view kPatchSettings[] = {"scalar", "reducer", "max_points"};

void warn_of_settings(const Value& pipeline, std::vector<std::string>& warnings) {
  for (const Value& setting : pipeline.members()) {
    if (std::ranges::find(kPatchSettings, setting.name()) != std::end(kPatchSettings)) continue;
    warnings.push_back("line " + std::to_string(setting.line()) + ": '" + setting.name() +
                       "' has no effect: a patch already has its points; remove it");
  }
}

}  // namespace

PipelineSettings read_pipeline(const Value& value) {
  const Value table = value.table({"pipeline"});
  PipelineSettings settings;
  table.read("scalar", settings.scalar);
  return read_settings(table, settings);
}

int shape_named(const Value& value, const std::vector<ScenarioShape>& shapes) {
  const std::string name = value.string();
  const auto found = std::ranges::find(shapes, name, &ScenarioShape::name);
  if (found != shapes.end()) return static_cast<int>(found - shapes.begin());
  value.fail("there is no shape '" + name + "'; " + near_or_all(name, names_in(shapes)));
}

std::vector<ScenarioPair> read_pairs(const Value& value, const std::vector<ScenarioShape>& shapes,
                                     const PipelineSettings& settings) {
  std::vector<ScenarioPair> pairs;
  std::set<std::tuple<int, int, std::string>> seen;
  const std::vector<Value> items = value.array_of_tables();
  if (items.size() > kMaxPairs)
    value.fail("there are " + std::to_string(items.size()) + " pairs; at most " +
               std::to_string(kMaxPairs) + " can be run");
  for (const Value& item : items) {
    const Value table = item.table({"pairs", "pipeline"});
    ScenarioPair pair;
    pair.a = shape_named(table.require("a"), shapes);
    const Value b = table.require("b");
    pair.b = shape_named(b, shapes);
    if (pair.a == pair.b) b.fail("'a' and 'b' are the same shape; a pair needs two");
    table.read("label", pair.label, &Value::non_empty_string);
    if (const auto scalar = table.find("scalar"))
      scalar->fail("'scalar' applies to the whole file; set it in [pipeline]");
    pair.pipeline = read_settings(table, settings);
    check_incremental(pair, shapes, item);
    check_question(pair, shapes, item);
    check_continuous(pair, shapes, item);
    if (!seen.emplace(std::min(pair.a, pair.b), std::max(pair.a, pair.b), pair.label).second)
      item.fail("these two shapes are already a pair; give each such entry its own 'label'");
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

std::string read_broad_phase(const std::optional<Value>& world, const std::optional<Value>& pairs) {
  const auto key = world ? world->table({"world"}).find("broad_phase") : std::nullopt;
  if (!key) return "";
  if (pairs)
    key->fail(
        "'broad_phase' chooses among all pairs, and [[pairs]] lists those to run; remove one");
  return key->string();
}

std::vector<ScenarioPair> every_pair(const std::vector<ScenarioShape>& shapes,
                                     const PipelineSettings& settings, const Value& where) {
  std::vector<int> all(shapes.size());
  std::iota(all.begin(), all.end(), 0);
  const std::size_t count = pairs_among(all, shapes, [](int, int) {});
  if (count > kMaxPairs)
    where.fail(std::to_string(shapes.size()) + " shapes make " + std::to_string(count) +
               " pairs; list those to run, at most " + std::to_string(kMaxPairs) +
               ", as [[pairs]], or let [world] broad_phase = \"tree\" choose them in each frame");
  std::vector<ScenarioPair> pairs;
  pairs_among(all, shapes, [&](int a, int b) {
    pairs.push_back({a, b, "", settings});
    check_incremental(pairs.back(), shapes, where);
  });
  return pairs;
}

std::vector<ScenarioPair> one_of_each_kind(const std::vector<ScenarioShape>& shapes,
                                           const PipelineSettings& settings, const Value& where) {
  std::map<std::pair<ShapeKind, bool>, int> seen;
  std::vector<int> first_two;
  for (int i = 0; i < count_of(shapes); ++i) {
    const ScenarioShape& shape = at(shapes, i);
    if (++seen[{kind_of(*shape.geometry), shape.dynamic()}] <= 2) first_two.push_back(i);
  }
  std::vector<ScenarioPair> pairs;
  std::set<std::pair<ShapeKind, ShapeKind>> taken;
  pairs_among(first_two, shapes, [&](int a, int b) {
    const auto kind = [&](int i) { return kind_of(*at(shapes, i).geometry); };
    if (!taken.insert(std::minmax(kind(a), kind(b))).second) return;
    pairs.push_back({a, b, "", settings});
    check_incremental(pairs.back(), shapes, where);
  });
  return pairs;
}

void leave_out_unanswered(Scenario& scenario) {
  std::set<std::string> record;
  std::erase_if(scenario.pairs, [&](const ScenarioPair& pair) {
    const ScenarioShape &a = scenario.shape(pair.a), &b = scenario.shape(pair.b);
    const ShapeKind kind_a = kind_of(*a.geometry), kind_b = kind_of(*b.geometry);
    const Question& question = pair.pipeline.question;
    const auto reason = refusal(question, kind_a, kind_b);
    if (!reason) return false;
    const std::string kind = pair_kind(*a.geometry, *b.geometry);
    if (!record.insert(kind).second) return true;
    const std::string both = "'" + a.name + "' and '" + b.name + "' ";
    scenario.warnings.push_back(
        both +
        (question.kind == QueryKind::Manifold
             ? "make no contacts: " + kind + " pairs are not collided, and left out"
             : "are left out: " + kind + " pairs cannot be queried for \"" +
                   to_string(question.kind) + "\"") +
        "; " + *reason);
    return true;
  });
}

void read_patches(const Value& file, const Value& value, Scenario& scenario) {
  for (const char* key : {"shapes", "pairs", "time", "world", "solver", "expect"})
    if (const auto other = file.find(key))
      other->fail(
          std::string("'") + key +
          "' needs shapes, and a file of [[patch]] has only points; remove it, or the patches");
  std::set<std::string> names;
  for (const Value& item : value.array_of_tables()) {
    scenario.patches.push_back(read_patch(item, scenario.patches.size()));
    if (!names.insert(scenario.patches.back().name).second)
      item.fail("two patches are named '" + scenario.patches.back().name +
                "'; give each its own 'name'");
  }
  if (scenario.patches.empty())
    value.fail("'patch' is empty; add a [[patch]] with its 'normal' and 'points'");
  if (!file.find("title") && scenario.patches.size() == 1)
    scenario.title = scenario.patches.front().name;
  if (const auto pipeline = file.find("pipeline")) {
    scenario.pipeline = read_pipeline(*pipeline);
    warn_of_settings(*pipeline, scenario.warnings);
  }
  scenario.scalar = scenario.pipeline.scalar;

  View plane;
  plane.kind = ViewKind::ContactPlane;
  scenario.views = {plane};
  if (const auto views = file.find("views")) {
    scenario.views = read_views(*views);
    const std::vector<Value> tables = views->array();
    for (std::size_t i = 0; i < tables.size(); ++i)
      if (scenario.views[i].kind != ViewKind::ContactPlane)
        tables[i].fail(
            "a patch has no shapes to draw, only points in a plane; set kind = "
            "\"contact_plane\", or leave 'views' out");
  }
  scenario.snapshots = read_snapshots(file.find("snapshots"), scenario.frames, scenario.views);
}

}  // namespace contactscope::scenario_file
