#pragma once

#include <set>
#include <string>
#include <vector>

#include "house/include_order.h"

namespace contactscope::house {

/// Files that comments and documents name but that are not in the project, one sentence each, such
/// as "src/core/pose.h:3: there is no file NAME.md". A name is a word that ends in .md, .h, .cpp or
/// .toml; it must be a file's path or the end of one. Reads comments of sources, CMake files and
/// scenarios, and documents including links to pictures. `paths` are all files of the project.
std::vector<std::string> missing_files(const std::vector<SourceFile>& files,
                                       const std::set<std::string>& paths);

}  // namespace contactscope::house
