#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/cli/catalogue.h"
#include "app/cli/verbs.h"
#include "snapshot/finding.h"

namespace contactscope::app {

/// A scenario and the cost of its check, in any unit.
struct Costed {
  std::string name;
  double cost = 1;
};

/// Names in one shard: the costliest first, each to the shard with the least cost so far.
/// Deterministic on every machine for the same names and costs; each name is in exactly one shard.
std::vector<std::string> names_in_shard(std::vector<Costed> scenarios,
                                        const snapshot::Shard& shard);

/// Keeps the inputs of a shard.
void keep_shard(std::vector<Input>& inputs, const snapshot::Shard& shard,
                const std::function<double(const Input&)>& cost);

/// Name of the shard's report folder: "check_2_of_5", so that shards with one --out do not collide.
std::string folder_of(const snapshot::Shard& shard);

}  // namespace contactscope::app
