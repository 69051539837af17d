#pragma once

#include "core/spell.h"
#include "core/vec3.h"

/// Formats quantities for reports: suitable units, few digits.
namespace contactscope::snapshot {

/// "1.3 mm", "12.4 um", "1.25 m": three significant digits, no sign.
std::string spell_length(double metres);

/// "(0.7, 0, -0.71)": three significant digits each.
std::string spell_vector(const Vec3d& vector);

/// "0 3 5 6".
std::string spell_list(std::span<const int> numbers);

/// "3" or "3 to 9, 12": increasing numbers, with runs collapsed.
std::string spell_numbers(std::span<const int> numbers);

/// Two values with enough decimals to show two digits of their difference: "-0.0050", "-0.0037".
std::array<std::string, 2> spell_both(double a, double b);
/// Likewise, "-0.0050 -> -0.0037".
std::string spell_change(double expected, double actual);
std::string spell_change(const std::string& expected, const std::string& actual);
std::string spell_change(int expected, int actual);
std::string spell_change(std::span<const int> expected, std::span<const int> actual);

/// "moved 1.3 mm along x" or "moved 0.2 m along (0.7, 0, -0.71)"; the points must differ.
std::string spell_move(const Vec3d& expected, const Vec3d& actual);

/// "flipped" or "turned by 3.2 degrees"; the directions must differ.
std::string spell_turn(const Vec3d& expected, const Vec3d& actual);

/// "3.2 degrees": two significant digits.
std::string spell_angle(double radians);

}  // namespace contactscope::snapshot
