#pragma once

#include <map>
#include <ostream>
#include <string>
#include <vector>

#include "app/verbs.h"
#include "versus/comparison.h"

/// The engines of `versus`, and what their programs answer.
namespace contactscope::app {

inline constexpr const char* kOwn = "contactscope";  // this program as one of them

/// Those of --engines; without it all that are found, this program first.
std::vector<std::string> engines_asked(const Options& options);

/// The path of each engine's program, by its name; this program has none. Throws UsageError, with the names that
/// there are, where one is not found.
std::map<std::string, std::string> programs_of(const std::vector<std::string>& engines);

/// What a program makes of a request when it is called with `question`, "contacts" or "rollout". Of one that
/// dies, is stopped after `limit` seconds or writes nonsense the frames that it got to, and why in `failure`.
versus::Contender ask(const std::string& name, const std::string& program,
                      const std::string& question, const trace::Trace& request, double limit);

/// The first lines of what an engine's program said.
void print_words(const versus::Contender& contender, std::ostream& out);

}  // namespace contactscope::app
