#pragma once

#include <cstdlib>
#include <cstring>

// Goes into the copy of the tree that has bugs in it, and nowhere else.
namespace contactscope {

/// Whether the bug of this name is switched on, by $CONTACTSCOPE_PLANTED.
inline bool planted(const char* name) {
  const char* const chosen = std::getenv("CONTACTSCOPE_PLANTED");
  return chosen != nullptr && std::strcmp(chosen, name) == 0;
}

}  // namespace contactscope
