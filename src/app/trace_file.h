#pragma once

#include <string>

#include "trace/json.h"

namespace contactscope::app {

/// Whether a file is a trace and no scenario: it is named *.jsonl, or begins with '{', as no TOML
/// does. False where there is no such file.
bool is_trace_file(const std::string& path);

/// Reads a trace to draw it, ours or another engine's. Throws InputError, with the line and what
/// would be right, where it cannot be read or does not fit together: a shape without vertices, a
/// frame without a pose for each shape, a pair of shapes that are not there, a normal that is no
/// unit vector, an index beyond a shape's faces.
trace::Trace load_trace(const std::string& path);

}  // namespace contactscope::app
