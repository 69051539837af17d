#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/catalogue.h"
#include "app/verbs.h"
#include "snapshot/finding.h"

namespace contactscope::app {

/// A scenario and how long its check takes, in any unit.
struct Costed {
  std::string name;
  double cost = 1;
};

/// Times of an earlier run, as OUT/check/times.json has them: milliseconds. Those that it does not know cost as
/// much as the middle one that it does. Throws InputError.
void read_times(const std::string& path, std::vector<Costed>& scenarios);

/// The names that are in one part: the longest first, each goes to the part that has least. The same on every machine
/// for the same names and costs, and whatever the parts are, each name is in one of them.
std::vector<std::string> names_in_shard(std::vector<Costed> scenarios,
                                        const snapshot::Shard& shard);

/// Leaves those of the part that was asked for, by --times or what each is said to cost; returns the names of all.
std::vector<std::string> keep_shard(std::vector<Input>& inputs, const Options& options,
                                    const std::function<double(const Input&)>& cost);

/// Of the folder of its report: "check_2_of_5", so that parts with one --out do not meet.
std::string folder_of(const snapshot::Shard& shard);

}  // namespace contactscope::app
