#pragma once

#include <string>

#include "support/temporary_folder.h"

namespace contactscope::test {

/// Result of a run of the program.
struct ProgramRun {
  int exit_code = -1;
  std::string out;
  std::string err;
};

/// Runs the built program through the shell, in the source folder, with `environment` in front:
/// "CI=true". Standard input is the file `input`, empty by default.
ProgramRun run(const std::string& arguments, const std::string& environment = "",
               const std::string& input = "/dev/null");

/// The exit code of the program if standard output cannot be written.
int run_on_full_disk(const std::string& arguments);

/// Chromium's program; empty if it is not installed.
std::string chromium();

/// A small valid scenario: a box half a centimetre deep in a slab, two frames.
std::string small_scenario();

}  // namespace contactscope::test
