#include "scenario/pairs.h"

#include <algorithm>
#include <set>
#include <tuple>

#include "manifold/dispatch.h"
#include "reduce/reducer.h"
#include "scenario/placement.h"

namespace contactscope::scenario_file {
namespace {

using toml_reader::Keys;
using toml_reader::Table;
using toml_reader::Value;

// More points than a solver takes from one manifold.
constexpr int kMaxPoints = 64;

std::vector<std::string> reducer_names() {
  std::vector<std::string> names;
  for (const ReducerInfo& info : reducers()) names.push_back(info.name);
  return names;
}

double length_of(const Value& value, const char* key) {
  const double length = value.positive("metres");
  if (length > kLargestLength)
    value.fail("'" + std::string(key) + "' is larger than 1e9 metres; lower it");
  return length;
}

/// What incremental manifolds go by; the keys are checked also where they have no effect.
void read_manifold(const Table& table, PipelineSettings& settings) {
  if (const auto manifold = table.find("manifold"))
    settings.manifold = manifold->one_of({"one-shot", "incremental"}, "manifold") == "incremental"
                            ? ManifoldKind::Incremental
                            : ManifoldKind::OneShot;
  if (const auto core_margin = table.find("core_margin"))
    settings.incremental.core_margin = length_of(*core_margin, "core_margin");
  if (const auto breaking = table.find("breaking_distance"))
    settings.incremental.breaking_distance = length_of(*breaking, "breaking_distance");
  if (const auto confirm = table.find("confirm"))
    settings.incremental.confirm = confirm->one_of({"distance", "ids"}, "confirmation") == "ids"
                                       ? Confirm::Ids
                                       : Confirm::Distance;
}

/// Refuses a pair whose points cannot be kept; `at` is what made it incremental.
void check_incremental(const ScenarioPair& pair, const std::vector<ScenarioShape>& shapes,
                       const Value& at) {
  if (pair.pipeline.manifold != ManifoldKind::Incremental) return;
  for (const int index : {pair.a, pair.b}) {
    const ScenarioShape& shape = shapes[static_cast<std::size_t>(index)];
    if (kind_of(*shape.geometry) == ShapeKind::Mesh)
      at.fail("incremental manifolds are made of spheres, capsules, hulls and planes, and '" +
              shape.name + "' is a mesh; give its pairs manifold = \"one-shot\" in [[pairs]]");
  }
}

PenetrationMethod method_of(const Value& value) {
  constexpr PenetrationMethod kMethods[] = {PenetrationMethod::Sat, PenetrationMethod::Epa,
                                            PenetrationMethod::Mpr, PenetrationMethod::Sampling};
  std::vector<std::string> names;
  for (const PenetrationMethod method : kMethods) names.emplace_back(to_string(method));
  const std::string name = value.one_of(names, "penetration method");
  return kMethods[std::ranges::find(names, name) - names.begin()];
}

/// The settings that [pipeline] and a [[pairs]] entry share.
PipelineSettings read_settings(const Table& table, PipelineSettings settings) {
  read_manifold(table, settings);
  if (const auto reducer = table.find("reducer"))
    settings.reducer = reducer->one_of(reducer_names(), "reducer");
  if (const auto max_points = table.find("max_points"))
    settings.max_points = max_points->integer(1, kMaxPoints);
  if (const auto margin = table.find("margin")) {
    settings.margin = margin->not_negative("metres");
    if (settings.margin > kLargestLength)
      margin->fail("'margin' is larger than 1e9 metres; lower it");
  }
  if (const auto cache = table.find("cache")) settings.cache = cache->boolean();
  if (const auto preference = table.find("preference"))
    settings.preference = preference->one_of({"relative", "none"}, "preference") == "none"
                              ? Preference::None
                              : Preference::Relative;
  if (const auto penetration = table.find("penetration"))
    settings.penetration = method_of(*penetration);
  if (const auto internal_edges = table.find("internal_edges"))
    settings.internal_edges = internal_edges->boolean();
  if (const auto degenerate = table.find("degenerate"))
    settings.degenerate = degenerate->one_of({"fallback", "skip"}, "answer") == "skip"
                              ? Degenerate::Skip
                              : Degenerate::Fallback;
  return settings;
}

}  // namespace

PipelineSettings read_pipeline(const Value& value) {
  const Table table = value.table({"scalar", "manifold", "reducer", "max_points", "margin", "cache",
                                   "preference", "degenerate", "internal_edges", "core_margin",
                                   "breaking_distance", "confirm", "penetration"});
  PipelineSettings settings;
  if (const auto scalar = table.find("scalar"))
    settings.scalar =
        scalar->one_of({"float", "double"}, "scalar") == "double" ? Scalar::Double : Scalar::Float;
  return read_settings(table, settings);
}

int shape_named(const Value& value, const std::vector<ScenarioShape>& shapes) {
  const std::string name = value.string();
  const auto found = std::ranges::find(shapes, name, &ScenarioShape::name);
  if (found != shapes.end()) return static_cast<int>(found - shapes.begin());
  Keys names;
  for (const ScenarioShape& shape : shapes) names.push_back(shape.name);
  const std::string near = toml_reader::nearest(name, names);
  constexpr std::size_t kMostListed = 16;
  const bool all = names.size() <= kMostListed;
  if (!all) names.resize(kMostListed);
  value.fail("there is no shape '" + name + "'; " +
             (near.empty() ? "" : "did you mean '" + near + "'? ") + "the file has " +
             toml_reader::quoted_list(names) + (all ? "" : " and more"));
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
    const Table table =
        item.table({"a", "b", "label", "scalar", "manifold", "reducer", "max_points", "margin",
                    "cache", "preference", "degenerate", "internal_edges", "core_margin",
                    "breaking_distance", "confirm", "penetration"});
    ScenarioPair pair;
    pair.a = shape_named(table.require("a", "a = \"NAME\" of a shape"), shapes);
    const Value b = table.require("b", "b = \"NAME\" of a shape");
    pair.b = shape_named(b, shapes);
    if (pair.a == pair.b) b.fail("'a' and 'b' are the same shape; a pair needs two");
    if (const auto label = table.find("label")) pair.label = label->non_empty_string();
    if (const auto scalar = table.find("scalar"))
      scalar->fail("one scalar serves the whole file; set 'scalar' in [pipeline]");
    pair.pipeline = read_settings(table, settings);
    check_incremental(pair, shapes, item);
    if (!seen.emplace(std::min(pair.a, pair.b), std::max(pair.a, pair.b), pair.label).second)
      item.fail("these two shapes are paired already; give each such entry a 'label' of its own");
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

std::vector<ScenarioPair> every_pair(const std::vector<ScenarioShape>& shapes,
                                     const PipelineSettings& settings, const Value& at) {
  const auto dynamic = [&](int i) { return shapes[static_cast<std::size_t>(i)].body.has_value(); };
  const int shape_count = static_cast<int>(shapes.size());
  bool any_dynamic = false;
  for (int i = 0; i < shape_count; ++i) any_dynamic = any_dynamic || dynamic(i);
  std::vector<ScenarioPair> pairs;
  std::size_t count = 0;
  for (int a = 0; a < shape_count; ++a) {
    for (int b = a + 1; b < shape_count; ++b) {
      // What the solver cannot move apart is of interest only where it moves nothing at all.
      if (any_dynamic && !dynamic(a) && !dynamic(b)) continue;
      if (++count > kMaxPairs) continue;
      pairs.push_back({a, b, "", settings});
      check_incremental(pairs.back(), shapes, at);
    }
  }
  if (count > kMaxPairs)
    at.fail(std::to_string(shapes.size()) + " shapes make " + std::to_string(count) +
            " pairs; list those to run, at most " + std::to_string(kMaxPairs) + ", as [[pairs]]");
  return pairs;
}

std::vector<std::string> leave_out_uncollided(std::vector<ScenarioPair>& pairs,
                                              const std::vector<ScenarioShape>& shapes) {
  std::vector<std::string> sentences;
  std::set<std::string> told;
  std::erase_if(pairs, [&](const ScenarioPair& pair) {
    const ScenarioShape& a = shapes[static_cast<std::size_t>(pair.a)];
    const ScenarioShape& b = shapes[static_cast<std::size_t>(pair.b)];
    if (can_collide(kind_of(*a.geometry), kind_of(*b.geometry))) return false;
    const std::string kind = pair_kind(*a.geometry, *b.geometry);
    if (told.insert(kind).second)
      sentences.push_back("'" + a.name + "' and '" + b.name + "' make no contacts: " + kind +
                          " pairs are not collided, and left out");
    return true;
  });
  return sentences;
}

}  // namespace contactscope::scenario_file
