#pragma once

#include <map>
#include <string>
#include <vector>

#include "app/options.h"

namespace contactscope::app {

/// A verb of the program. It prints its result on standard output and messages on standard error.
/// InputError, UsageError and gl::ContextError pass through to main.
struct Verb {
  std::string name;
  std::string summary;  // one line
  ExitCode (*run)(const Options& options);
  // In the order of its help, "SCENARIO... [FILE] --size": brackets around what may be left out,
  // dots behind what may be several. main.cpp knows which of the Options each sets.
  std::string arguments;
  // What the verb makes of an argument, where that is not the same for all, which main.cpp knows.
  std::map<std::string, std::string> help{};
  std::string footer{};  // of its help
};

/// Every verb, in the order in which to list them.
const std::vector<Verb>& verbs();

/// The words of its arguments, also those that every verb has.
std::vector<std::string> arguments_of(const Verb& verb);

/// Refuses a verb or an option that there is not, by its name and with the one that may be meant,
/// before a parser counts what follows it among the positional arguments. `arguments`: those after
/// the program's name. Throws UsageError. What a verb does with its arguments is not judged.
void check_usage(const std::vector<std::string>& arguments);

}  // namespace contactscope::app
