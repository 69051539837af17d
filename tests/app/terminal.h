#pragma once

#include <string>

namespace contactscope::test {

/// Result of a run of the program on a pseudo-terminal.
struct TerminalRun {
  int exit_code = -1;
  std::string shown;  // everything that it printed there
};

/// Runs the program as run() does, on a pseudo-terminal. Types a letter of `keys` at each `prompt`.
TerminalRun run_on_terminal(const std::string& arguments, const std::string& keys,
                            const std::string& prompt);

}  // namespace contactscope::test
