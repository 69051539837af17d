#pragma once

#include "app/options.h"

namespace contactscope::app {

/// The program's verbs, one file each. They print their result on standard output and messages on
/// standard error. InputError, UsageError and gl::ContextError pass through to main.
ExitCode render(const Options& options);
ExitCode trace(const Options& options);
ExitCode check(const Options& options);
ExitCode explore(const Options& options);
ExitCode study(const Options& options);
ExitCode doctor(const Options& options);
ExitCode list(const Options& options);

}  // namespace contactscope::app
