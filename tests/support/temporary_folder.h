#pragma once

#include <filesystem>
#include <set>
#include <string>

namespace contactscope {

/// A new folder that is deleted with its files.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  /// Writes a file, creates its parent folders, and returns its path.
  std::string write(const std::string& name, const std::string& content) const;
  /// Every file below, relative to the folder.
  std::set<std::string> files() const;

 private:
  std::filesystem::path path_;
};

/// Every file below a folder, relative to it; empty if the folder does not exist.
std::set<std::string> files_below(const std::filesystem::path& folder);

/// The whole file. Throws if it cannot be read.
std::string read_text(const std::filesystem::path& path);

}  // namespace contactscope
