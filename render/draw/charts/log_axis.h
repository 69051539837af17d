#pragma once

#include <string>
#include <vector>

namespace contactscope::draw {

/// A logarithmic axis: values > 0 to pixels of the canvas, along x or y.
class LogAxis {
 public:
  /// Spans at least `low` to `high` (0 < low <= high), widened to a factor of three, with so many
  /// pixels before and after. `from` is the pixel of the low end, `to` of the high one.
  LogAxis(double low, double high, float from, float to, float before, float after);

  /// Values beyond the axis lie on its ends.
  float at(double value) const;

  struct Tick {
    double value = 0;
    float at = 0;         // pixels
    bool decade = false;  // a power of ten
    bool labelled = false;
  };
  /// Every power of ten on the axis, and 2 to 9 times each where a decade is at least
  /// `least_decade` pixels long, in growing order. Decades are labelled; where there are fewer than
  /// three of them, 2 and 5 as well.
  std::vector<Tick> ticks(float least_decade = 0) const;

 private:
  double low_, high_;  // logarithms
  float from_, to_;
};

/// "50 ns", "1 µs", "2 ms" for a tick at 1, 2 or 5 times a power of ten.
std::string spell_tick_time(double nanoseconds);

/// "0.01", "10⁻⁴" for a tick of a number without unit; with unit "m" as lengths are spelled.
std::string spell_tick_error(double value, const std::string& unit);

}  // namespace contactscope::draw
