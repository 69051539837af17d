#pragma once

#include <cstdint>
#include <cstdlib>

// Goes into the copy of the tree that has bugs in it, and nowhere else.
namespace contactscope::planted {

/// FNV-1a: a place compares a number and not a text, for some are in the innermost loops.
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
