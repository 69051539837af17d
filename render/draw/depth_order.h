#pragma once

#include <vector>

#include "core/vec3.h"
#include "draw/camera.h"
#include "draw/drawing.h"

namespace contactscope::draw {

/// A flat convex polygon in the world, metres.
struct Surface {
  std::vector<Vec3d> polygon;
  Color color;
};

/// The surfaces in the order in which to paint them, farthest first, cut where they pass through
/// each other, so that translucent colours blend right in every pixel. Surfaces in one plane keep
/// their given order: a highlight that follows the face on which it lies is painted over it.
///
/// Binary space partition after Fuchs, Kedem and Naylor 1980. Steps: take the largest surface as
/// the root, so that small ones are cut by large ones and not the reverse; cut the others by its
/// plane; do the same with both sides; walk the tree from the far side to the near side of each
/// plane.
std::vector<Surface> depth_ordered(std::vector<Surface> surfaces, const Camera& camera);

}  // namespace contactscope::draw
