#include "app/program.h"

#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace contactscope::test {

namespace fs = std::filesystem;

ProgramRun run(const std::string& arguments, const std::string& environment) {
  const TemporaryFolder folder;
  const std::string command = "cd '" CONTACTSCOPE_SOURCE_DIR "' && " + environment +
                              " '" CONTACTSCOPE_BINARY_DIR "/contactscope' " + arguments + " >'" +
                              (folder / "out") + "' 2>'" + (folder / "err") + "' </dev/null";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_text(folder / "out"),
          read_text(folder / "err")};
}

TemporaryFolder::TemporaryFolder() {
  std::string name = (fs::temp_directory_path() / "contactscope_test_XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::string read_text(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

void write_text(const fs::path& path, const std::string& text) {
  fs::create_directories(path.parent_path());
  std::ofstream out(path, std::ios::binary);
  out << text;
  if (!out.flush()) throw std::runtime_error("cannot write " + path.string());
}

std::vector<std::string> files_below(const fs::path& folder) {
  std::vector<std::string> files;
  if (!fs::exists(folder)) return files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) files.push_back(fs::relative(entry.path(), folder).string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::string small_scenario() {
  return R"(title = "A box on a slab"
[time]
frames = 2
[shapes.slab]
type = "box"
half_extents = [1.0, 0.2, 1.0]
position = [0.0, -0.2, 0.0]
[shapes.crate]
type = "box"
half_extents = [0.5, 0.5, 0.5]
position = [0.0, 0.495, 0.0]
[snapshots]
frames = [0, 1]
size = [320, 180]
)";
}

}  // namespace contactscope::test
