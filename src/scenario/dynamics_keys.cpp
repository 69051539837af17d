#include <algorithm>
#include <cmath>
#include <limits>

#include "dynamics/body.h"
#include "scenario/readers.h"

namespace contactscope::scenario_file {
namespace {

// A float can hold the inverses of masses and moments of inertia at all lengths of a scenario.
constexpr double kSmallestMass = 1e-9, kLargestMass = 1e9;  // kilograms
constexpr double kMaxFriction = 1000;
constexpr double kMaxGravity = 1e6;  // metres per second squared
constexpr int kMaxIterations = 10000;
constexpr int kMaxSubsteps = 1000;
constexpr double kMaxHertz = 1e6;
constexpr double kLongestRest = 1e6;  // seconds

double read_mass(const Value& table, const ScenarioShape& shape) {
  const auto mass = table.find("mass");
  const auto density = table.find("density");
  if (mass && density) density->fail("give 'mass' or 'density', not both");
  const Value dynamic = *table.find("dynamic");
  if (shape.hull() != nullptr && shape.hull()->flat())
    dynamic.fail("'" + shape.name +
                 "' is a flat hull, which has no volume and no mass; give it a point off its "
                 "plane, or leave out 'dynamic'");
  const std::optional<MassProperties> filled = mass_properties(*shape.geometry);
  if (!filled)
    dynamic.fail("'" + shape.name + "' is a " + shape.type +
                 ", which has no mass; the solver moves boxes, hulls, cylinders, cones, spheres "
                 "and capsules");
  if (!mass && !density)
    table.fail("'" + shape.name +
               "' is dynamic and has no mass; add mass = 1.0 (kilograms) or density = 1000 "
               "(kilograms per cubic metre)");
  const double kilograms = mass ? mass->positive("kilograms")
                                : density->positive("kilograms per cubic metre") * filled->mass;
  const Value& given = mass ? *mass : *density;
  if (kilograms < kSmallestMass || kilograms > kLargestMass)
    given.fail("'" + given.name() +
               "' makes the body too light or too heavy; bodies may have 1e-9 to 1e9 kg");
  return kilograms;
}

/// A reader for a number from zero to `most`.
auto at_most(double most, const char* unit = nullptr) {
  return [=](const Value& value) {
    const double number = value.not_negative(unit);
    if (number > most)
      value.fail("'" + value.name() + "' is larger than " +
                 std::to_string(static_cast<long long>(most)) + "; lower it");
    return number;
  };
}

SolverSettings read_solver_keys(const Value& value) {
  const Value& table = value.table({"iterations", "substeps", "position_correction", "warm_start",
                                    "baumgarte", "push_speed", "slop", "hertz", "damping_ratio",
                                    "speculative_margin", "sleep_after", "sleep_speed"});
  SolverSettings solver;
  table.read("iterations", solver.iterations, integer_in(1, kMaxIterations));
  table.read("substeps", solver.substeps, integer_in(1, kMaxSubsteps));
  table.read(
      "position_correction", solver.position_correction,
      word_of<PositionCorrection>({"baumgarte", "projection", "soft"}, "position correction"));
  table.read("warm_start", solver.warm_start, &Value::boolean);
  table.read("baumgarte", solver.baumgarte, read_share);
  table.read("push_speed", solver.push_speed, at_most(kLargestLength, "metres per second"));
  table.read("slop", solver.slop, at_most(kLargestLength, "metres"));
  table.read("hertz", solver.hertz, [](const Value& hertz) {
    hertz.positive("hertz");
    return at_most(kMaxHertz, "hertz")(hertz);
  });
  table.read("damping_ratio", solver.damping_ratio, at_most(kMaxHertz));
  table.read("speculative_margin", solver.speculative_margin, at_most(kLargestLength, "metres"));
  table.read("sleep_after", solver.sleep_after, at_most(kLongestRest, "seconds"));
  table.read("sleep_speed", solver.sleep_speed, at_most(kLargestLength, "metres per second"));
  return solver;
}

/// Metres: the smallest shortest_edge() of all dynamic shapes; 0 without any.
double smallest_size(const std::vector<ScenarioShape>& shapes) {
  double least = std::numeric_limits<double>::infinity();
  for (const ScenarioShape& shape : shapes) {
    if (!shape.dynamic()) continue;
    const MassProperties filled = *mass_properties(*shape.geometry);
    least = std::min(least, shortest_edge(filled.mass, filled.inertia));
  }
  return std::isfinite(least) ? least : 0;
}

}  // namespace

bool is_dynamic(const Value& motion) {
  const auto dynamic = motion.find("dynamic");  // read_motion rejects what is not a table
  return dynamic && dynamic->boolean();
}

ScenarioBody read_body(const Value& motion, const ScenarioShape& shape) {
  const Value& table = motion.table(
      {"dynamic", "mass", "density", "velocity", "angular_velocity", "keyframes", "deform"});
  if (const auto keyframes = table.find("keyframes"))
    keyframes->fail("'keyframes' and 'dynamic' both move the shape; leave one of them out");
  if (const auto deform = table.find("deform"))
    deform->fail("a dynamic shape cannot deform; leave out 'deform' or 'dynamic'");
  ScenarioBody body;
  body.mass = read_mass(table, shape);
  body.velocity = read_velocity(table, "velocity", "m/s");
  body.angular_velocity = read_velocity(table, "angular_velocity", "rad/s");
  return body;
}

WorldSettings read_world(const std::optional<Value>& value, const std::string& up) {
  WorldSettings world;
  if (up == "z") world.gravity = {0, 0, world.gravity.y()};
  if (!value) return world;
  const Value& table = value->table({"gravity", "friction", "restitution", "broad_phase"});
  if (const auto gravity = table.find("gravity")) {
    world.gravity = gravity->vector3();
    if (world.gravity.cwiseAbs().maxCoeff() > kMaxGravity)
      gravity->fail("'gravity' is stronger than 1e6 m/s^2; lower it");
  }
  table.read("friction", world.friction, read_friction);
  table.read("restitution", world.restitution, read_share);
  return world;
}

SolverSettings read_solver(const std::optional<Value>& value,
                           const std::vector<ScenarioShape>& shapes) {
  return settled(value ? read_solver_keys(*value) : SolverSettings(), smallest_size(shapes));
}

double read_friction(const Value& value) {
  return at_most(kMaxFriction)(value);
}

double read_share(const Value& value) {
  const double share = value.not_negative();
  if (share > 1) value.fail("'" + value.name() + "' is a fraction; give a number from 0 to 1");
  return share;
}

}  // namespace contactscope::scenario_file
