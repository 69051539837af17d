#pragma once

#include <string>
#include <vector>

#include "manifold.h"

namespace contactscope::package {

struct Reducer {
  std::string name;
  std::string summary;  // one line
};

std::vector<Reducer> reducers();

struct ReduceOptions {
  int max_points = 4;  // >= 1
  Scalar scalar = Scalar::Double;
  /// Seed of random reducers.
  unsigned long long seed = 1;
};

/// Points that a reducer keeps: indices into manifold.points, in the order of choice. Up to
/// max_points points are all kept without calling the reducer. Returns none if a number is not
/// finite. Throws std::invalid_argument for an unknown name and for more than 256 points.
std::vector<int> reduce(const Manifold& manifold, const std::string& reducer,
                        const ReduceOptions& options = {});

}  // namespace contactscope::package
