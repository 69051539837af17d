#include "study/picture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/spell.h"

namespace contactscope::record {
namespace {

/// Units, the largest first; a value uses the first in which it is at least one.
struct Unit {
  double size;
  const char* name;
};

template <std::size_t Count>
std::string in_unit(double value, int digits, const std::array<Unit, Count>& units) {
  const auto fits = [&](const Unit& unit) { return value >= unit.size * 0.9995; };
  const auto found = std::ranges::find_if(units, fits);
  const Unit& unit = found == units.end() ? units.back() : *found;
  return number(value / unit.size, digits) + " " + unit.name;
}

}  // namespace

void drop_worst(trace::Study& study) {
  each_point(study, [](trace::StudyPoint& point) { point.error_worst.reset(); });
}

void scale_errors(trace::Study& study, double factor) {
  each_point(study, [&](trace::StudyPoint& point) {
    for (std::optional<double>* error : {&point.error, &point.error_worst})
      if (*error) **error *= factor;
  });
}

std::string number(double value, int digits) {
  if (value == 0) return "0";
  const double size = std::abs(value);
  int decimals = digits - 1 - static_cast<int>(std::floor(std::log10(size) + 1e-9));
  // Rounding may add a digit: 9.96 is "10".
  if (std::round(size * std::pow(10, decimals)) >= std::pow(10, digits)) --decimals;
  const double unit = std::pow(10, -decimals);
  std::string spelled = printed("%.*f", std::max(decimals, 0), std::round(size / unit) * unit);
  if (spelled.find('.') != std::string::npos) {
    spelled.erase(spelled.find_last_not_of('0') + 1);
    if (spelled.back() == '.') spelled.pop_back();
  }
  return (value < 0 ? "−" : "") + spelled;
}

std::string percent(double share) {
  // Rounds halves up, even if their double is slightly below, as for 57.5 % and 68.5 %.
  return number(100 * share * (1 + 1e-12)) + " %";
}

std::string count(double value) { return spell_count(std::llround(value)); }

std::string length(double metres, int digits) {
  constexpr std::array<Unit, 5> kUnits = {
      {{1e3, "km"}, {1, "m"}, {1e-2, "cm"}, {1e-3, "mm"}, {1e-6, "µm"}}};
  return in_unit(metres, digits, kUnits);
}

std::string duration(double nanoseconds, int digits) {
  constexpr std::array<Unit, 4> kUnits = {{{1e9, "s"}, {1e6, "ms"}, {1e3, "µs"}, {1, "ns"}}};
  return in_unit(nanoseconds, digits, kUnits);
}

std::string power(double value) {
  const int exponent = static_cast<int>(std::floor(std::log10(value) + 1e-9));
  const double factor = value / std::pow(10.0, exponent);
  if (exponent >= -3 && exponent < 4) return number(value);
  return (std::abs(factor - 1) < 0.05 ? "" : number(factor) + " × ") + "10" + superscript(exponent);
}

}  // namespace contactscope::record
