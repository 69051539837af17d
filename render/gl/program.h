#pragma once

#include <initializer_list>

#include "gl/functions.h"

namespace contactscope::gl {

/// Compiles and links GLSL 3.30 and returns the program, with the attributes at locations 0, 1, ...
/// in the order named. Throws std::runtime_error with the driver's log.
GLuint build_program(const Functions& gl, const char* vertex_source, const char* fragment_source,
                     std::initializer_list<const char*> attributes);

}  // namespace contactscope::gl
