#pragma once

#include <string_view>
#include <vector>

namespace contactscope::lint {

/// Names of all causes that findings may have.
std::vector<std::string_view> causes();

}  // namespace contactscope::lint
