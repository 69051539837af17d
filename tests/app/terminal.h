#pragma once

#include <string>

namespace contactscope::test {

/// What a run of the program on a pseudo-terminal left.
struct TerminalRun {
  int exit_code = -1;
  std::string shown;  // all that it wrote there
};

/// Runs the program as run() does, with a pseudo-terminal for its input and output. Each letter of `keys` is typed when
/// the program has asked for one more, which it does with `prompt`.
TerminalRun run_on_terminal(const std::string& arguments, const std::string& keys,
                            const std::string& prompt);

}  // namespace contactscope::test
