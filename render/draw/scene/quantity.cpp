#include "draw/scene/quantity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <span>

namespace contactscope::draw {
namespace {

std::string with_minus_sign(const std::string& text) {
  return !text.empty() && text[0] == '-' ? "−" + text.substr(1) : text;
}

/// `value` as it is with so many significant digits. Numbers are rounded first and then given a unit,
/// so that 0.9999 mm is spelled as 1.00 mm and not as 1.000 mm.
double rounded_to(int digits, double value) {
  return std::strtod(printed("%.*e", digits - 1, value).c_str(), nullptr);
}

struct Unit {
  double size;
  double least;  // quantities from here on are spelled in it
  const char* name;
};

/// In the first unit that is small enough, or the last. `value` is not 0.
std::string in_unit(double value, std::span<const Unit> units, int digits) {
  const double rounded = rounded_to(digits, value);
  const auto fits = [&](const Unit& unit) { return !(std::abs(rounded) < unit.least); };
  const auto found = std::ranges::find_if(units, fits);
  const Unit& unit = found == units.end() ? units.back() : *found;
  const double shown = rounded / unit.size;
  const int whole = static_cast<int>(std::floor(std::log10(std::abs(shown)) + 1e-9)) + 1;
  return with_minus_sign(printed("%.*f", std::clamp(digits - whole, 0, digits), shown)) + " " +
         unit.name;
}

}  // namespace

std::string spell_number(double value) {
  return with_minus_sign(printed("%.*g", 4, value));
}

std::string spell_length(double metres) {
  constexpr double kAlmost = 1 - 1e-9;
  // From 0.1 m on metres, below that millimetres: what a person would say.
  constexpr Unit kUnits[] = {{1e3, 1e3 * kAlmost, "km"},
                             {1.0, 0.1 * kAlmost, "m"},
                             {1e-3, 1e-3 * kAlmost, "mm"},
                             {1e-6, 1e-6 * kAlmost, "µm"},
                             {1e-9, 0, "nm"}};
  return metres == 0 ? "0 m" : in_unit(metres, kUnits, 3);
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
  constexpr Unit kUnits[] = {
      {1e6, 1e5, "km²"}, {1.0, 0.01, "m²"}, {1e-6, 1e-8, "mm²"}, {1e-12, 0, "µm²"}};
  return std::abs(square_metres) > 0 ? in_unit(square_metres, kUnits, 4) : "0 m²";
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
  const double rounded = rounded_to(digits, value);
  const Prefix prefix = prefix_for(rounded);
  const double scaled = rounded / prefix.size;
  int whole = std::abs(scaled) >= 1 * (1 - 1e-9) || scaled == 0 ? 1 : 0;
  for (double left = std::abs(scaled); left >= 10 * (1 - 1e-9); left /= 10) ++whole;
  return with_minus_sign(printed("%.*f", std::max(0, digits - whole), scaled)) + " " + prefix.name +
         unit;
}

}  // namespace contactscope::draw
