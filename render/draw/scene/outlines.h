#pragma once

#include <span>
#include <vector>

#include "draw/scene/camera.h"
#include "draw/scene/sketch.h"

/// Convex polygons on the screen and their visible parts.
namespace contactscope::draw {

using Outline = std::vector<Vec2d>;  // convex, pixels, in the winding of convex_polygon()

Outline as_outline(const std::vector<Point2>& polygon);

/// Convex outline of points in the world; empty if fewer than three are in front of the camera.
Outline outline_around(const Camera& camera, std::span<const Vec3d> points);

/// Whether a convex polygon and a box share a point.
bool overlap(const Outline& polygon, const Eigen::AlignedBox2d& box);

/// Whether a box is inside a convex polygon.
bool lies_on(const Outline& polygon, const Eigen::AlignedBox2d& box);

/// The parts of the polygons outside of a convex one, in pieces of at least a quarter of a pixel.
std::vector<Outline> without(const std::vector<Outline>& polygons, const Outline& hole);

/// Bodies among the surfaces that are in front of a polygon on the screen. Each flat face is a
/// polygon, each round body one outline. Empty if there are too many faces, as on a landscape.
std::vector<Outline> outlines_before(const std::vector<Point2>& polygon, const Camera& camera,
                                     std::span<const Surface> surfaces);

}  // namespace contactscope::draw
