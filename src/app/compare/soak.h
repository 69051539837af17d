#pragma once

#include <string>
#include <vector>

#include "app/cli/verbs.h"
#include "study/soak.h"

/// `study stability --shard K/N`, and merging of the shards.
namespace contactscope::app {

/// Runs a shard, writes OUT/soak_K_of_N.json, prints a summary. Different: wrong answers.
ExitCode run_soak(const Options& options);

/// Shard files named directly or in folders of --out; sorted, empty if there are none.
std::vector<std::string> soak_parts(const std::vector<std::string>& names);

/// Merges shards. OUT/study/stability/soak.json is identical for any number of shards. Throws
/// InputError if one is unreadable, UsageError if one is missing, duplicate, or of another run.
ExitCode merge_soak(const std::vector<std::string>& files, const Options& options);

}  // namespace contactscope::app
