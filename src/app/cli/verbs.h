#pragma once

#include "app/cli/options.h"

namespace contactscope::app {

enum class ExitCode { Same = 0, Different = 1, Trouble = 2 };

/// A verb prints results to standard output and messages to standard error. InputError, UsageError
/// and gl::ContextError pass through to main.
struct Verb {
  std::string name;
  std::string summary;  // one line
  ExitCode (*run)(const Options& options);
  std::string footer{};  // shown after the options: its section of manual/help.txt
};

/// All verbs, in listing order.
const std::vector<Verb>& verbs();

/// Rejects unknown verbs, options and words, values that are not the numbers of their option, and
/// arguments that are missing or too many, with a suggestion. `arguments` are without the program's
/// name. Throws UsageError.
void check_usage(const std::vector<std::string>& arguments);

// The man page and shell completions, from the same table as the help; and the formats of files.

/// Output of --complete: words that may stand in place of the last of `words`, which follow the
/// program's name. One per line; a description follows a tab. ":files" and ":folders" stand for
/// names that the shell completes itself, ":nospace" for no space after the word.
std::string completions(std::vector<std::string> words);

/// Output of `--manual WHAT`: the page for "man", in roff, section 1, or the script for "bash", "zsh"
/// or "fish" that completes by `contactscope --complete WORD...`. Throws UsageError.
std::string manual(const std::string& what, const std::string& version);

/// All keys of a "scenario" or a "trace", from the tables of their readers; empty for another word.
std::string reference(const std::string& what);

}  // namespace contactscope::app
