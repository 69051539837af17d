#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "gl/context.h"

/// What context.cpp shares with the routes; no part of the interface of this folder.
namespace contactscope::gl {

/// A way to a context. `open` returns it current with its functions loaded, or throws ContextError
/// with the reason and the remedy.
struct Route {
  std::string name;
  std::function<std::unique_ptr<Context>()> open;
};

/// Makes a new context current and loads its functions. Throws ContextError with the name of the
/// first that is missing.
std::unique_ptr<Context> started(std::unique_ptr<Context> context,
                                 const ProcAddress& get_proc_address);

/// An address that becomes a pointer to whatever function is asked for.
struct Symbol {
  void* address;

  template <class Function>
  operator Function*() const {
    return reinterpret_cast<Function*>(address);
  }
};

/// A library that is opened at run time, and never closed.
struct Library {
  /// Throws ContextError with the loader's reason and `remedy`.
  Library(const std::string& library_name, const std::string& remedy);

  /// Throws ContextError where the library has no symbol of that name.
  Symbol find(const char* symbol) const;

  std::string name;
  void* handle;
};

Route egl_surfaceless_route(const std::string& library);
/// One route a device that EGL lists; empty where it cannot list them.
std::vector<Route> egl_device_routes(const std::string& library);
Route osmesa_route(const std::string& library);

}  // namespace contactscope::gl
