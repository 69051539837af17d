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

/// `value` as it is with so many significant digits. Numbers are rounded first and then given a
/// unit, so that 0.9999 mm is spelled as 1.00 mm and not as 1.000 mm.
double rounded_to(int digits, double value) {
  return std::strtod(printed("%.*e", digits - 1, value).c_str(), nullptr);
}

/// With so many digits and a real minus sign; `value` is rounded to them.
std::string spelled(double value, int digits, const std::string& unit) {
  const double size = std::abs(value);
  const int whole = size > 0 ? static_cast<int>(std::floor(std::log10(size) + 1e-9)) + 1 : 1;
  return with_minus_sign(printed("%.*f", std::clamp(digits - whole, 0, digits), value)) + " " +
         unit;
}

}  // namespace

std::string spell_number(double value) {
  return with_minus_sign(printed("%.*g", 4, value));
}

std::string spell_count(std::int64_t count) {
  std::string text = std::to_string(count);
  const std::size_t first_digit = count < 0 ? 1 : 0;
  for (std::size_t i = text.size(); i > first_digit + 3;) text.insert(i -= 3, ",");
  return count < 0 ? with_minus_sign(text) : text;
}

std::string spell_length(double metres) {
  if (metres == 0) return "0 m";
  const double rounded = rounded_to(3, metres);
  Prefix prefix = prefix_for(rounded);
  if (prefix.size > 1) prefix = {1e3, "k"};
  return spelled(rounded / prefix.size, 3, std::string(prefix.name) + "m");
}

std::string spell_length(double metres, double noise) {
  if (metres == 0 || !(noise > 0)) return spell_length(metres);
  const double decade = std::pow(10.0, std::floor(std::log10(noise) + 1e-9));
  if (std::abs(metres) < noise) {
    const double most = decade * std::ceil(noise / decade - 1e-6);
    const Prefix prefix = prefix_for(most);
    return printed("< %.4g ", most / prefix.size) + prefix.name + "m";
  }
  const double most_digits = std::floor(std::log10(std::abs(metres) / decade) + 1e-9) + 1;
  const int digits = static_cast<int>(std::clamp(most_digits, 1.0, 3.0));
  const double rounded = rounded_to(digits, metres);
  Prefix prefix = prefix_for(rounded);
  if (prefix.size > 1) prefix = {1e3, "k"};
  return spelled(rounded / prefix.size, digits, std::string(prefix.name) + "m");
}

std::string spell_share(double share) {
  const double percent = 100 * share;
  if (percent == 0 || percent >= 100) return printed("%.0f %%", percent);
  // Only what is whole may be called so.
  if (percent > 99.5) return printed("%.1f %%", std::min(percent, 99.9));
  const int whole = static_cast<int>(std::floor(std::log10(std::abs(percent)))) + 1;
  return with_minus_sign(printed("%.*f %%", std::clamp(2 - whole, 0, 2), percent));
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
  if (!(std::abs(square_metres) > 0)) return "0 m²";
  const double rounded = rounded_to(4, square_metres), size = std::abs(rounded);
  const auto in = [&](double unit, const char* name) { return spelled(rounded / unit, 4, name); };
  if (size >= 1e5) return in(1e6, "km²");
  if (size >= 0.01) return in(1, "m²");
  return size >= 1e-8 ? in(1e-6, "mm²") : in(1e-12, "µm²");
}

double round_down(double value) {
  const double decade = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {5.0, 2.0}) {
    if (step * decade <= value * (1 + 1e-12)) return step * decade;
  }
  return decade;
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
  return spelled(rounded / prefix.size, digits, prefix.name + unit);
}

std::string spell_impulse_scale(double metres_per_unit, const std::string& unit) {
  // As many units as give a length that a person can imagine beside the bodies.
  double units = 1;
  while (metres_per_unit * units > 1) units /= 10;
  while (metres_per_unit * units < 0.1) units *= 10;
  return spell_quantity(units, unit, 1) + " = " + spell_quantity(metres_per_unit * units, "m", 1);
}

}  // namespace contactscope::draw
