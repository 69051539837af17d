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
  template <class Function> void find(const char* name, Function*& function) const {
    function = reinterpret_cast<Function*>(address(name));
  }

 private:
  void* address(const char* name) const;

  std::string name_, package_;
  void* handle_ = nullptr;
};

/// Members of a struct for the functions that a list of rows names, and its constructor, which finds
/// them in its member `library`.
#define CONTACTSCOPE_MEMBER(name) decltype(&::name) name = nullptr;
#define CONTACTSCOPE_FIND(name) library.find(#name, name);
#define CONTACTSCOPE_FUNCTIONS(Struct, ROWS) \
  ROWS(CONTACTSCOPE_MEMBER)                  \
  Struct() { ROWS(CONTACTSCOPE_FIND) }

}  // namespace contactscope::vector
