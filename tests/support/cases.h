#pragma once

#include <algorithm>
#include <cstdlib>

namespace contactscope::test {

/// Number of random cases to try: `usual`, or the environment's CONTACTSCOPE_CASES if larger.
inline int cases(int usual) {
  const char* const wanted = std::getenv("CONTACTSCOPE_CASES");
  return wanted == nullptr ? usual : std::max(usual, std::atoi(wanted));
}

}  // namespace contactscope::test
