#include "draw/scene/quantity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace contactscope::draw {
namespace {

std::string with_minus_sign(const std::string& text) {
  return !text.empty() && text[0] == '-' ? "−" + text.substr(1) : text;
}

}  // namespace

std::string spell_number(double value) {
  return with_minus_sign(printed("%.*g", 4, value));
}

std::string spell_length(double metres) {
  struct Unit {
    double size;
    const char* name;
  };
  constexpr std::array<Unit, 5> kUnits{
      {{1e3, "km"}, {1.0, "m"}, {1e-3, "mm"}, {1e-6, "µm"}, {1e-9, "nm"}}};
  if (metres == 0) return "0 m";
  // Rounded first, so that 0.9999 mm is spelled as 1.00 mm and not as 1.000 mm.
  const double rounded = std::strtod(printed("%.*e", 2, metres).c_str(), nullptr);
  for (const Unit& unit : kUnits) {
    // From 0.1 m on metres, below that millimetres: what a person would say.
    const double least = unit.size == 1.0 ? 0.1 : unit.size;
    if (std::abs(rounded) < least * (1 - 1e-9) && unit.size > 1e-9) continue;
    const double value = rounded / unit.size;
    const int whole = static_cast<int>(std::floor(std::log10(std::abs(value)) + 1e-9)) + 1;
    const int decimals = std::clamp(3 - whole, 0, 3);
    return with_minus_sign(printed("%.*f", decimals, value)) + " " + unit.name;
  }
  return "0 m";
}

std::string spell_factor(double factor) {
  return factor == 1 ? "" : " × " + spell_number(factor);
}

std::string spell_margin(double metres) {
  if (metres < 1e-4 || metres >= 1) return spell_length(metres);
  const int decimals = metres >= 0.09995 ? 0 : metres >= 0.009995 ? 1 : 2;
  return printed("%.*f mm", decimals, 1e3 * metres);
}

std::string spell_area(double square_metres) {
  struct Unit {
    double size;
    double least;  // areas from here on are spelled in it
    const char* name;
  };
  constexpr std::array<Unit, 4> kUnits{
      {{1e6, 1e5, "km²"}, {1.0, 0.01, "m²"}, {1e-6, 1e-8, "mm²"}, {1e-12, 0, "µm²"}}};
  if (square_metres < 0) return "−" + spell_area(-square_metres);
  if (!(square_metres > 0)) return "0 m²";
  const double rounded = std::strtod(printed("%.*e", 3, square_metres).c_str(), nullptr);
  for (const Unit& unit : kUnits) {
    if (rounded < unit.least) continue;
    const double value = rounded / unit.size;
    const int whole = static_cast<int>(std::floor(std::log10(value) + 1e-9)) + 1;
    return printed("%.*f", std::clamp(4 - whole, 0, 4), value) + " " + unit.name;
  }
  return "0 m²";
}

Prefix prefix_for(double value) {
  constexpr std::array<Prefix, 7> kPrefixes{
      {{1e9, "G"}, {1e6, "M"}, {1e3, "k"}, {1, ""}, {1e-3, "m"}, {1e-6, "µ"}, {1e-9, "n"}}};
  if (value == 0) return {};
  for (const Prefix& prefix : kPrefixes) {
    // From 0.1 of the plain unit on, what a person would say.
    const double least = prefix.size == 1 ? 0.1 : prefix.size;
    if (std::abs(value) >= least * (1 - 1e-9)) return prefix;
  }
  return kPrefixes.back();
}

std::string spell_quantity(double value, const std::string& unit, int digits) {
  // Rounded first, so that 999.9 m becomes 1 k and not 1000.
  const double rounded = std::strtod(printed("%.*e", digits - 1, value).c_str(), nullptr);
  const Prefix prefix = prefix_for(rounded);
  const double scaled = rounded / prefix.size;
  int whole = std::abs(scaled) >= 1 * (1 - 1e-9) || scaled == 0 ? 1 : 0;
  for (double left = std::abs(scaled); left >= 10 * (1 - 1e-9); left /= 10) ++whole;
  return with_minus_sign(printed("%.*f", std::max(0, digits - whole), scaled)) + " " + prefix.name +
         unit;
}

}  // namespace contactscope::draw
