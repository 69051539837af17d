#pragma once

#include "core/standard.h"

/// Numbers and lists as text, for pictures, reports and messages.
namespace contactscope {

/// Formats like std::printf; at most 511 characters.
template <class... Values> std::string printed(const char* format, Values... values) {
  std::array<char, 512> text{};
  std::snprintf(text.data(), text.size(), format, values...);
  return text.data();
}

/// "1 pair", "2 pairs"; `many` is only needed if it is not `one` with an "s".
std::string counted(std::size_t count, const std::string& one, const std::string& many = "");

/// A whole number in groups of three digits and with a real minus sign: "11,175".
std::string spell_count(std::int64_t count);

/// "⁻⁴", for a power of ten.
std::string superscript(int exponent);

/// The shortest decimal that reads back as the same number.
std::string shortest(double number);

/// Texts and whole numbers as they are.
struct SpellPlainly {
  std::string operator()(std::string_view text) const { return std::string(text); }
  std::string operator()(int number) const { return std::to_string(number); }
};

/// The entries of a list with `between` between them: "a, b, c". `spell` makes the text of each.
template <class List, class Spell = SpellPlainly>
std::string separated(const List& list, std::string_view between, const Spell& spell = {}) {
  std::string text, before;
  for (const auto& one : list) {
    text += before;
    text += std::invoke(spell, one);
    before = between;
  }
  return text;
}

/// "spheres, boxes and rods".
std::string listed(const std::vector<std::string>& names);

/// Length of the UTF-8 sequence that begins at `offset`; 0 if malformed. Follows Unicode 15,
/// section 3.9, table 3-7, "Well-Formed UTF-8 Byte Sequences".
std::size_t utf8_length(std::string_view text, std::size_t offset);

/// The first part of a name that terminals, shells or file formats would act on: "the control
/// character U+001B", "a NUL character", or "bytes that are not UTF-8". Empty if plain.
std::string not_plain(std::string_view text);

/// The text with each byte that not_plain() rejects escaped as "\x1b".
std::string printable(std::string_view text);

}  // namespace contactscope
