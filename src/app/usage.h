#pragma once

#include <string>
#include <vector>

namespace contactscope::app {

/// A verb of the command line and its options, "--out", "-h".
struct VerbOptions {
  std::string verb;
  std::vector<std::string> options;
};

/// Refuses a verb or an option that there is not, by its name and with the one that may be meant,
/// before a parser counts what follows it among the positional arguments. `arguments`: those after
/// the program's name. Throws UsageError. What a verb does with its arguments is not judged.
void check_usage(const std::vector<VerbOptions>& verbs, const std::vector<std::string>& arguments);

}  // namespace contactscope::app
