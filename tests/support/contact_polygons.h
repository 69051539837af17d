#pragma once

#include <vector>

#include "core/manifold.h"
#include "support/random_geometry.h"

namespace contactscope::test {

struct ContactPolygon {
  std::vector<ContactPoint<double>> points;  // in order around the normal
  Vec3d normal;
};

/// `count` points at random angles on an ellipse, in a random plane within 5 m; its axes differ by
/// a factor of up to 2.5. The depth is that of a tilted plane: 5 mm on average, up to half of that
/// more or less at the rim, plus noise of 1% of the mean. On such polygons engines' reducers agree
/// with independent measurements of the engines: random angles (not evenly spaced) give the
/// retained areas, and a tilt of this size gives how often the deepest point is kept.
ContactPolygon random_contact_polygon(Random& random, int count);

}  // namespace contactscope::test
