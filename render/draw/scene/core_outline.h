#pragma once

#include <cstddef>
#include <vector>

#include "core/vec3.h"
#include "draw/scene/camera.h"

namespace contactscope::draw {

struct PlacedShape;

/// What is left of a hull when a margin is taken off its faces; world, metres.
struct CoreSolid {
  struct Edge {
    Vec3d from, to;
    std::size_t left, right;  // faces of the hull whose core faces meet in it
  };
  std::vector<Edge> edges;  // each once
  std::vector<Vec3d> corners;
};

/// Empty where nothing is left.
CoreSolid core_solid(const PlacedShape& shape, double margin);

/// Where view rays touch all that is within `radius` of the hull of `corners`: a closed curve, round
/// about the corners. Empty without corners, and for an eye inside.
std::vector<Vec3d> rounded_outline(const std::vector<Vec3d>& corners, double radius,
                                   const Camera& camera);

}  // namespace contactscope::draw
