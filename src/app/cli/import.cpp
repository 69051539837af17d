#include <iostream>

#include "app/cli/catalogue.h"
#include "versus/request.h"

namespace contactscope::app {
namespace {

/// The scenario of a model, as text. Another program makes it: src/scenario/import.
std::string imported(const std::string& file, bool is_quiet) {
  constexpr double kMaxSeconds = 60;
  const auto program = versus::find_program("contactscope-import", versus::own_folders());
  if (!program)
    throw InputError(file, 0, 0,
                     "a model is read by contactscope-import, which is neither next to "
                     "contactscope nor in $PATH; install it with the package");
  const versus::Answer answer = versus::run_program(*program, {file}, "", kMaxSeconds);
  if (answer.exit_code == 2) throw UsageError(answer.said.substr(0, answer.said.find('\n')));
  if (!answer.failure.empty())
    throw InputError(file, 0, 0,
                     "contactscope-import, which needs python3, failed: " + answer.failure + ": " +
                         versus::last_line(answer.said));
  if (!is_quiet) std::cerr << answer.said;
  return answer.out;
}

}  // namespace

Scenario load_or_import(const std::string& file, bool is_quiet) {
  return is_model(file) ? parse_scenario(imported(file, is_quiet), file) : load_scenario(file);
}

Verb import_verb() {
  return {"import",
          "Print a model's shapes as a scenario: of a robot (MJCF, URDF, SDF) or scene (glTF, DAE, "
          "3MF)",
          [](const Options& options) {
            std::cout << imported(options.scenarios.front(), options.quiet);
            return ExitCode::Same;
          }};
}

}  // namespace contactscope::app
