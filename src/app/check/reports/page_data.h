#pragma once

#include <string_view>

namespace contactscope::app {

/// page.html, embedded by the build.
std::string_view check_page();

}  // namespace contactscope::app
