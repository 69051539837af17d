#pragma once

#include <span>
#include <vector>

#include "draw/scene/camera.h"
#include "draw/scene/sketch.h"

/// Convex polygons of the screen, and what of one another they leave to be seen.
namespace contactscope::draw {

using Outline = std::vector<Vec2d>;  // convex, pixels, in the winding of convex_polygon()

Outline as_outline(const std::vector<Point2>& polygon);

/// What of the polygons is outside of a convex one, in pieces of a quarter of a pixel at least.
std::vector<Outline> without(const std::vector<Outline>& polygons, const Outline& hole);

/// The bodies among the surfaces that are seen before a polygon of the screen: flat faces one by
/// one, round bodies as a whole. None where they have too many faces to tell.
std::vector<Outline> outlines_before(const std::vector<Point2>& polygon, const Camera& camera,
                                     std::span<const Surface> surfaces);

}  // namespace contactscope::draw
