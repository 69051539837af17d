#pragma once

#include <string>
#include <vector>

namespace contactscope::house {

/// A file of the repository: path relative to its root, "src/core/pose.h", and its text.
struct SourceFile {
  std::string path;
  std::string text;
};

/// Violations of the order of folders in src/README.md: one sentence each, such as
/// "src/core/pose.h:3: core must not use geometry". `files` is all of src and render, so an include
/// of any other file is reported as well. Only .h and .cpp files are searched for includes.
std::vector<std::string> include_violations(const std::vector<SourceFile>& files);

/// The same for links between folders: reads contactscope_folder() of CMakeLists.txt in `files`.
std::vector<std::string> link_violations(const std::vector<SourceFile>& files);

/// Every regular file under `root`/src and `root`/render, sorted by path.
std::vector<SourceFile> read_house(const std::string& root);

}  // namespace contactscope::house
