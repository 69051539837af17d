#pragma once

#include <string>

namespace contactscope::app {

/// What tells this build of the program from every other one, as 64 hexadecimal digits: a hash of the build
/// id that the linker made of its bytes, or where it has none, of its file; empty where the system tells neither.
/// To hash the file of a sanitized build takes ten seconds, to read its note nothing.
std::string program_id();

}  // namespace contactscope::app
