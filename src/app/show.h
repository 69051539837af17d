#pragma once

#include <iosfwd>
#include <string>

#include "app/verbs.h"
#include "snapshot/finding.h"

namespace contactscope::app {

/// How pictures are shown in a terminal.
enum class TerminalPictures { None, HalfBlocks, Sixel, Kitty };

/// What the terminal of the standard output can, as far as its environment says; None where it is no terminal.
TerminalPictures terminal_pictures();

/// What a finding is, its details, and where there are some its pictures, or where they lie.
void show(const snapshot::Finding& finding, const std::string& folder, TerminalPictures how,
          std::ostream& out);

}  // namespace contactscope::app
