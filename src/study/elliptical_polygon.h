#pragma once

#include <random>
#include <vector>

#include "core/manifold.h"

namespace contactscope {

/// What a reducer is given for one manifold.
struct ContactPolygon {
  std::vector<ContactPoint<float>> points;
  Vec3f normal = Vec3f::UnitZ();
};

/// A contact patch as clipping makes them: `count` >= 3 points in order around an ellipse, in one
/// plane but for the rounding to float.
///
/// Semi-axis 0.1 to 1 m, aspect ratio 1 to 5 (log-uniform); angles jittered by up to 0.4 of their
/// spacing; any plane within 5 m of the origin. The depth is that of a tilted plane, up to twice
/// its mean of 1 to 10 mm, plus noise of a twentieth of the mean.
ContactPolygon elliptical_polygon(std::mt19937_64& engine, int count);

/// The same contacts a frame before or after: each point moves in the plane by up to `part` of its
/// distance from their middle, its depth by up to `part` of itself; ids stay.
ContactPolygon neighbouring_frame(const ContactPolygon& polygon, double part,
                                  std::mt19937_64& engine);

}  // namespace contactscope
