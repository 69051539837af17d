#pragma once

#include "bench/draw_round.h"

namespace contactscope::bench {

/// The grid of W7: 50 m by 25 m in cells of 0.5 m, with waves of 0.5 m.
Mesh<double> wavy_grid();

/// A hull at a place on the grid, which stays at the origin.
struct DrawnHull {
  Hull<double> hull;
  Pose<double> pose;
};

DrawnHull draw_on_mesh(Workload workload, const Mesh<double>& grid, test::Random& random);

}  // namespace contactscope::bench
