#include "core/spell.h"
#include "scenario/readers.h"
#include "scenario/run.h"
#include "trace/find.h"

namespace contactscope::scenario_file {
namespace {

/// Rejects an expectation for a pair that does not run; `at` is the key with the name of shape a.
void require_pair(const Expectation& expectation, const Scenario& scenario, const Value& at) {
  const std::string a = "'" + scenario.shape(expectation.a).name + "'";
  const std::string b = "'" + scenario.shape(expectation.b).name + "'";
  if (!scenario.broad_phase.empty() && !expectation.label.empty())
    at.fail("pairs that a broad phase chooses have no labels; remove 'label'");
  Keys labels;
  bool swapped = !scenario.broad_phase.empty() && expectation.b < expectation.a;
  for (const ScenarioPair& pair : scenario.pairs) {
    if (pair.a == expectation.a && pair.b == expectation.b) {
      if (pair.label == expectation.label) return;
      labels.push_back(pair.label);
    }
    swapped = swapped || (pair.a == expectation.b && pair.b == expectation.a);
  }
  const std::string both = a + " and " + b;
  if (!labels.empty()) {
    const bool plain = labels.size() == 1 && labels[0].empty();
    at.fail("the pair " + both + " has no entry with " +
            (expectation.label.empty() ? "no label" : "the label '" + expectation.label + "'") +
            "; " + (plain ? "it has no label" : "labels: " + quoted_list(labels)));
  }
  if (swapped)
    at.fail("the pair is a = " + b + ", b = " + a +
            "; swap them here, the normal points from a to b");
  const Shape<double>& shape_a = *scenario.shape(expectation.a).geometry;
  const Shape<double>& shape_b = *scenario.shape(expectation.b).geometry;
  const Question& question = scenario.pipeline.question;
  if (refusal(question, kind_of(shape_a), kind_of(shape_b)))
    at.fail("no expectation is possible for " + both + ": " + pair_kind(shape_a, shape_b) +
            " pairs " +
            (question.kind == QueryKind::Manifold
                 ? std::string("are not collided")
                 : std::string("cannot be queried for \"") + to_string(question.kind) + "\"") +
            "; remove this entry");
  if (scenario.broad_phase.empty())
    at.fail("the pair " + both + " is not run; list it in [[pairs]]");
}

/// Settings of an expectation's pair; require_pair has checked that it exists.
const PipelineSettings& settings_of(const Expectation& expectation, const Scenario& scenario) {
  for (const ScenarioPair& pair : scenario.pairs)
    if (pair.a == expectation.a && pair.b == expectation.b && pair.label == expectation.label)
      return pair.pipeline;
  return scenario.pipeline;
}

/// Reads what is expected between frames.
void read_between_frames(const Value& table, const Scenario& scenario, Expectation& expectation) {
  const PipelineSettings& settings = settings_of(expectation, scenario);
  for (const char* key : {"impact", "impact_time", "ghosts", "stops"}) {
    const auto value = table.find(key);
    if (!value) continue;
    const std::string quoted = std::string("'") + key + "'";
    if (!settings.continuous)
      value->fail(quoted + " needs continuous collision detection; set 'continuous' for the pair");
    if (key == std::string_view("ghosts") && settings.continuous != ImpactMethod::Speculative)
      value->fail(
          "'ghosts' are speculative contacts; set continuous = \"speculative\", or expect an "
          "impact");
    if (key == std::string_view("stops") && !scenario.shape(expectation.a).dynamic() &&
        !scenario.shape(expectation.b).dynamic())
      value->fail("'stops' need the solver, and neither shape is dynamic; expect an impact");
  }
  table.read("impact", expectation.impact);
  table.read("impact_time", expectation.impact_time);
  if (expectation.impact_time && expectation.impact.value_or("hit") != "hit")
    table.find("impact_time")->fail("'impact_time' contradicts 'impact'; only a hit has a time");
  table.read("ghosts", expectation.ghosts);
  table.read("stops", expectation.stops);
}

/// Rejects contact keys for a pair without contacts, and answer keys for a pair without a query.
void require_answers(const Value& table, const Question& question) {
  const auto refuse = [&](const Keys& keys, const std::string& why) {
    for (const std::string_view key : keys)
      if (const auto value = table.find(key)) value->fail("'" + std::string(key) + "' " + why);
  };
  const std::string requested = std::string("\"") + to_string(question.kind) + "\"";
  if (question.kind == QueryKind::Manifold) {
    refuse({"overlap", "touching", "intersections"},
           "needs a query; set query = \"overlap\" for the pair, or expect a state");
    return;
  }
  refuse({"points", "axis", "type", "load"}, "needs contacts, and the pair's query is " +
                                                 requested +
                                                 "; expect overlap, separation or normal");
  if (question.kind != QueryKind::Touching)
    refuse({"touching"},
           "needs query = \"touching\", and the pair's query is " + requested + "; expect overlap");
}

/// Rejects intersections for a pair that is not tested triangle by triangle.
void require_triangles(const Value& count, const Expectation& expectation,
                       const Scenario& scenario) {
  for (const int index : {expectation.a, expectation.b}) {
    const ScenarioShape& shape = scenario.shape(index);
    if (!shape.is_mesh())
      count.fail("'intersections' need two meshes, and '" + shape.name +
                 "' is not a mesh; expect overlap");
  }
  if (settings_of(expectation, scenario).question.bounds)
    count.fail(
        "'intersections' count triangles, and the pair's query tests bounds; expect overlap, or "
        "remove 'bounds'");
}

Expectation read_expectation(const Value& value, const Scenario& scenario) {
  const Value table = value.table({"expect"});
  Expectation expectation;
  expectation.line = value.line();
  expectation.last_frame = scenario.frames - 1;
  if (const auto frames = table.find("frames")) {
    const std::vector<Value> range = frames->array();
    if (range.size() != 2)
      frames->fail("'frames' is the first and the last frame, such as [0, 23]");
    expectation.first_frame = range[0].integer(0, scenario.frames - 1);
    expectation.last_frame = range[1].integer(0, scenario.frames - 1);
    if (expectation.last_frame < expectation.first_frame)
      range[1].fail("'frames' ends before it begins; write the first frame first");
  }
  const Value a = table.require("a"), b = table.require("b");
  expectation.a = shape_named(a, scenario.shapes);
  expectation.b = shape_named(b, scenario.shapes);
  if (expectation.a == expectation.b) b.fail("'a' and 'b' are the same shape; a pair needs two");
  table.read("label", expectation.label, &Value::non_empty_string);
  require_pair(expectation, scenario, a);
  require_answers(table, settings_of(expectation, scenario).question);

  table.read("state", expectation.state);
  table.read("points", expectation.points);
  if (expectation.points && expectation.state &&
      (*expectation.state == "touching") == (*expectation.points == 0))
    table.find("points")->fail(
        "'points' contradicts 'state'; a touching pair has points, a separated one has none");
  table.read("axis", expectation.axis);
  table.read("type", expectation.type);
  if (const auto normal = table.find("normal")) {
    expectation.normal = normal->vector3();
    // Tolerates three written digits; a vector that was never normalised is far off.
    if (!(std::abs(expectation.normal->norm() - 1) <= 1e-2))
      normal->fail("'normal' has length " + std::to_string(expectation.normal->norm()) +
                   "; give a unit vector from a to b");
  }
  table.read("separation", expectation.separation);
  if (const auto load = table.find("load")) {
    expectation.load = load->number();
    if (!scenario.shape(expectation.a).dynamic() && !scenario.shape(expectation.b).dynamic())
      load->fail("'load' needs the solver, and neither shape is dynamic; remove it");
  }
  if (const auto asleep = table.find("asleep")) {
    expectation.asleep = asleep->boolean();
    if (!scenario.solver.sleep_after)
      asleep->fail("'asleep' needs bodies that can sleep; set [solver] sleep_after = 0.5");
  }
  table.read("tolerance", expectation.tolerance);
  table.read("overlap", expectation.overlap);
  table.read("touching", expectation.touching);
  if (const auto count = table.find("intersections")) {
    require_triangles(*count, expectation, scenario);
    expectation.intersections = count->integer();
  }
  read_between_frames(table, scenario, expectation);
  Keys facts;  // their default is any value
  for (const Key& key : key_table("expect").keys)
    if (key.otherwise == "any") facts.push_back(key.name);
  if (std::ranges::none_of(facts,
                           [&](std::string_view key) { return table.find(key).has_value(); }))
    value.fail("this entry expects nothing; add one of " + quoted_list(facts));
  return expectation;
}

}  // namespace

std::vector<Expectation> read_expectations(const Value& value, const Scenario& scenario) {
  return mapped(value.array_of_tables(),
                [&](const Value& item) { return read_expectation(item, scenario); });
}

}  // namespace contactscope::scenario_file

