#pragma once

#include "draw/scene/pair_points.h"
#include "draw/scene/scene.h"

/// From one shape's surface to the other's at a contact point.
namespace contactscope::draw {

/// Where along the normal the two surfaces are at a contact point: an overlap from the surface of A
/// to that of B, which is behind it. With the scene's depth factor the overlap is so many times as
/// long, and begins at the surface on which the point lies, or in the middle of both.
struct Whisker {
  Vec3d on_a, on_b;
};
Whisker whisker_at(const Scene& scene, const trace::Pair& pair, const trace::Manifold& manifold,
                   const trace::Point& point);

}  // namespace contactscope::draw
