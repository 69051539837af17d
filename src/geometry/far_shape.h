#pragma once

#include "geometry/shape.h"

namespace contactscope {

/// Shapes whose vertices are far from the origin of their own frame, as level geometry has them: in
/// single precision the distance eats the digits that the form needs, and tolerances grow with it.
/// Engines move such a shape to its middle in double before it is rounded; its pose makes up for it.

/// A shape whose middle is farther from its origin than this many radii is moved. Nearer, distance
/// costs no more than two of float's twenty-four bits, and the shape is left as it is, bit for bit.
/// A ratio, so that it holds at every scale.
inline constexpr double kFarthestMiddle = 4;

/// Where in its own frame the origin of a shape is moved to: the middle of its box, or zero where it
/// is to be left alone. Each coordinate is a float, so that a pose that stands still at the world's
/// origin stays exact.
Vec3d moved_origin(const Shape<double>& shape);

/// The same shape in a frame with the same axes whose origin is at `origin` of the shape's own
/// frame, metres.
Shape<double> seen_from(const Shape<double>& shape, const Vec3d& origin);

}  // namespace contactscope
