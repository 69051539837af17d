#include "snapshot/changes.h"

namespace contactscope::snapshot {

namespace {

/// `value` with `digits` significant digits, without an exponent if that is readable.
std::string significant(double value, int digits) {
  const bool plain = std::abs(value) >= std::pow(10.0, digits) && std::abs(value) < 1e7;
  const std::string text = plain ? printed("%.*f", 0, value) : printed("%.*g", digits, value);
  return text == "-0" ? "0" : text;
}

/// Exponent of the first significant digit: -3 for 0.0013.
int exponent(double positive) { return static_cast<int>(std::floor(std::log10(positive))); }

std::string fixed(double value, int decimals) {
  const std::string text = printed("%.*f", decimals, value);
  const bool zero = text.find_first_not_of("-0.") == std::string::npos;
  return zero && text.front() == '-' ? text.substr(1) : text;
}

}  // namespace

std::string spell_length(double metres) {
  struct Unit {
    const char* name;
    double metres;
  };
  constexpr Unit units[] = {{" m", 1}, {" mm", 1e-3}, {" um", 1e-6}, {" nm", 1e-9}};
  const double length = std::abs(metres);
  for (const Unit& unit : units) {
    // 999.6 um would round to 1000 um, so it reads 1 mm.
    if (!(length < 0.9995 * unit.metres)) return significant(length / unit.metres, 3) + unit.name;
  }
  return significant(length / 1e-9, 3) + " nm";
}

std::string spell_vector(const Vec3d& vector) {
  return "(" + separated(vector, ", ", [](double one) { return significant(one, 3); }) + ")";
}

std::string spell_list(std::span<const int> numbers) { return separated(numbers, " "); }

std::string spell_numbers(std::span<const int> numbers) {
  std::string text;
  for (std::size_t first = 0; first < numbers.size();) {
    std::size_t last = first;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
    text += (text.empty() ? "" : ", ") + std::to_string(numbers[first]);
    if (last > first) text += (last > first + 1 ? " to " : ", ") + std::to_string(numbers[last]);
    first = last + 1;
  }
  return text;
}

std::array<std::string, 2> spell_both(double expected, double actual) {
  const double difference = std::abs(actual - expected);
  constexpr int kMaxDecimals = 15;  // more digits are noise for numbers near one
  int decimals = kMaxDecimals + 1;
  if (std::isfinite(difference) && difference > 0) {
    decimals = std::max(0, 1 - exponent(difference));
    // -0.005 next to -0.25 must not read 0.00; much smaller numbers may.
    const double smaller = std::min(std::abs(expected), std::abs(actual));
    if (smaller > 0 && -exponent(smaller) <= decimals + 2)
      decimals = std::max(decimals, -exponent(smaller));
  }
  const bool large = std::max(std::abs(expected), std::abs(actual)) >= 1e15;
  if (decimals > kMaxDecimals || large)
    return {printed("%.*g", 17, expected), printed("%.*g", 17, actual)};
  return {fixed(expected, decimals), fixed(actual, decimals)};
}

std::string spell_change(double expected, double actual) {
  const auto [before, now] = spell_both(expected, actual);
  return before + " -> " + now;
}

std::string spell_change(const std::string& expected, const std::string& actual) {
  const auto shown = [](const std::string& text) { return text.empty() ? "(none)" : text; };
  return shown(expected) + " -> " + shown(actual);
}

std::string spell_change(int expected, int actual) {
  return std::to_string(expected) + " -> " + std::to_string(actual);
}

std::string spell_change(std::span<const int> expected, std::span<const int> actual) {
  return spell_change(spell_list(expected), spell_list(actual));
}

std::string spell_move(const Vec3d& expected, const Vec3d& actual) {
  const Vec3d move = actual - expected;
  const double distance = move.norm();
  if (!(distance > 0) || !std::isfinite(distance))
    return "moved from " + spell_vector(expected) + " to " + spell_vector(actual);
  const Vec3d direction = move / distance;
  std::string along = spell_vector(direction);
  // within about a degree of an axis
  constexpr double kAlongAxis = 0.9998;
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(direction[axis]) < kAlongAxis) continue;
    along = std::string(direction[axis] < 0 ? "-" : "") + "xyz"[axis];
  }
  return "moved " + spell_length(distance) + " along " + along;
}

std::string spell_turn(const Vec3d& expected, const Vec3d& actual) {
  const double sine = expected.cross(actual).norm(), cosine = expected.dot(actual);
  const double angle = std::atan2(sine, cosine);
  constexpr double kDegree = std::numbers::pi / 180;
  const double stretch = std::abs(actual.norm() - expected.norm());
  if (!std::isfinite(angle) || stretch > angle)
    return "changed " + spell_vector(expected) + " -> " + spell_vector(actual);
  if (angle > 179 * kDegree) return "flipped";
  return "turned by " + spell_angle(angle);
}

std::string spell_angle(double radians) {
  const std::string degrees = significant(radians * 180 / std::numbers::pi, 2);
  return degrees + (degrees == "1" ? " degree" : " degrees");
}

}  // namespace contactscope::snapshot
