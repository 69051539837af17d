#include "app/program.h"

#include <sys/wait.h>

#include <cstdlib>

namespace contactscope::test {

namespace {

/// The exit code of the program, run in the source folder; -1 if it did not exit.
int exit_code_of(const std::string& environment, const std::string& arguments,
                 const std::string& redirections, const std::string& input = "/dev/null") {
  const std::string command = "cd '" CONTACTSCOPE_SOURCE_DIR "' && " + environment +
                              " '" CONTACTSCOPE_BINARY_DIR "/contactscope' " + arguments + " " +
                              redirections + " <'" + input + "'";
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

ProgramRun run(const std::string& arguments, const std::string& environment,
               const std::string& input) {
  const TemporaryFolder folder;
  const int exit_code = exit_code_of(
      environment, arguments, ">'" + (folder / "out") + "' 2>'" + (folder / "err") + "'", input);
  return {exit_code, read_text(folder / "out"), read_text(folder / "err")};
}

int run_on_full_disk(const std::string& arguments) {
  return exit_code_of("", arguments, ">/dev/full 2>/dev/null");
}

std::string chromium() {
  for (const char* name : {"chromium", "chromium-browser", "google-chrome"})
    if (std::system((std::string("command -v ") + name + " > /dev/null").c_str()) == 0) return name;
  return {};
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
