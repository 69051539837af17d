#pragma once

#include <string>
#include <vector>

namespace contactscope::house {

/// A file of the repository: path relative to its root, "src/core/pose.h", and its text.
struct SourceFile {
  std::string path;
  std::string text;
};

/// What breaks the order of folders that src/README.md lays down: one sentence each, such
/// as "src/core/pose.h:3: core must not use geometry". `files` is the whole of src and render, so
/// an include that names none of them is reported as well. Only .h and .cpp files are read for
/// includes.
std::vector<std::string> include_violations(const std::vector<SourceFile>& files);

/// The same for what folders link: reads contactscope_folder() of each CMakeLists.txt in `files`.
std::vector<std::string> link_violations(const std::vector<SourceFile>& files);

/// Every regular file under `root`/src and `root`/render, sorted by path.
std::vector<SourceFile> read_house(const std::string& root);

}  // namespace contactscope::house
