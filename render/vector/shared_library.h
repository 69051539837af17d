#pragma once

#include <string>

namespace contactscope::vector {

/// A shared library that is opened when a format first needs it: what it brings along (fonts, X11) would
/// cost every start of the program. It stays open.
class SharedLibrary {
 public:
  /// `name` as the linker calls it, "libcairo.so.2"; `package` has it. Throws MissingLibrary.
  SharedLibrary(const std::string& name, const std::string& package, const std::string& purpose);

  /// Sets a pointer to the function of that name, which may be one of a library that this one needs.
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
