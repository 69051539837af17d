#pragma once

#include <vector>

#include "core/manifold.h"
#include "support/random_geometry.h"

namespace contactscope::test {

struct ContactPolygon {
  std::vector<ContactPoint<double>> points;  // in order around the normal
  Vec3d normal;
};

/// `count` points at random angles on an ellipse, its axes up to 2.5 times apart, in a random plane
/// within 5 m. The depth is that of a tilted plane, a mean of 5 mm and up to half of it more or
/// less at the rim, with noise of 1% of the mean. Engines' reducers keep on such polygons what
/// independent measurements of the engines say that they keep: random angles (not evenly spaced)
/// give the retained areas, a tilt of this size gives how often the deepest point is kept.
ContactPolygon random_contact_polygon(Random& random, int count);

}  // namespace contactscope::test
