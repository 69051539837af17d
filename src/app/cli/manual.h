#pragma once

#include <string>
#include <vector>

/// The man page and shell completions, generated from the same arguments as the help.
namespace contactscope::app {

struct ManualArgument {
  std::string name;  // "--size", or "SCENARIO"
  std::string help;
  std::string otherwise{};  // default value; empty: none
  bool takes_value = true;
  bool is_optional = true;
  bool repeats = false;

  bool is_option() const { return name.starts_with('-'); }
};

struct ManualVerb {
  std::string name;
  std::string summary;  // one line
  std::vector<ManualArgument> arguments{};
  std::string footer{};
};

/// Completion of a value in a shell.
struct Completion {
  enum class Kind { Words, List, Scenario, File, Folder, Free };
  Kind kind = Kind::Free;
  std::vector<std::string> words{};  // for Words, and for List, which separates them by commas
};

/// By name of the argument; the words are from the program's own tables.
Completion completion_of(const ManualArgument& argument);

/// roff, section 1.
std::string man_page(const std::string& version, const std::vector<ManualVerb>& verbs);

std::string bash_completion(const std::vector<ManualVerb>& verbs);
std::string zsh_completion(const std::vector<ManualVerb>& verbs);
std::string fish_completion(const std::vector<ManualVerb>& verbs);

/// Output of `--manual WHAT`: "man", "bash", "zsh" or "fish". Throws UsageError.
std::string manual(const std::string& what, const std::string& version,
                   const std::vector<ManualVerb>& verbs);

}  // namespace contactscope::app
