#pragma once

#include <string_view>

namespace contactscope::app {

/// page.html as the build embedded it.
std::string_view check_page();

}  // namespace contactscope::app
