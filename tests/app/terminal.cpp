#include "app/terminal.h"

#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>

namespace contactscope::test {

TerminalRun run_on_terminal(const std::string& arguments, const std::string& keys,
                            const std::string& prompt) {
  int terminal = -1;
  const winsize size{40, 100, 0, 0};
  const pid_t program = forkpty(&terminal, nullptr, nullptr, &size);
  if (program == 0) {
    const std::string command = "cd '" CONTACTSCOPE_SOURCE_DIR
                                "' && CI= TERM=xterm exec '" CONTACTSCOPE_BINARY_DIR
                                "/contactscope' " +
                                arguments;
    execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
    _exit(127);
  }
  TerminalRun run;
  std::size_t typed = 0, seen = 0;
  std::array<char, 4096> buffer;
  while (true) {
    const ssize_t count = read(terminal, buffer.data(), buffer.size());
    if (count <= 0) break;  // the program has closed its end
    run.shown.append(buffer.data(), static_cast<std::size_t>(count));
    for (std::size_t at; (at = run.shown.find(prompt, seen)) != std::string::npos;) {
      seen = at + prompt.size();
      if (typed == keys.size()) continue;
      if (write(terminal, &keys[typed++], 1) != 1) break;
    }
  }
  close(terminal);
  int status = 0;
  waitpid(program, &status, 0);
  run.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return run;
}

}  // namespace contactscope::test
