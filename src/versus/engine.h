#pragma once

#include <optional>
#include <string>
#include <vector>

/// An engine is a program `contactscope-engine-NAME`: it reads a trace without contacts from
/// standard input and writes the same frames with its contacts to standard output. See
/// src/versus/README.md.
namespace contactscope::versus {

/// Output of a program, or why it failed.
struct Answer {
  std::string out;
  std::string said;                // its standard error
  std::string failure;             // "it was stopped after 10 s"; empty: it exited with status 0
  std::optional<int> exit_code{};  // if it exited by itself
};

/// Exit status of a program that does not step, or not this scene; its last line is the reason.
inline constexpr int kNoRollout = 3;

/// The line that names an error, as interpreters print it first; else the last line with text.
std::string last_line(const std::string& text);

/// Runs a program with these arguments and this standard input. It is killed after `limit_seconds`
/// or `limit_bytes` of output; the failure contains the rest of its standard error. Throws
/// std::system_error if no process can be started.
Answer run_program(const std::string& program, const std::vector<std::string>& arguments,
                   const std::string& input, double limit_seconds,
                   std::size_t limit_bytes = std::size_t{1} << 30);

/// The path of a program in one of `folders`, else in $PATH. Empty if not found.
std::optional<std::string> find_program(const std::string& name,
                                        const std::vector<std::string>& folders);

/// The path of `contactscope-engine-NAME`.
std::optional<std::string> find_engine(const std::string& name,
                                       const std::vector<std::string>& folders);

/// Folders of the engines built with this program: its own, and `engines` in it.
std::vector<std::string> own_folders();

/// Names of all engines found, sorted.
std::vector<std::string> engines_found(const std::vector<std::string>& folders);

}  // namespace contactscope::versus
