#pragma once

#include <string>

#include "support/temporary_folder.h"

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

/// A small valid scenario: a box half a centimetre deep in a slab, two frames.
std::string small_scenario();

}  // namespace contactscope::test
