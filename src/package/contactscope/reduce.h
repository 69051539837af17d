#pragma once

#include <string>
#include <vector>

#include "manifold.h"

namespace contactscope::package {

/// A manifold reducer, as options name it.
struct Reducer {
  std::string name;
  std::string summary;  // one line
};

/// All of them.
std::vector<Reducer> reducers();

struct ReduceOptions {
  int max_points = 4;  // >= 1
  Scalar scalar = Scalar::Double;
  /// Of a random choice.
  unsigned long long seed = 1;
};

/// Which points of a manifold a reducer keeps: indices into its points, in the order of choice. Up to
/// max_points of them are all kept, without asking it; none where a number is not finite. Throws
/// std::invalid_argument for a name that there is not, and for more than 256 points.
std::vector<int> reduce(const Manifold& manifold, const std::string& reducer,
                        const ReduceOptions& options = {});

}  // namespace contactscope::package
