#pragma once

#include <vector>

#include "core/vec3.h"

namespace contactscope::test {

/// The hull that libqhull builds of the same points.
struct QhullAnswer {
  double volume = 0;
  double area = 0;
  std::vector<int> vertices;  // indices of the points that are vertices, ascending
};

QhullAnswer run_qhull(const std::vector<Vec3d>& points);

}  // namespace contactscope::test
