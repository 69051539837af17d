#include <cmath>

#include "core/at.h"
#include "manifold/dispatch.h"
#include "scenario/readers.h"

namespace contactscope::scenario_file {
namespace {

constexpr int kMostPoints = 4096;  // more than any manifold holds; catches a slip of the pen

/// Refuses an expectation of a pair that does not run; `at` is the key that names its shape a.
void require_pair(const Expectation& expectation, const Scenario& scenario, const Value& at) {
  const std::string a = "'" + scenario.shape(expectation.a).name + "'";
  const std::string b = "'" + scenario.shape(expectation.b).name + "'";
  Keys labels;
  bool swapped = false;
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
  if (!can_collide(kind_of(shape_a), kind_of(shape_b)))
    at.fail("nothing can be expected of " + both + ": " + pair_kind(shape_a, shape_b) +
            " pairs are not collided; remove this entry");
  at.fail("the pair " + both + " is not run; list it in [[pairs]]");
}

Expectation read_expectation(const Value& value, const Scenario& scenario) {
  const Value& table = value.table({"frames", "a", "b", "label", "state", "points", "axis", "type",
                                    "normal", "separation", "load", "tolerance"});
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
  const Value a = table.require("a", "a = \"NAME\" of a shape");
  const Value b = table.require("b", "b = \"NAME\" of a shape");
  expectation.a = shape_named(a, scenario.shapes);
  expectation.b = shape_named(b, scenario.shapes);
  if (expectation.a == expectation.b) b.fail("'a' and 'b' are the same shape; a pair needs two");
  table.read("label", expectation.label, &Value::non_empty_string);
  require_pair(expectation, scenario, a);

  if (const auto state = table.find("state"))
    expectation.state = state->one_of({"touching", "separated"}, "state");
  if (const auto points = table.find("points")) {
    expectation.points = points->integer(0, kMostPoints);
    if (expectation.state && (*expectation.state == "touching") == (*expectation.points == 0))
      points->fail(
          "'points' contradicts 'state'; a touching pair has points, a separated has none");
  }
  if (const auto axis = table.find("axis"))
    expectation.axis = axis->one_of({"face_a", "face_b", "edge_edge", "closest_points"}, "axis");
  if (const auto type = table.find("type"))
    expectation.type = type->one_of(
        {"point-point", "point-edge", "point-face", "edge-edge", "edge-face", "face-face"},
        "contact type");
  if (const auto normal = table.find("normal")) {
    expectation.normal = normal->vector3();
    // Loose enough for three written digits; a vector that was never normalised is far off.
    if (!(std::abs(expectation.normal->norm() - 1) <= 1e-2))
      normal->fail("'normal' has length " + std::to_string(expectation.normal->norm()) +
                   "; give a unit vector from a to b");
  }
  table.read("separation", expectation.separation,
             [](const Value& separation) { return separation.number("metres"); });
  if (const auto load = table.find("load")) {
    expectation.load = load->not_negative("newtons");
    if (!scenario.shape(expectation.a).dynamic() && !scenario.shape(expectation.b).dynamic())
      load->fail("'load' is what the solver gives, and neither shape is dynamic");
  }
  table.read("tolerance", expectation.tolerance,
             [](const Value& tolerance) { return tolerance.not_negative("metres"); });
  if (!expectation.state && !expectation.points && !expectation.axis && !expectation.type &&
      !expectation.normal && !expectation.separation && !expectation.load)
    value.fail(
        "this entry expects nothing; add state, points, axis, type, normal, separation or load");
  return expectation;
}

}  // namespace

std::vector<Expectation> read_expectations(const Value& value, const Scenario& scenario) {
  return mapped(value.array_of_tables(),
                [&](const Value& item) { return read_expectation(item, scenario); });
}

}  // namespace contactscope::scenario_file
