#pragma once

#include <string>
#include <vector>

#include "app/verbs.h"
#include "study/soak.h"

/// `study stability --shard K/N` and what `merge` makes of its parts.
namespace contactscope::app {

/// Runs a part, writes OUT/soak_K_of_N.json, and prints what it came to. Different where an answer is wrong.
ExitCode run_soak(const Options& options);

/// The files of parts in folders that --out named, or that are named themselves; sorted, none where there is none.
std::vector<std::string> soak_parts(const std::vector<std::string>& names);

/// Puts parts together: OUT/study/stability/soak.json is the same, byte for byte, for any number of them. Throws
/// InputError where one cannot be read, UsageError where one is missing, there twice, or of another whole.
ExitCode merge_soak(const std::vector<std::string>& files, const Options& options);

/// As a file has it; `shard` of a part.
std::string to_json(const Soak& soak, const std::optional<snapshot::Shard>& shard);
Soak parse_soak(const std::string& text, const std::string& path,
                std::optional<snapshot::Shard>& shard);

}  // namespace contactscope::app
