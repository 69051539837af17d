#include <cstdlib>
#include <iostream>

#include "app/check/check_run.h"
#include "app/check/reports/report.h"
#include "app/cli/progress.h"
#include "app/cli/verbs.h"
#include "gl/context.h"

namespace contactscope::app {
namespace {

ExitCode run_check_verb(const Options& options) {
  note_interrupts();
  if (options.accept) return run_accept(options);
  std::vector<Input> inputs = load_inputs(options, Hold::Sample, Unreadable::Kept);
  if (options.update != snapshot::Update::None && snapshot::is_ci(std::getenv("CI")))
    std::cerr << "CI=true: nothing is written; unset CI to store snapshots\n";
  const snapshot::Outcome outcome = [&] {
    try {
      return run_check(inputs, options);
    } catch (const gl::ContextError& error) {
      throw gl::ContextError(std::string(error.what()) +
                             "\nor compare only traces and expectations, without OpenGL: "
                             "contactscope check --facts-only");
    }
  }();
  write_reports({outcome, report_folder(options), options});
  return exit_code(outcome);
}

}  // namespace

Verb check_verb() {
  return {"check", "Compare with the stored snapshots", &run_check_verb,
          "Examples:\n"
          "  contactscope check                              all scenarios against snapshots/\n"
          "  contactscope check hull --facts-only            one group, without drawing\n"
          "  contactscope check my/crate.toml --write-missing\n"
          "  contactscope check --accept hull/face_contact/frame_0012\n"
          "  contactscope check --shard 2/5 --out /tmp/shards --junit junit.xml\n"
          "Exit codes: 0 no difference, 1 a difference, 2 an error, such as a scenario that cannot "
          "be read;\nthe others are still checked."};
}

}  // namespace contactscope::app
