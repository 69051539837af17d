#pragma once

#include <string_view>

namespace contactscope::page {

/// page.html, page.css and page.js, embedded by the build.
std::string_view page_markup();
std::string_view page_style();
std::string_view page_script();

}  // namespace contactscope::page
