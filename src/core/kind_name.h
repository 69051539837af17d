#pragma once

#include <string_view>

namespace contactscope {

/// "small_crate" of "small_crate_3": the number tells copies apart, and pictures call them alike. A name
/// that is all number is whole.
inline std::string_view kind_of_name(std::string_view name) {
  const std::size_t last = name.find_last_not_of("0123456789_- ");
  return last == std::string_view::npos ? name : name.substr(0, last + 1);
}

}  // namespace contactscope
