#pragma once

#include <dlfcn.h>

namespace contactscope::test {

/// OSMesa left Mesa in 25.1: what compares with it is skipped where there is none.
inline bool osmesa_is_installed() {
  return dlopen("libOSMesa.so.8", RTLD_LAZY) != nullptr;
}

}  // namespace contactscope::test
