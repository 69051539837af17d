#pragma once

#include <string_view>

namespace contactscope::page {

/// page.html, page.css and page.js as the build embedded them.
std::string_view page_markup();
std::string_view page_style();
std::string_view page_script();

}  // namespace contactscope::page
