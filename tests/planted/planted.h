#pragma once

#include <cstdint>
#include <cstdlib>

// Only in the copy of the tree that contains the bugs.
namespace contactscope::planted {

/// FNV-1a: places compare numbers, not texts, because some are in the innermost loops.
constexpr std::uint64_t number_of(const char* name) {
  std::uint64_t number = 14695981039346656037u;
  for (; *name != '\0'; ++name) number = (number ^ static_cast<unsigned char>(*name)) * 1099511628211u;
  return number;
}

/// The bug that $CONTACTSCOPE_PLANTED names, read once before main().
inline const std::uint64_t kChosen = [] {
  const char* const name = std::getenv("CONTACTSCOPE_PLANTED");
  return name == nullptr ? std::uint64_t{0} : number_of(name);
}();

consteval std::uint64_t number(const char* name) { return number_of(name); }

}  // namespace contactscope::planted
