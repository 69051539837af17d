#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "draw/scene/drawing.h"

/// How SVG spells things.
namespace contactscope::vector {

/// Adds a number with at most two decimals and nothing that may be left out: "-.5", "12", "0".
void add_number(double value, std::string& out);
void add_hundredths(std::int64_t value, std::string& out);
std::string number(double value);

/// "#d55e00", or "#fff" where that says the same; without alpha.
std::string hex(const draw::Color& color);

/// Text as XML and HTML have it. Control characters, which XML does not know, become spaces; the two
/// noncharacters that it does not know, and what is not UTF-8, become U+FFFD.
std::string escaped(std::string_view text);

/// JSON that may stand in a <script> of HTML, and is the same JSON: what an HTML parser or an old JavaScript would
/// take for its own (<, >, & and the line ends U+2028 and U+2029) is spelled \u003c, ... These stand in strings
/// alone.
std::string in_script(std::string_view json);

}  // namespace contactscope::vector
