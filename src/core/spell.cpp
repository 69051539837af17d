#include "core/spell.h"

namespace contactscope {

std::string counted(std::size_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many.empty() ? one + "s" : many);
}

std::string spell_count(std::int64_t count) {
  std::string digits = std::to_string(count < 0 ? -count : count);
  for (std::size_t i = digits.size(); i > 3;) digits.insert(i -= 3, ",");
  return (count < 0 ? "−" : "") + digits;
}

std::string superscript(int exponent) {
  constexpr std::array<const char*, 10> kDigits = {"⁰", "¹", "²", "³", "⁴",
                                                   "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "⁻" : "";
  for (const char digit : std::to_string(exponent < 0 ? -exponent : exponent))
    text += at(kDigits, digit - '0');
  return text;
}

std::string shortest(double number) {
  std::array<char, 32> text;
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), number).ptr};
}

std::string listed(const std::vector<std::string>& names) {
  if (names.size() < 2) return separated(names, "");
  return separated(std::span(names).first(names.size() - 1), ", ") + " and " + names.back();
}

namespace {

/// C0, DEL and the two-byte C1 characters.
bool is_control(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  return byte(at) < 0x20 || byte(at) == 0x7F || (byte(at) == 0xC2 && byte(at + 1) < 0xA0);
}

}  // namespace

std::size_t utf8_length(std::string_view text, std::size_t offset) {
  const auto byte = [&](std::size_t i) {
    return offset + i < text.size() ? static_cast<unsigned char>(text[offset + i]) : 0u;
  };
  const auto within = [&](std::size_t i, unsigned low, unsigned high) {
    return byte(i) >= low && byte(i) <= high;
  };
  const unsigned lead = byte(0);
  if (lead <= 0x7F) return 1;
  const std::size_t length = lead < 0xC2 || lead > 0xF4 ? 0 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
  const unsigned low = lead == 0xE0 ? 0xA0 : lead == 0xF0 ? 0x90 : 0x80;
  const unsigned high = lead == 0xED ? 0x9F : lead == 0xF4 ? 0x8F : 0xBF;
  bool well_formed = within(1, low, high);
  for (std::size_t i = 2; i < length; ++i) well_formed = well_formed && within(i, 0x80, 0xBF);
  return well_formed ? length : 0;
}

std::string not_plain(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = utf8_length(text, i);
    if (length == 0) return "bytes that are not UTF-8";
    if (is_control(text, i)) {
      const auto code = static_cast<unsigned char>(text[i + length - 1]);
      if (code == 0) return "a NUL character";
      return printed("the control character U+%04X", code);
    }
    i += length;
  }
  return {};
}

std::string printable(std::string_view text) {
  std::string shown;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = utf8_length(text, i);
    if (length > 0 && !is_control(text, i)) {
      shown += text.substr(i, length);
      i += length;
      continue;
    }
    for (const std::size_t end = i + (length > 0 ? length : 1); i < end; ++i)
      shown += printed("\\x%02x", static_cast<unsigned char>(text[i]));
  }
  return shown;
}

}  // namespace contactscope
