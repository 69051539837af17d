#pragma once

#include <string>

/// The man page and shell completions, from the same table as the help; and the formats of files.
namespace contactscope::app {

/// roff, section 1.
std::string man_page(const std::string& version);

std::string bash_completion();
std::string zsh_completion();
std::string fish_completion();

/// Output of `--manual WHAT`: "man", "bash", "zsh" or "fish". Throws UsageError.
std::string manual(const std::string& what, const std::string& version);

/// All keys of a "scenario" or a "trace", from the tables of their readers; empty for another word.
std::string reference(const std::string& what);

}  // namespace contactscope::app
