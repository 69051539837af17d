#include "draw/charts/axis.h"

#include "core/spell.h"
#include "trace/study.h"

namespace contactscope::draw {
namespace {

constexpr double kMinSpan = 0.477;  // a factor of three, in decades
constexpr double kRounding = 1e-9;  // of a logarithm: a tick at the very end is on the axis

std::string power_of_ten(double value) {
  const int exponent = static_cast<int>(std::floor(std::log10(value) + kRounding));
  const int factor = static_cast<int>(std::lround(value / std::pow(10.0, exponent)));
  const std::string power = "10" + superscript(exponent);
  return factor == 1 ? power : std::to_string(factor) + "·" + power;
}

}  // namespace

Axis Axis::logarithmic(double low, double high, float from, float to, float before, float after) {
  Axis axis{std::log10(low), std::log10(high), from, to, true};
  const double missing = std::max(0.0, kMinSpan - (axis.high - axis.low));
  axis.low -= 0.5 * missing;
  axis.high += 0.5 * missing;
  const double length = std::abs(to - from);
  const double per_pixel = (axis.high - axis.low) / std::max(1.0, length - before - after);
  axis.low -= before * per_pixel;
  axis.high += after * per_pixel;
  return axis;
}

float Axis::at(double value) const {
  const double share = ((is_logarithmic ? std::log10(value) : value) - low) / (high - low);
  return from + static_cast<float>(std::clamp(share, 0.0, 1.0)) * (to - from);
}

std::vector<double> Axis::multiples_of(double step) const {
  std::vector<double> values;
  for (double i = std::ceil(low / step - kRounding); i * step <= high + kRounding * step; ++i)
    values.push_back(i == 0 ? 0 : i * step);  // not -0
  return values;
}

std::vector<Axis::Tick> Axis::ticks(float least_decade) const {
  const bool minor = std::abs(to - from) >= least_decade * (high - low);
  std::vector<Tick> list;
  for (int exponent = static_cast<int>(std::floor(low)); exponent <= high; ++exponent) {
    for (int factor = 1; factor <= (minor ? 9 : 1); ++factor) {
      const double logarithm = exponent + std::log10(factor);
      if (logarithm < low - kRounding || logarithm > high + kRounding) continue;
      const double value = factor * std::pow(10.0, exponent);
      list.push_back({value, at(value), factor == 1, factor == 1 || factor == 2 || factor == 5});
    }
  }
  if (std::ranges::count_if(list, &Tick::decade) >= 3)
    for (Tick& tick : list) tick.labelled = tick.decade;
  return list;
}

std::string spell_tick_time(double nanoseconds) {
  if (nanoseconds < 1e3 * (1 - kRounding)) return printed("%.6g", nanoseconds) + " ns";
  if (nanoseconds < 1e6 * (1 - kRounding)) return printed("%.6g", nanoseconds / 1e3) + " µs";
  return printed("%.6g", nanoseconds / 1e6) + " ms";
}

std::string spell_tick_error(double value, const std::string& unit) {
  if (unit == trace::kShare) return spell_tick_error(100 * value, "%");
  const bool short_enough = value == 0 || (value > 0.9e-3 && value < 1e4);
  const std::string number = short_enough ? printed("%.6g", value) : power_of_ten(value);
  return unit.empty() ? number : number + " " + unit;
}

}  // namespace contactscope::draw
