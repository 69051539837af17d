#pragma once

#include <string>

#include "app/cli/verbs.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace contactscope::app {

/// Options of `check` and of the verbs for its report, as text.
struct CheckTexts {
  std::string update = "never", shard;
  bool write_missing = false;
};

/// Adds the option of this name with its help; null if it is not one of these.
CLI::Option* add_check_option(CLI::App& verb, const std::string& name, Options& to,
                              CheckTexts& texts);

/// Parses the texts. Throws UsageError.
void finish_check(const CheckTexts& texts, Options& options);

}  // namespace contactscope::app
