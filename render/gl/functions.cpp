#include "gl/functions.h"

#include <string>

#include "gl/context.h"

namespace contactscope::gl {
namespace {

template <class Function>
void load(Function& function, const char* name,
          const std::function<void*(const char*)>& get_proc_address) {
  function = reinterpret_cast<Function>(get_proc_address(name));
  if (!function) throw ContextError(std::string("the driver has no ") + name);
}

}  // namespace

Functions load_functions(const std::function<void*(const char*)>& get_proc_address) {
  Functions functions;
#define CONTACTSCOPE_LOAD(name, type) load(functions.name, "gl" #name, get_proc_address);
  CONTACTSCOPE_GL_FUNCTIONS(CONTACTSCOPE_LOAD)
#undef CONTACTSCOPE_LOAD
  return functions;
}

}  // namespace contactscope::gl
