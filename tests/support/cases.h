#pragma once

#include <algorithm>
#include <cstdlib>

#if defined(__SANITIZE_ADDRESS__)
#define CONTACTSCOPE_IS_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define CONTACTSCOPE_IS_SANITIZED 1
#endif
#endif
#if !defined(CONTACTSCOPE_IS_SANITIZED)
#define CONTACTSCOPE_IS_SANITIZED 0
#endif

namespace contactscope::test {

/// Under the sanitizers, which find bad memory accesses in any case, random tests try one in this
/// many.
inline constexpr int kOneIn = CONTACTSCOPE_IS_SANITIZED ? 5 : 1;

/// Number of random cases to try: `usual`, or the environment's CONTACTSCOPE_CASES if larger.
inline int cases(int usual) {
  const char* const wanted = std::getenv("CONTACTSCOPE_CASES");
  return wanted == nullptr ? std::max(1, usual / kOneIn) : std::max(usual, std::atoi(wanted));
}

}  // namespace contactscope::test
