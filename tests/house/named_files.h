#pragma once

#include <set>
#include <string>
#include <vector>

#include "house/include_order.h"

namespace contactscope::house {

/// Files that comments and documents name and that are not in the project, one sentence each, such as
/// "src/core/pose.h:3: there is no file NAME.md". A name is a word that ends in .md, .h, .cpp or
/// .toml; it names a file where it is its path, or the end of its path. Read are comments of sources,
/// of CMake files and of scenarios, and documents as a whole; of a document's links also pictures.
/// `paths` are those of all files of the project.
std::vector<std::string> missing_files(const std::vector<SourceFile>& files,
                                       const std::set<std::string>& paths);

}  // namespace contactscope::house
