#include "dynamics/body.h"
#include "scenario/readers.h"

namespace contactscope::scenario_file {
namespace {

// A float can hold the inverses of masses and moments of inertia at all lengths of a scenario.
constexpr double kSmallestMass = 1e-9, kLargestMass = 1e9;  // kilograms
double read_mass(const Value& table, const ScenarioShape& shape) {
  table.not_both("mass", "density");
  const auto mass = table.find("mass"), density = table.find("density");
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
  const double kilograms = mass ? mass->number() : density->number() * filled->mass;
  if (kilograms < kSmallestMass || kilograms > kLargestMass)
    density->fail(
        "'density' makes the body too light or too heavy; bodies may have 1e-9 to 1e9 kg");
  return kilograms;
}

SolverSettings read_solver_keys(const Value& value) {
  const Value table = value.table({"solver"});
  SolverSettings solver;
  table.read("iterations", solver.iterations);
  table.read("substeps", solver.substeps);
  table.read("position_correction", solver.position_correction);
  table.read("warm_start", solver.warm_start);
  table.read("baumgarte", solver.baumgarte);
  table.read("push_speed", solver.push_speed);
  table.read("slop", solver.slop);
  table.read("hertz", solver.hertz);
  table.read("damping_ratio", solver.damping_ratio);
  table.read("speculative_margin", solver.speculative_margin);
  table.read("sleep_after", solver.sleep_after);
  table.read("sleep_speed", solver.sleep_speed);
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
  const Value table = motion.table({"motion"});
  if (const auto keyframes = table.find("keyframes"))
    keyframes->fail("'keyframes' and 'dynamic' both move the shape; leave one of them out");
  if (const auto deform = table.find("deform"))
    deform->fail("a dynamic shape cannot deform; leave out 'deform' or 'dynamic'");
  ScenarioBody body;
  body.mass = read_mass(table, shape);
  table.read("velocity", body.velocity);
  table.read("angular_velocity", body.angular_velocity);
  return body;
}

WorldSettings read_world(const std::optional<Value>& value, const std::string& up) {
  WorldSettings world;
  if (up == "z") world.gravity = {0, 0, world.gravity.y()};
  if (!value) return world;
  const Value table = value->table({"world"});
  table.read("gravity", world.gravity);
  table.read("friction", world.friction);
  table.read("restitution", world.restitution);
  return world;
}

SolverSettings read_solver(const std::optional<Value>& value,
                           const std::vector<ScenarioShape>& shapes) {
  return settled(value ? read_solver_keys(*value) : SolverSettings(), smallest_size(shapes));
}

}  // namespace contactscope::scenario_file
