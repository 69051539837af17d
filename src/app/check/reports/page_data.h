#pragma once

#include <string_view>

namespace contactscope {

/// page.html, embedded by the build.
std::string_view check_page();

}  // namespace contactscope
