#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace contactscope::test {

/// What a run of the program left.
struct ProgramRun {
  int exit_code = -1;
  std::string out;
  std::string err;
};

/// Runs the built program through the shell, in the source folder. `environment` is put before it:
/// "CI=true". Standard input is empty.
ProgramRun run(const std::string& arguments, const std::string& environment = "");

/// A folder of its own for one test, empty at first and gone afterwards.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

std::string read_text(const std::filesystem::path& path);
void write_text(const std::filesystem::path& path, const std::string& text);

/// Files below a folder, relative, sorted.
std::vector<std::string> files_below(const std::filesystem::path& folder);

/// A small valid scenario: a box half a centimetre deep in a slab, two frames.
std::string small_scenario();

}  // namespace contactscope::test
