#pragma once

#include "gl/context.h"

/// Shared by context.cpp and the routes; not part of this folder's interface.
namespace contactscope::gl {

/// A method to open a context. `open` returns it current with its functions loaded, or throws
/// ContextError with the reason and a remedy.
struct Route {
  std::string name;
  std::function<std::unique_ptr<Context>()> open;
};

/// Makes a new context current and loads its functions. Throws ContextError with the name of the
/// first missing one.
std::unique_ptr<Context> started(std::unique_ptr<Context> context,
                                 const ProcAddress& get_proc_address);

/// An address that converts to any function pointer.
struct Symbol {
  void* address;

  template <class Function> operator Function*() const {
    return reinterpret_cast<Function*>(address);
  }
};

/// A library opened at run time and never closed.
struct Library {
  /// Throws ContextError with the loader's reason and `remedy`.
  Library(const std::string& library_name, const std::string& remedy);

  /// Throws ContextError if the symbol is missing.
  Symbol find(const char* symbol) const;

  std::string name;
  void* handle;
};

Route egl_surfaceless_route(const std::string& library);
/// One route per EGL device; empty if EGL cannot list them.
std::vector<Route> egl_device_routes(const std::string& library);
Route osmesa_route(const std::string& library);

}  // namespace contactscope::gl
