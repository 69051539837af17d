#pragma once

#include <span>
#include <vector>

#include "draw/scene/scene.h"

/// How shapes move that no solver moves.
namespace contactscope::draw {

/// The shapes that are elsewhere `seconds` later, or earlier where these are negative, as bodies with
/// the velocities that take them there.
std::vector<trace::Body> scripted_bodies(const ShapeMeshes& meshes,
                                         std::span<const trace::Placement> now,
                                         std::span<const trace::Placement> later, double seconds);

}  // namespace contactscope::draw
