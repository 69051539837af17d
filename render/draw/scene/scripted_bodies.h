#pragma once

#include <span>
#include <vector>

#include "draw/scene/scene.h"

/// Motion of shapes that are not moved by a solver.
namespace contactscope::draw {

/// Shapes whose pose differs `seconds` later (earlier if negative), as bodies with that motion.
std::vector<trace::Body> scripted_bodies(const ShapeMeshes& meshes,
                                         std::span<const trace::Placement> now,
                                         std::span<const trace::Placement> later, double seconds);

}  // namespace contactscope::draw
