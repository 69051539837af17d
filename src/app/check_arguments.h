#pragma once

#include <string>

#include "app/verbs.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace contactscope::app {

/// Options of `check` and of the verbs about its report, as they are written.
struct CheckTexts {
  std::string update = "never", shard;
  bool write_missing = false;
};

/// Adds the option of that name, with its help; null where it is none of these.
CLI::Option* add_check_option(CLI::App& verb, const std::string& name, Options& to,
                              CheckTexts& texts);

/// Reads them. Throws UsageError.
void finish_check(const CheckTexts& texts, Options& options);

}  // namespace contactscope::app
