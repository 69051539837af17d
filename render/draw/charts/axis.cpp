#include "draw/charts/axis.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace contactscope::draw {
namespace {

constexpr double kLeastSpan = 0.477;  // a factor of three, in decades
constexpr double kRounding = 1e-9;    // of a logarithm: a tick at the very end is on the axis

std::string superscript(int exponent) {
  constexpr std::array<const char*, 10> kDigits = {"⁰", "¹", "²", "³", "⁴",
                                                   "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "⁻" : "";
  for (const char digit : std::to_string(std::abs(exponent))) {
    text += kDigits[static_cast<std::size_t>(digit - '0')];
  }
  return text;
}

std::string plain(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6g", value);
  return text.data();
}

std::string power_of_ten(double value) {
  const int exponent = static_cast<int>(std::floor(std::log10(value) + kRounding));
  const int factor = static_cast<int>(std::lround(value / std::pow(10.0, exponent)));
  const std::string power = "10" + superscript(exponent);
  return factor == 1 ? power : std::to_string(factor) + "·" + power;
}

}  // namespace

Axis Axis::linear(double low, double high, float from, float to) {
  Axis axis;
  axis.low_ = low;
  axis.high_ = high;
  axis.from_ = from;
  axis.to_ = to;
  return axis;
}

Axis Axis::logarithmic(double low, double high, float from, float to, float before, float after) {
  Axis axis = linear(std::log10(low), std::log10(high), from, to);
  axis.logarithmic_ = true;
  const double missing = kLeastSpan - (axis.high_ - axis.low_);
  if (missing > 0) {
    axis.low_ -= 0.5 * missing;
    axis.high_ += 0.5 * missing;
  }
  const double length = std::abs(to - from);
  const double per_pixel = (axis.high_ - axis.low_) / std::max(1.0, length - before - after);
  axis.low_ -= before * per_pixel;
  axis.high_ += after * per_pixel;
  return axis;
}

float Axis::at(double value) const {
  const double share = ((logarithmic_ ? std::log10(value) : value) - low_) / (high_ - low_);
  return from_ + static_cast<float>(std::clamp(share, 0.0, 1.0)) * (to_ - from_);
}

std::vector<Axis::Tick> Axis::ticks(float least_decade) const {
  const bool minor = std::abs(to_ - from_) >= least_decade * (high_ - low_);
  std::vector<Tick> list;
  int decades = 0;
  for (int exponent = static_cast<int>(std::floor(low_)); exponent <= high_; ++exponent) {
    for (int factor = 1; factor <= (minor ? 9 : 1); ++factor) {
      const double logarithm = exponent + std::log10(factor);
      if (logarithm < low_ - kRounding || logarithm > high_ + kRounding) continue;
      Tick tick;
      tick.value = factor * std::pow(10.0, exponent);
      tick.at = at(tick.value);
      tick.decade = factor == 1;
      tick.labelled = tick.decade;
      decades += tick.decade;
      list.push_back(tick);
    }
  }
  if (decades >= 3) return list;
  for (Tick& tick : list) {
    const double exponent = std::floor(std::log10(tick.value) + kRounding);
    const long factor = std::lround(tick.value / std::pow(10.0, exponent));
    tick.labelled = factor == 1 || factor == 2 || factor == 5;
  }
  return list;
}

std::string spell_tick_time(double nanoseconds) {
  if (nanoseconds < 1e3 * (1 - kRounding)) return plain(nanoseconds) + " ns";
  if (nanoseconds < 1e6 * (1 - kRounding)) return plain(nanoseconds / 1e3) + " µs";
  return plain(nanoseconds / 1e6) + " ms";
}

std::string spell_tick_error(double value, const std::string& unit) {
  const bool short_enough = value > 0.9e-3 && value < 1e4;
  const std::string number = short_enough ? plain(value) : power_of_ten(value);
  return unit.empty() ? number : number + " " + unit;
}

}  // namespace contactscope::draw
