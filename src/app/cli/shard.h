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

/// Reads OUT/check/times.json of an earlier run, in milliseconds. Unknown scenarios get the median
/// cost. Throws InputError.
void read_times(const std::string& path, std::vector<Costed>& scenarios);

/// Names in one shard: the costliest first, each to the shard with the least cost so far.
/// Deterministic on every machine for the same names and costs; each name is in exactly one shard.
std::vector<std::string> names_in_shard(std::vector<Costed> scenarios,
                                        const snapshot::Shard& shard);

/// Keeps the inputs of the requested shard, by --times or `cost`; returns the names of all.
std::vector<std::string> keep_shard(std::vector<Input>& inputs, const Options& options,
                                    const std::function<double(const Input&)>& cost);

/// Name of the shard's report folder: "check_2_of_5", so that shards with one --out do not collide.
std::string folder_of(const snapshot::Shard& shard);

}  // namespace contactscope::app
