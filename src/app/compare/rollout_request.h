#pragma once

#include "scenario/scenario.h"
#include "trace/json.h"

namespace contactscope::app {

/// Data for an engine to step a scene, see src/versus/README.md. The header has the world and each
/// shape's friction and restitution. Frame 0 has all poses, the pairs to query, and the bodies with
/// mass, inertia and velocities. Later frames have the poses of moving scripted shapes. Metres,
/// kilograms, seconds, world space.
///
/// Poses, vertices and velocities are those at the start of a run, rounded to the scenario's
/// scalar. Throws InputError with a remedy if the scenario has no dynamic shapes.
trace::Trace rollout_request(const Scenario& scenario);

}  // namespace contactscope::app
