#pragma once

#include <string>

namespace contactscope::vector {

/// A shared library opened when a format first needs it, because its dependencies (fonts, X11)
/// would slow down every start of the program. It is never closed.
class SharedLibrary {
 public:
  /// `name` is for the loader, "libcairo.so.2"; `package` provides it. Throws MissingLibrary.
  SharedLibrary(const std::string& name, const std::string& package, const std::string& purpose);

  /// Looks up a function, also in the library's dependencies.
  template <class Function>
  void find(const char* name, Function*& function) const {
    function = reinterpret_cast<Function*>(address(name));
  }

 private:
  void* address(const char* name) const;

  std::string name_, package_;
  void* handle_ = nullptr;
};

}  // namespace contactscope::vector
