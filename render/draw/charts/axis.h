#pragma once

#include "draw/scene/drawing.h"

namespace contactscope::draw {

/// Colours of grid and border in every chart.
inline constexpr Color kChartGrid{0.835f, 0.855f, 0.875f, 1};
inline constexpr Color kChartBorder{0.541f, 0.565f, 0.600f, 1};

/// Maps values to canvas pixels, along x or y.
struct Axis {
  double low = 0, high = 1;  // or their logarithms
  float from = 0, to = 1;    // pixels of these ends
  bool is_logarithmic = false;

  /// Spans at least `low` to `high` (0 < low <= high), widened to at least a factor of three, with
  /// `before` and `after` pixels added at the ends.
  static Axis logarithmic(double low, double high, float from, float to, float before, float after);

  /// Values beyond the axis are clamped to its ends.
  float at(double value) const;

  /// The multiples of a step on a linear axis, ascending.
  std::vector<double> multiples_of(double step) const;

  struct Tick {
    double value = 0;
    float at = 0;         // pixels
    bool decade = false;  // a power of ten
    bool labelled = false;
  };
  /// For a logarithmic axis: all powers of ten on it, and 2 to 9 times each if a decade has at
  /// least `least_decade` pixels, ascending. Decades are labelled; if fewer than three, also 2 and
  /// 5.
  std::vector<Tick> ticks(float least_decade = 0) const;
};

/// "50 ns", "1 µs", "2 ms" for a tick at 1, 2 or 5 times a power of ten.
std::string spell_tick_time(double nanoseconds);

/// "0.01", "10⁻⁴" for a tick without unit; with "m" a length, with trace::kShare percent.
std::string spell_tick_error(double value, const std::string& unit);

}  // namespace contactscope::draw
