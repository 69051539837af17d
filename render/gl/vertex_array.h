#pragma once

#include <cstddef>
#include <initializer_list>

#include "gl/functions.h"

namespace contactscope::gl {

/// One input of a vertex shader: its location is its place in the list.
struct VertexAttribute {
  GLint components;
  GLenum type;
  GLboolean normalized;
  std::size_t offset;  // bytes from the start of a vertex
};

/// Names of a vertex array and its interleaved buffers.
struct VertexArray {
  GLuint array = 0;
  GLuint vertices = 0;
  GLuint indices = 0;
};

/// Makes the array with its two buffers, and leaves them bound. `stride` is a vertex's size, bytes.
VertexArray make_vertex_array(const Functions& gl, std::size_t stride,
                              std::initializer_list<VertexAttribute> attributes);

void delete_vertex_array(const Functions& gl, VertexArray& array);

}  // namespace contactscope::gl