namespace contactscope {
namespace {

std::string spell(const Vec3d& v) { return "[" + separated(v, ", ", shortest) + "]"; }

/// A computed number in six digits, or in all if six do not distinguish it from the expected one.
std::string spell_got(double value, double expected) {
  const std::string text = printed("%.6g", value);
  return text == shortest(expected) && value != expected ? shortest(value) : text;
}

std::string spell_got(const Vec3d& v, const Vec3d& expected) {
  return "[" + spell_got(v.x(), expected.x()) + ", " + spell_got(v.y(), expected.y()) + ", " +
         spell_got(v.z(), expected.z()) + "]";
}

/// One failed expectation.
struct Unmet {
  std::string wanted;  // "expected 4 points"
  std::string got;     // "2"; empty if the first text is complete
};

using Direction = std::pair<std::string, Vec3d>;

/// One per manifold, or the separating axis; empty if neither is recorded.
std::vector<Direction> directions_of(const trace::Pair& pair) {
  std::vector<Direction> directions;
  for (const trace::Manifold& manifold : pair.manifolds)
    directions.emplace_back(manifold.axis, manifold.normal);
  if (!directions.empty()) return directions;
  if (pair.cache && pair.cache->normal)
    directions.emplace_back(pair.cache->axis, *pair.cache->normal);
  const auto add_chosen = [&](const char* name, const auto& axis) {
    if (axis && pair.sat->chosen == name) directions.emplace_back(name, axis->normal);
  };
  if (pair.query && pair.query->normal) directions.emplace_back("", *pair.query->normal);
  if (!pair.sat) return directions;
  add_chosen("face_a", pair.sat->face_a);
  add_chosen("face_b", pair.sat->face_b);
  add_chosen("edge_edge", pair.sat->edge);
  return directions;
}

void add_count(const char* thing, const std::optional<int>& wanted, int got,
               std::vector<Unmet>& list) {
  if (!wanted || got == *wanted) return;
  list.push_back({"expected " + counted(*wanted, thing), std::to_string(got)});
}

/// Adds what is not as expected in the step after the frame.
void add_between_frames(const Expectation& expected, const trace::Pair& pair,
                        const trace::Frame* frame, std::vector<Unmet>& list) {
  const std::string status = pair.impact ? pair.impact->status : "not queried";
  if (expected.impact && status != *expected.impact)
    list.push_back({"expected impact " + *expected.impact, status});
  if (expected.impact_time) {
    const double time = status == "hit" ? pair.impact->time : -1;
    if (!(std::abs(time - *expected.impact_time) <= expected.tolerance))
      list.push_back({"expected an impact at " + shortest(*expected.impact_time) + " of the step",
                      status == "hit" ? spell_got(time, *expected.impact_time) : status});
  }
  add_count("ghost", expected.ghosts, pair.impact ? count_of(pair.impact->ghosts) : 0, list);
  const auto is_of_pair = [&](const trace::Stop& stop) {
    return std::minmax(stop.a, stop.b) == std::minmax(pair.a, pair.b);
  };
  const auto stops = frame != nullptr && frame->solver
                         ? std::ranges::count_if(frame->solver->stops, is_of_pair)
                         : 0;
  add_count("stop", expected.stops, static_cast<int>(stops), list);
}

bool sleeps(const trace::Pair& pair, const trace::Frame* frame) {
  return frame != nullptr && frame->solver &&
         std::ranges::none_of(frame->solver->bodies, [&](const trace::Body& body) {
           return (body.name == pair.a || body.name == pair.b) && body.asleep != true;
         });
}

/// Failed expectations of `pair`. `frame` is the pair's frame; null if it did not run.
std::vector<Unmet> unmet(const Expectation& expected, const trace::Pair& pair, double dt,
                         const trace::Frame* frame) {
  std::vector<Unmet> list;
  add_between_frames(expected, pair, frame, list);
  if (expected.state && pair.state != *expected.state)
    list.push_back({"expected " + *expected.state,
                    pair.state + " with separation " + spell_got(pair.separation, 0) + " m"});
  const auto wants = [&](const char* what, const std::optional<bool>& wanted,
                         const std::optional<bool>& got) {
    if (!wanted || got == wanted) return;
    const std::string not_so = std::string("no ") + what;
    list.push_back({"expected " + (*wanted ? what : not_so), *wanted ? not_so : what});
  };
  wants("overlap", expected.overlap, pair.overlap.value_or(false));
  wants("touching", expected.touching,
        pair.query && pair.query->touching ? *pair.query->touching : false);
  wants("sleep", expected.asleep, sleeps(pair, frame));
  add_count("intersection", expected.intersections, count_of(pair.intersections), list);
  add_count("point", expected.points, count_of(joined(pair.manifolds, &trace::Manifold::points)),
            list);
  const std::vector<Direction> directions = directions_of(pair);
  const auto wants_axis = [&] { return "expected axis " + *expected.axis; };
  const auto wants_normal = [&] { return "expected normal " + spell(*expected.normal); };
  if (expected.axis && directions.empty()) list.push_back({wants_axis(), "none"});
  if (expected.normal && directions.empty()) list.push_back({wants_normal(), "none"});
  const std::string tolerance = " (tolerance " + shortest(expected.tolerance);
  for (const auto& [axis, normal] : directions) {
    if (expected.axis && axis != *expected.axis) list.push_back({wants_axis(), axis});
    // Negated so that nan is never within the tolerance.
    if (expected.normal &&
        !((normal - *expected.normal).cwiseAbs().array() <= expected.tolerance).all())
      list.push_back({wants_normal(), spell_got(normal, *expected.normal) + tolerance + ")"});
  }
  if (expected.type && pair.manifolds.empty())
    list.push_back({"expected type " + *expected.type, "none"});
  for (const trace::Manifold& manifold : pair.manifolds)
    if (expected.type && manifold.type != *expected.type)
      list.push_back({"expected type " + *expected.type, manifold.type});
  if (expected.separation &&
      !(std::abs(pair.separation - *expected.separation) <= expected.tolerance))
    list.push_back({"expected separation " + shortest(*expected.separation) + " m",
                    spell_got(pair.separation, *expected.separation) + " m" + tolerance + ")"});
  if (expected.load) {
    const double load = trace::impulse_of(pair) / dt;
    if (!(std::abs(load - *expected.load) <= expected.tolerance * *expected.load))
      list.push_back({"expected load " + shortest(*expected.load) + " N",
                      spell_got(load, *expected.load) + " N" + tolerance + " of it)"});
  }
  return list;
}

/// The failures of one expectation in a frame.
std::vector<Unmet> unmet(const Scenario& scenario, const Expectation& expected,
                         const trace::Frame& frame) {
  if (frame.frame < expected.first_frame || frame.frame > expected.last_frame) return {};
  const auto pair = std::ranges::find_if(frame.pairs, [&](const trace::Pair& p) {
    return p.a == scenario.shape(expected.a).name && p.b == scenario.shape(expected.b).name &&
           p.label == expected.label;
  });
  if (pair == frame.pairs.end() && !scenario.broad_phase.empty()) {
    trace::Pair gap;
    gap.state = "separated";
    if (expected.separation) return {{"their bounding boxes are separated", ""}};
    return unmet(expected, gap, scenario.dt, nullptr);
  }
  if (pair == frame.pairs.end()) return {{"the frame has no such pair", ""}};
  return unmet(expected, *pair, scenario.dt, &frame);
}

/// "frame 3", "frames 0 to 2", "3 frames from 0 to 9". `frames` is ascending.
std::string spell_frames(const std::vector<int>& frames) {
  const std::string first = std::to_string(frames.front()), last = std::to_string(frames.back());
  if (frames.size() == 1) return "frame " + first;
  const auto length = static_cast<std::size_t>(frames.back() - frames.front()) + 1;
  return (frames.size() == length ? "frames " : std::to_string(frames.size()) + " frames from ") +
         first + " to " + last;
}

/// One failure in several frames.
struct Repeated {
  Unmet first;
  std::vector<int> frames;
  bool alike = true;  // every frame got the same
};

}  // namespace

std::vector<std::string> unmet_expectations(const Scenario& scenario,
                                            const std::vector<trace::Frame>& frames) {
  std::vector<std::string> sentences;
  for (const Expectation& expected : scenario.expectations) {
    std::vector<Repeated> list;
    for (const trace::Frame& frame : frames) {
      for (Unmet& one : unmet(scenario, expected, frame)) {
        const auto known = std::ranges::find_if(
            list, [&](const Repeated& other) { return other.first.wanted == one.wanted; });
        if (known == list.end()) {
          list.push_back({std::move(one), {frame.frame}});
          continue;
        }
        known->alike = known->alike && known->first.got == one.got;
        if (known->frames.back() != frame.frame) known->frames.push_back(frame.frame);
      }
    }
    const std::string &a = scenario.shape(expected.a).name, &b = scenario.shape(expected.b).name;
    for (const Repeated& one : list) {
      std::string sentence = scenario.path + ":" + std::to_string(expected.line) + ": " +
                             spell_frames(one.frames) + ", " + a + "-" + b +
                             (expected.label.empty() ? "" : " (" + expected.label + ")") + ": " +
                             one.first.wanted;
      if (!one.first.got.empty()) sentence += ", got " + one.first.got;
      if (!one.alike) sentence += "; other frames differ";
      sentences.push_back(std::move(sentence));
    }
  }
  return sentences;
}

}  // namespace contactscope
