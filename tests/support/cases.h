#pragma once

#include <algorithm>
#include <cstdlib>

namespace contactscope::test {

/// How many random cases a test tries: `usual` ones, or as many as the environment's CONTACTSCOPE_CASES says where
/// that is more.
inline int cases(int usual) {
  const char* const wanted = std::getenv("CONTACTSCOPE_CASES");
  return wanted == nullptr ? usual : std::max(usual, std::atoi(wanted));
}

}  // namespace contactscope::test
