#pragma once

#include <string>

namespace contactscope::draw {

/// A plain number with at most four significant digits and a real minus sign.
std::string spell_number(double value);

/// A length in the unit that fits (km, m, mm, µm, nm), three significant digits: "−5.00 mm".
std::string spell_length(double metres);

/// An area in the unit that fits (km², m², mm², µm²), four significant digits: "0.5858 m²".
/// Signed areas have a real minus sign.
std::string spell_area(double square_metres);

}  // namespace contactscope::draw
