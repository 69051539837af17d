#pragma once

#include <string>
#include <string_view>

namespace contactscope {

/// Name without the number of a copy: "small_crate" for "small_crate_3". Pictures use it for all
/// copies. A name of digits only is returned whole.
std::string_view kind_of_name(std::string_view name);

/// Display form of a scenario's shape name: "small crate 3" for "small_crate3".
std::string name_in_words(std::string_view name);

}  // namespace contactscope
