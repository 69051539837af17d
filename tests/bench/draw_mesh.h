#pragma once

#include "bench/draw_round.h"

namespace contactscope::bench {

/// The grid of W7: 50 m by 25 m in cells of half a metre, waves of half a metre.
Mesh<double> wavy_grid();

/// A hull somewhere on the grid, which stays at the origin.
struct DrawnHull {
  Hull<double> hull;
  Pose<double> pose;
};

DrawnHull draw_on_mesh(Workload workload, const Mesh<double>& grid, test::Random& random);

}  // namespace contactscope::bench
