#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "gl/context.h"
#include "gl/functions.h"

/// What context.cpp shares with the routes; no part of the interface of this folder.
namespace contactscope::gl {

/// Keeps count of which context is current on this thread.
class RouteContext : public Context {
 public:
  explicit RouteContext(std::string route) : route_(std::move(route)) {}

  const Functions& functions() const final { return functions_; }
  const std::string& route() const final { return route_; }
  void make_current() final;
  void release() final;

 protected:
  /// The route's own call. Throws ContextError.
  virtual void bind() = 0;
  virtual void unbind() = 0;

  Functions functions_;

 private:
  std::string route_;
};

/// A way to a context. `open` returns it current with its functions loaded, or throws ContextError
/// with the reason and the remedy.
struct Route {
  std::string name;
  std::function<std::unique_ptr<Context>()> open;
};

/// dlopen() without closing. Throws ContextError with the loader's reason and `remedy`.
void* open_library(const std::string& name, const std::string& remedy);
/// A function of an opened library. Throws ContextError.
void* find_symbol(void* library, const std::string& library_name, const char* symbol);

Route egl_surfaceless_route(const std::string& library);
/// One route a device that EGL lists; empty where it cannot list them.
std::vector<Route> egl_device_routes(const std::string& library);
Route osmesa_route(const std::string& library);

}  // namespace contactscope::gl
