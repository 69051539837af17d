#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/workload.h"

namespace contactscope::bench {

/// One way to work through a workload: a pass collides each pair once.
struct Variant {
  std::string name;
  std::function<double(int workload)> pass;  // a number that depends on all results
  std::function<bool(int workload)> runs;    // whether it knows these shapes
};

/// Bullet, ODE and FCL; none in a build without them.
std::vector<Variant> peer_variants();

}  // namespace contactscope::bench
