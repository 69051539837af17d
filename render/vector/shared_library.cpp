#include "vector/shared_library.h"

#include <dlfcn.h>

#include "vector/font_subset.h"

namespace contactscope::vector {

SharedLibrary::SharedLibrary(const std::string& name, const std::string& package,
                             const std::string& purpose)
    : name_(name), package_(package), handle_(dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL)) {
  if (handle_ == nullptr) {
    throw MissingLibrary(purpose + " needs " + name +
                         ", which is not installed; install the Debian package " + package);
  }
}

void* SharedLibrary::address(const char* name) const {
  void* found = dlsym(handle_, name);
  if (found == nullptr) {
    throw MissingLibrary(name_ + " has no function " + name + ": it is older than in the package " +
                         package_ + " of Debian 12");
  }
  return found;
}

}  // namespace contactscope::vector
