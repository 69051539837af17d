#pragma once

#include "scenario/scenario.h"
#include "trace/json.h"

namespace contactscope::app {

/// What an engine needs to step a scene by itself, as src/versus/README.md lays it out: a header with the world,
/// and with friction and restitution of each shape; frame 0 with all poses, the pairs that are asked, and the
/// bodies with their mass, inertia and velocities; then a frame for each further one of the scenario, with the
/// poses of the scripted shapes that move. Metres, kilograms, seconds, world space.
///
/// The same poses, vertices and velocities as a run of the scenario begins with, rounded to its scalar. A scenario
/// without dynamic shapes has nothing to step: throws InputError, with the remedy.
trace::Trace rollout_request(const Scenario& scenario);

}  // namespace contactscope::app
