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

/// Text as XML has it; control characters, which XML does not know, become spaces.
std::string escaped(std::string_view text);

}  // namespace contactscope::vector
