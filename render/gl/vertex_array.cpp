#include "gl/vertex_array.h"

namespace contactscope::gl {

VertexArray make_vertex_array(const Functions& gl, std::size_t stride,
                              std::initializer_list<VertexAttribute> attributes) {
  VertexArray result;
  gl.GenVertexArrays(1, &result.array);
  gl.GenBuffers(1, &result.vertices);
  gl.GenBuffers(1, &result.indices);
  gl.BindVertexArray(result.array);
  gl.BindBuffer(GL_ARRAY_BUFFER, result.vertices);
  gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, result.indices);
  GLuint location = 0;
  for (const VertexAttribute& attribute : attributes) {
    gl.EnableVertexAttribArray(location);
    gl.VertexAttribPointer(location, attribute.components, attribute.type, attribute.normalized,
                           static_cast<GLsizei>(stride),
                           reinterpret_cast<const void*>(attribute.offset));
    ++location;
  }
  return result;
}

void delete_vertex_array(const Functions& gl, VertexArray& array) {
  gl.DeleteBuffers(1, &array.indices);
  gl.DeleteBuffers(1, &array.vertices);
  gl.DeleteVertexArrays(1, &array.array);
}

}  // namespace contactscope::gl
