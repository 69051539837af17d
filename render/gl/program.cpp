#include "gl/program.h"

#include <stdexcept>
#include <string>

namespace contactscope::gl {
namespace {

GLuint compile(const Functions& gl, GLenum kind, const char* source) {
  const GLuint shader = gl.CreateShader(kind);
  gl.ShaderSource(shader, 1, &source, nullptr);
  gl.CompileShader(shader);
  GLint compiled = GL_FALSE;
  gl.GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  if (compiled) return shader;
  std::string log(4096, '\0');
  GLsizei length = 0;
  gl.GetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), &length, log.data());
  gl.DeleteShader(shader);
  throw std::runtime_error("the driver rejects a shader: " +
                           log.substr(0, static_cast<std::size_t>(length)));
}

}  // namespace

GLuint build_program(const Functions& gl, const char* vertex_source, const char* fragment_source,
                     std::initializer_list<const char*> attributes) {
  const GLuint program = gl.CreateProgram();
  for (const auto& [kind, source] :
       {std::pair<GLenum, const char*>{GL_VERTEX_SHADER, vertex_source},
        {GL_FRAGMENT_SHADER, fragment_source}}) {
    const GLuint shader = compile(gl, kind, source);
    gl.AttachShader(program, shader);
    gl.DeleteShader(shader);  // goes with the program
  }
  GLuint location = 0;
  for (const char* name : attributes) gl.BindAttribLocation(program, location++, name);
  gl.LinkProgram(program);
  GLint linked = GL_FALSE;
  gl.GetProgramiv(program, GL_LINK_STATUS, &linked);
  if (linked) return program;
  std::string log(4096, '\0');
  GLsizei length = 0;
  gl.GetProgramInfoLog(program, static_cast<GLsizei>(log.size()), &length, log.data());
  gl.DeleteProgram(program);
  throw std::runtime_error("the driver cannot link a program: " +
                           log.substr(0, static_cast<std::size_t>(length)));
}

}  // namespace contactscope::gl
