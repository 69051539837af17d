#pragma once

#include <span>

#include "core/pose.h"
#include "trace/trace.h"

namespace contactscope {

/// How far a manifold moved from one frame to the next, in metres: the largest move of any of its
/// points, or of their middle if that is more. A point that bears the same id in both moves between
/// its two places; one that came is as far as the nearest place before, one that went as the
/// nearest place after. So four points that give way to four others about the same middle have
/// moved, and an id that is spelled anew at the same place has not. 0 where either frame has no
/// points.
double patch_move(std::span<const trace::Point> before, std::span<const trace::Point> now);

/// How far any surface point of a shape moved between two poses, in metres, of those looked at: its
/// vertices and, as a plane has none and a sphere's is its centre, what it has now at `contacts`
/// (world). Exactly 0 where the pose is the same.
double surface_move(const trace::Shape& shape, const Pose<double>& before, const Pose<double>& now,
                    std::span<const trace::Point> contacts);

}  // namespace contactscope
