#include "app/cli/options.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>

#include "app/cli/catalogue.h"
#include "app/cli/option_readers.h"

namespace contactscope::app {
namespace {

/// Default root for scenario names: the installed scenarios replace a missing ./scenarios.
std::string scenario_root(const std::string& named) {
  std::error_code unknown;
  if (named != Options{}.scenario_root || std::filesystem::is_directory(named, unknown))
    return named;
  const std::string installed = installed_scenarios();
  return installed.empty() ? named : installed;
}

/// Validates the extra word of a file name.
void check_word(const Options& options) {
  const std::string& word = options.accept_as;
  if ((!word.empty() || !options.note.empty()) && !options.accept)
    throw UsageError("--as and --note need --accept");
  const bool is_plain =
      std::ranges::all_of(word, [](unsigned char c) { return std::isalnum(c) || c == '_'; });
  if (!is_plain)
    throw UsageError("--as '" + word + "' is not a word; write letters, digits and _, as osmesa");
  if (!options.note.empty() && !word.starts_with("bad_"))
    throw UsageError("--note needs --as bad_WORD, the bug that it describes");
}

}  // namespace

void use_backend_of_environment(Options& options) {
  const char* const variable = std::getenv("CONTACTSCOPE_BACKEND");
  if (variable != nullptr && *variable != '\0')
    options.backend = parse_backend("$CONTACTSCOPE_BACKEND", variable);
}

void finish(Options& options) {
  options.scenario_root = scenario_root(options.scenario_root);
  finish_figure(options, options.size.has_value());
  if (options.out.empty()) throw UsageError("--out is empty; name a folder");
  if (options.write_missing && options.update == snapshot::Update::None)
    options.update = snapshot::Update::Missing;
  check_word(options);
}

}  // namespace contactscope::app
