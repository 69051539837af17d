#pragma once

#include <string>
#include <string_view>

namespace contactscope {

/// Length of the UTF-8 sequence that begins at `offset`; 0 if malformed. Follows Unicode 15,
/// section 3.9, table 3-7, "Well-Formed UTF-8 Byte Sequences".
std::size_t utf8_length(std::string_view text, std::size_t offset);

/// The first part of a name that terminals, shells or file formats would act on: "the control
/// character U+001B", "a NUL character", or "bytes that are not UTF-8". Empty if plain.
std::string not_plain(std::string_view text);

/// The text with each byte that not_plain() rejects escaped as "\x1b".
std::string printable(std::string_view text);

}  // namespace contactscope
