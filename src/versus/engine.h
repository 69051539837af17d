#pragma once

#include <optional>
#include <string>
#include <vector>

/// Another engine is a program `contactscope-engine-NAME`: it reads a trace without contacts on its standard
/// input, and writes the same frames with the contacts that it finds on its standard output. See
/// src/versus/README.md.
namespace contactscope::versus {

/// What a program wrote, or why it is of no use.
struct Answer {
  std::string out;
  std::string said;                // on its standard error
  std::string failure;             // "it was stopped after 10 s"; empty: it ended with exit code 0
  std::optional<int> exit_code{};  // where it ended by itself
};

/// The exit code of a program that steps nothing, or not what it was asked to: its last line says why.
inline constexpr int kNoRollout = 3;

/// Runs a program with these arguments and this standard input. It is killed after `limit_seconds`, and
/// where it writes more than `limit_bytes`; the rest of its standard error is in the failure. Throws
/// std::system_error where this process can start none.
Answer run_program(const std::string& program, const std::vector<std::string>& arguments,
                   const std::string& input, double limit_seconds,
                   std::size_t limit_bytes = std::size_t{1} << 30);

/// The path of a program: in one of `folders`, else in those of $PATH. Empty where it is not there.
std::optional<std::string> find_program(const std::string& name,
                                        const std::vector<std::string>& folders);

/// The same of `contactscope-engine-NAME`.
std::optional<std::string> find_engine(const std::string& name,
                                       const std::vector<std::string>& folders);

/// Where the programs are that were built with this one: beside it, and in the folder `engines` there.
std::vector<std::string> own_folders();

/// The names of all of them, sorted.
std::vector<std::string> engines_found(const std::vector<std::string>& folders);

}  // namespace contactscope::versus
