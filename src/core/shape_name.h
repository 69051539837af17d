#pragma once

#include <string>
#include <string_view>

namespace contactscope {

/// "small_crate" of "small_crate_3": the number tells copies apart, and pictures call them alike. A name
/// that is all number is whole.
std::string_view kind_of_name(std::string_view name);

/// "small crate 3" of "small_crate3": what a scenario calls a shape, for people.
std::string name_in_words(std::string_view name);

}  // namespace contactscope
