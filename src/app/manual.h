#pragma once

#include <string>
#include <vector>

/// The program's man page and what shells complete, from the same arguments as its help.
namespace contactscope::app {

/// An argument of a verb.
struct ManualArgument {
  std::string name;  // "--size", or "SCENARIO"
  std::string help;
  std::string otherwise{};  // its default; empty: none
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

/// How a shell completes a value.
struct Completion {
  enum class Kind { Words, List, Scenario, File, Folder, Free };
  Kind kind = Kind::Free;
  std::vector<std::string> words{};  // of Words, and of List, where a comma is between them
};

/// By the name of the argument: words come from the tables that the program itself goes by.
Completion completion_of(const ManualArgument& argument);

/// roff, section 1.
std::string man_page(const std::string& version, const std::vector<ManualVerb>& verbs);

std::string bash_completion(const std::vector<ManualVerb>& verbs);
std::string zsh_completion(const std::vector<ManualVerb>& verbs);
std::string fish_completion(const std::vector<ManualVerb>& verbs);

/// What `--manual WHAT` prints: "man", "bash", "zsh" or "fish". Throws UsageError.
std::string manual(const std::string& what, const std::string& version,
                   const std::vector<ManualVerb>& verbs);

}  // namespace contactscope::app
