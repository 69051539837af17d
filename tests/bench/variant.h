#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/workload.h"

namespace contactscope::bench {

/// One implementation to compare: a pass collides each pair of a workload once.
struct Variant {
  std::string name;
  std::function<double(int workload)> pass;  // returns a number that depends on all results
  std::function<bool(int workload)> runs;    // whether it supports these shapes
};

/// Bullet, ODE and FCL; empty in a build without them.
std::vector<Variant> peer_variants();

}  // namespace contactscope::bench
