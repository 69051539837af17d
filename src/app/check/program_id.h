#pragma once

#include <string>

namespace contactscope::app {

/// Identifies this build by 64 hexadecimal digits: a hash of the linker's build id, or without one
/// of the program file; empty if neither is available. Hashing the file of a sanitized build takes
/// ten seconds, reading the build id almost none.
std::string program_id();

}  // namespace contactscope::app
