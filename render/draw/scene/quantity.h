#pragma once

#include <array>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>

namespace contactscope::draw {

/// As std::printf prints the values, fewer than 96 characters.
template <class... Values>
std::string printed(const char* format, Values... values) {
  std::array<char, 96> text{};
  std::snprintf(text.data(), text.size(), format, values...);
  return text.data();
}

/// A plain number with at most so many significant digits and a real minus sign; very large and very
/// small ones with a power of ten: "6.7 × 10⁻⁴".
std::string spell_number(double value, int digits = 4);

/// "⁻⁴", for a power of ten.
std::string superscript(int exponent);

/// A whole number in groups of three digits: "11,175".
std::string spell_count(std::int64_t count);

/// A power of a thousand of a unit, from nano to giga.
struct Prefix {
  double size = 1;
  const char* name = "";
};
/// One that suits a value; of 0, and from 0.1 to 1000, none.
Prefix prefix_for(double value);

/// The one unit in which a picture, and the others of its sequence, tell lengths: nothing, each in
/// the one that fits it.
using LengthUnit = std::optional<Prefix>;
/// Metres from a metre on, then millimetres; micrometres and nanometres only where all is as small.
LengthUnit length_unit(double largest);

/// A length with three significant digits, "−5.00 mm", in that unit unless it is some hundred times
/// smaller or thousands of times larger. Of what was computed with an error of up to `noise` metres
/// digits end there, and less is "< 60 nm".
std::string spell_length(double metres, double noise = 0, const LengthUnit& unit = {});

/// 0.987 as "99 %", 0.0123 as "1.2 %"; "100 %" of all alone.
std::string spell_share(double share);

/// " × 20" for what is drawn so many times as long; nothing for 1.
std::string spell_factor(double factor);

/// How far a projected centre of mass is from the border of its support: in millimetres, as the
/// chart of the stability panel has it, unless that would be a strange number of them.
std::string spell_margin(double metres);

/// An area in the unit that fits (km², m², mm², µm²), four significant digits: "0.5858 m²".
/// Signed areas have a real minus sign.
std::string spell_area(double square_metres);

/// A number with unit and prefix, with at most so many significant digits: "12.3 mN s". `of_all`:
/// the prefix of all in a picture, used where the number stays one that a person would write.
std::string spell_quantity(double value, const std::string& unit, int digits = 3,
                           const std::optional<Prefix>& of_all = {});

/// "1 N s = 0.2 m", or of small impulses "10 mN s = 50 mm"; of another unit than newton seconds
/// likewise.
std::string spell_impulse_scale(double metres_per_unit, const std::string& unit = "N s");

/// The largest 1, 2 or 5 times a power of ten that is at most `value` > 0.
double round_down(double value);

}  // namespace contactscope::draw
