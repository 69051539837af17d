#include "draw/scene/quantity.h"

namespace contactscope::draw {
namespace {

// Range of values for which a quantity uses a unit other than its own.
constexpr double kMinInUnit = 1e-2, kMaxInUnit = 1e4;

std::string with_minus_sign(const std::string& text) {
  return !text.empty() && text[0] == '-' ? "−" + text.substr(1) : text;
}

/// `value` rounded to `digits` significant digits. Numbers are rounded before they get a unit, so
/// that 0.9999 mm is written as 1.00 mm and not as 1.000 mm.
double rounded_to(int digits, double value) {
  return std::strtod(printed("%.*e", digits - 1, value).c_str(), nullptr);
}

/// Writes `value`, which is rounded to `digits` digits, with a real minus sign.
std::string spelled(double value, int digits, const std::string& unit) {
  const double size = std::abs(value);
  const int whole = size > 0 ? static_cast<int>(std::floor(std::log10(size) + 1e-9)) + 1 : 1;
  return with_minus_sign(printed("%.*f", std::clamp(digits - whole, 0, digits + 2), value)) + " " +
         unit;
}

}  // namespace

std::string spell_number(double value, int digits) {
  constexpr double kMinPlain = 1e-3;  // smaller ones would have zeros to count
  const bool small = value != 0 && std::abs(value) < kMinPlain * (1 - 1e-9);
  std::string text =
      with_minus_sign(small ? printed("%.*e", digits - 1, value) : printed("%.*g", digits, value));
  const std::size_t power = text.find('e');
  if (power == std::string::npos) return text;
  const int exponent = std::stoi(text.substr(power + 1));
  text.resize(power);
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text + " × 10" + superscript(exponent);
}

LengthUnit length_unit(double largest) {
  if (!(largest > 0)) return {};
  if (largest >= 1) return Prefix{};
  if (largest >= 2e-4) return Prefix{1e-3, "m"};
  return largest >= 1e-6 ? Prefix{1e-6, "µ"} : Prefix{1e-9, "n"};
}

std::string spell_length(double metres, double noise, const LengthUnit& unit) {
  const auto prefix_of = [&](double length) {
    const double in_unit = unit ? std::abs(length) / unit->size : 0;
    if (in_unit >= kMinInUnit && in_unit < kMaxInUnit) return *unit;
    const Prefix fitting = prefix_for(length);
    return fitting.size > 1 ? Prefix{1e3, "k"} : fitting;
  };
  if (metres == 0) return std::string("0 ") + (unit ? unit->name : "") + "m";
  int digits = 3;
  if (noise > 0) {
    const double decade = std::pow(10.0, std::floor(std::log10(noise) + 1e-9));
    if (std::abs(metres) < noise) {
      const double most = decade * std::ceil(noise / decade - 1e-6);
      const Prefix prefix = prefix_of(most);
      return "< " + spell_number(most / prefix.size) + " " + prefix.name + "m";
    }
    const double most_digits = std::floor(std::log10(std::abs(metres) / decade) + 1e-9) + 1;
    digits = static_cast<int>(std::clamp(most_digits, 1.0, 3.0));
  }
  const double rounded = rounded_to(digits, metres);
  const Prefix prefix = prefix_of(rounded);
  return spelled(rounded / prefix.size, digits, std::string(prefix.name) + "m");
}

std::string spell_share(double share) {
  const double percent = 100 * share;
  if (percent == 0 || percent >= 100) return printed("%.0f %%", percent);
  // Only exactly whole shares are written as 100 %.
  if (percent > 99.5) return printed("%.1f %%", std::min(percent, 99.9));
  const int whole = static_cast<int>(std::floor(std::log10(std::abs(percent)))) + 1;
  return with_minus_sign(printed("%.*f %%", std::clamp(2 - whole, 0, 2), percent));
}

std::string spell_factor(double factor) { return factor == 1 ? "" : " × " + spell_number(factor); }

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
  for (const double step : {5.0, 2.0})
    if (step * decade <= value * (1 + 1e-12)) return step * decade;
  return decade;
}

double round_up(double value) {
  const double decade = std::pow(10.0, std::floor(std::log10(value)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * decade >= value) return factor * decade;
  return 10 * decade;
}

Prefix prefix_for(double value) {
  constexpr std::array<Prefix, 7> kPrefixes{
      {{1e9, "G"}, {1e6, "M"}, {1e3, "k"}, {1, ""}, {1e-3, "m"}, {1e-6, "µ"}, {1e-9, "n"}}};
  if (value == 0) return {};
  for (const Prefix& prefix : kPrefixes) {
    // From 0.1 of the plain unit on, as people write it.
    const double least = prefix.size == 1 ? 0.1 : prefix.size;
    if (std::abs(value) >= least * (1 - 1e-9)) return prefix;
  }
  return kPrefixes.back();
}

std::string spell_quantity(double value, const std::string& unit, int digits,
                           const std::optional<Prefix>& of_all) {
  const double rounded = rounded_to(digits, value);
  const double in_all = of_all ? std::abs(rounded) / of_all->size : 0;
  const bool fits = in_all >= kMinInUnit && in_all < kMaxInUnit;
  const Prefix prefix = fits ? *of_all : prefix_for(rounded);
  return spelled(rounded / prefix.size, digits, prefix.name + unit);
}

std::string spell_impulse_scale(double metres_per_unit, const std::string& unit) {
  // The power of ten of units whose length is easy to compare with the bodies.
  double units = 1;
  while (metres_per_unit * units > 1) units /= 10;
  while (metres_per_unit * units < 0.1) units *= 10;
  return spell_quantity(units, unit, 1) + " = " + spell_quantity(metres_per_unit * units, "m", 1);
}

}  // namespace contactscope::draw
