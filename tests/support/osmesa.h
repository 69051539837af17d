#pragma once

#include <dlfcn.h>

namespace contactscope::test {

/// Mesa 25.1 dropped OSMesa. Tests that compare with it are skipped if it is not installed.
inline bool osmesa_is_installed() { return dlopen("libOSMesa.so.8", RTLD_LAZY) != nullptr; }

}  // namespace contactscope::test
