#pragma once

#include <iosfwd>
#include <string>

#include "app/cli/verbs.h"
#include "snapshot/finding.h"

namespace contactscope::app {

enum class TerminalPictures { None, HalfBlocks, Sixel, Kitty };

/// Capability of the terminal on standard output, by its environment; None without a terminal.
TerminalPictures terminal_pictures();

/// Prints a finding with its details, and its pictures or their paths.
void show(const snapshot::Finding& finding, const std::string& folder, TerminalPictures how,
          std::ostream& out);

}  // namespace contactscope::app
