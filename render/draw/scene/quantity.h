#pragma once

#include "core/spell.h"

namespace contactscope::draw {

/// A plain number with at most `digits` significant digits and a real minus sign. Very large and
/// very small numbers get a power of ten: "6.7 × 10⁻⁴".
std::string spell_number(double value, int digits = 4);

/// A unit prefix in powers of a thousand, from nano to giga.
struct Prefix {
  double size = 1;
  const char* name = "";
};
/// The prefix that suits a value; none for 0 and from 0.1 to 1000.
Prefix prefix_for(double value);

/// Common unit of the lengths in a picture and its sequence; nothing: each length has its own.
using LengthUnit = std::optional<Prefix>;
/// Metres from 1 m on, then millimetres; µm and nm only if all lengths are that small.
LengthUnit length_unit(double largest);

/// A length with three significant digits, "−5.00 mm", in `unit` unless it is a hundred times
/// smaller or ten thousand times larger. For values with an error of up to `noise` metres the
/// digits end there, and smaller values become "< 60 nm".
std::string spell_length(double metres, double noise = 0, const LengthUnit& unit = {});

/// 0.987 as "99 %", 0.0123 as "1.2 %"; only exactly 1 becomes "100 %".
std::string spell_share(double share);

/// " × 20" for a length drawn 20 times as long; empty for 1.
std::string spell_factor(double factor);

/// Distance of a projected centre of mass from the border of its support. In millimetres, as in the
/// chart of the stability panel, unless the number would be odd.
std::string spell_margin(double metres);

/// An area in the unit that fits (km², m², mm², µm²), four significant digits: "0.5858 m²".
/// Signed areas have a real minus sign.
std::string spell_area(double square_metres);

/// A number with unit and prefix, with at most `digits` significant digits: "12.3 mN s". `of_all`:
/// common prefix of a picture, used if the number stays readable.
std::string spell_quantity(double value, const std::string& unit, int digits = 3,
                           const std::optional<Prefix>& of_all = {});

/// "1 N s = 0.2 m", or "10 mN s = 50 mm" for small impulses; other units likewise.
std::string spell_impulse_scale(double metres_per_unit, const std::string& unit = "N s");

/// The largest 1, 2 or 5 times a power of ten that is at most `value` > 0, and the smallest that is
/// at least that.
double round_down(double value);
double round_up(double value);

}  // namespace contactscope::draw
