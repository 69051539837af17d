#pragma once

#include "bench/workload.h"
#include "support/random_geometry.h"

namespace contactscope::bench {

struct DrawnPair {
  Shape<double> a;
  Pose<double> pose_a;
  Shape<double> b;
  Pose<double> pose_b;
};

/// One pair of W5, at the origin.
DrawnPair draw_round(Workload workload, test::Random& random);

}  // namespace contactscope::bench
