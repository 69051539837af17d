#include "app/compare/rollout_request.h"

#include "core/at.h"
#include "core/input_error.h"
#include "dynamics/body.h"
#include "scenario/run.h"
#include "versus/request.h"

namespace contactscope::app {
namespace {

/// Pose as in a run, rounded to the scenario's scalar.
Pose<double> scripted_pose(const Scenario& scenario, const ScenarioShape& shape, double time) {
  Pose<double> pose = collider_pose_at(shape, time);
  if (scenario.scalar == Scalar::Float) pose = pose.cast<float>().cast<double>();
  return recorded_pose(shape, time, pose);
}

std::vector<Vec3d> inertia_of(const ScenarioShape& shape) {
  const MassProperties filled = with_mass(*mass_properties(*shape.collider), shape.body->mass);
  std::vector<Vec3d> rows;
  for (int row = 0; row < 3; ++row) rows.push_back(filled.inertia.row(row).transpose());
  return rows;
}

}  // namespace

trace::Trace rollout_request(const Scenario& scenario) {
  if (std::ranges::none_of(scenario.shapes, &ScenarioShape::dynamic))
    throw InputError(scenario.path, 0, 0,
                     "no shape is dynamic, so there is nothing to step; add motion = { "
                     "dynamic = true, mass = 1.0 } to one, or leave out --rollout");
  Runner runner(scenario, trace::Stages::none());
  trace::Trace start{runner.header(), {runner.frame(0)}};
  trace::Trace request = versus::request_of(start);
  request.header.frames = scenario.frames;
  request.header.world = trace::World{scenario.world.gravity, scenario.dt};
  for (std::size_t i = 0; i < scenario.shapes.size(); ++i) {
    const ScenarioShape& shape = scenario.shapes[i];
    trace::Shape& record = request.header.shapes[i];
    record.friction = shape.friction.value_or(scenario.world.friction);
    record.restitution = shape.restitution.value_or(scenario.world.restitution);
  }
  trace::Solver& solver = request.frames.front().solver.emplace();
  solver = *start.frames.front().solver;
  solver.stops.clear();
  for (trace::Body& body : solver.bodies)
    body.inertia = inertia_of(*std::ranges::find(scenario.shapes, body.name, &ScenarioShape::name));
  for (int number = 1; number < scenario.frames; ++number) {
    trace::Frame& frame = request.frames.emplace_back();
    frame.frame = number;
    frame.time = number * scenario.dt;
    for (const ScenarioShape& shape : scenario.shapes)
      if (!shape.dynamic() && !(shape.motion.keyframes.empty() && shape.motion.velocity.isZero(0) &&
                                shape.motion.angular_velocity.isZero(0)))
        frame.poses.emplace_back(shape.name, scripted_pose(scenario, shape, frame.time));
  }
  return request;
}

}  // namespace contactscope::app
