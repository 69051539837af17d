#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "draw/scene/drawing.h"

/// SVG syntax.
namespace contactscope::vector {

/// Appends a number in its shortest form: "-.5", "12", "0".
void add_hundredths(std::int64_t value, std::string& out);
/// With at most two decimals.
std::string number(double value);

/// "#d55e00", or its short form "#fff"; ignores alpha.
std::string hex(const draw::Color& color);

/// Escapes text for XML and HTML. Control characters become spaces, because XML forbids them;
/// noncharacters and invalid UTF-8 become U+FFFD.
std::string escaped(std::string_view text);

/// Escapes JSON for a <script> element of HTML; it stays equivalent JSON. Characters with a meaning
/// in HTML or old JavaScript (<, >, &, U+2028, U+2029) become \u003c, ... They occur only in
/// strings.
std::string in_script(std::string_view json);

}  // namespace contactscope::vector
