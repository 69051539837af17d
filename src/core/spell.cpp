#include "core/spell.h"

#include <charconv>
#include <span>

#include "core/at.h"

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

}  // namespace contactscope
