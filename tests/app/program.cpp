#include "app/program.h"

#include <sys/wait.h>

#include <cstdlib>

namespace contactscope::test {

ProgramRun run(const std::string& arguments, const std::string& environment) {
  const TemporaryFolder folder;
  const std::string command = "cd '" CONTACTSCOPE_SOURCE_DIR "' && " + environment +
                              " '" CONTACTSCOPE_BINARY_DIR "/contactscope' " + arguments + " >'" +
                              (folder / "out") + "' 2>'" + (folder / "err") + "' </dev/null";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_text(folder / "out"),
          read_text(folder / "err")};
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
