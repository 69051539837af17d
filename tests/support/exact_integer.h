#pragma once

#include <cstdint>
#include <vector>

namespace contactscope::test {

/// An unbounded integer in schoolbook arithmetic: the oracle for exact results. Slow and simple; it
/// shares nothing with the arithmetic of the product.
class ExactInteger {
 public:
  ExactInteger() = default;
  ExactInteger(std::int64_t value);  // NOLINT(google-explicit-constructor): 2 * x reads best so

  /// value / 2^exponent, which must be an integer; value must be finite.
  static ExactInteger of(double value, int exponent);

  /// -1, 0 or 1.
  int sign() const { return digits_.empty() ? 0 : negative_ ? -1 : 1; }
  /// Correct to a few roundings; infinite if out of range.
  double to_double() const;
  /// a / b, correct to a few roundings for operands of any size; b must not be 0.
  static double ratio(const ExactInteger& a, const ExactInteger& b);

  ExactInteger operator-() const;
  friend ExactInteger operator+(const ExactInteger& a, const ExactInteger& b);
  friend ExactInteger operator-(const ExactInteger& a, const ExactInteger& b) { return a + -b; }
  friend ExactInteger operator*(const ExactInteger& a, const ExactInteger& b);
  friend bool operator==(const ExactInteger&, const ExactInteger&) = default;

 private:
  void trim();
  /// The number is about the result times 2^exponent.
  double top_digits(int& exponent) const;

  std::vector<std::uint32_t> digits_;  // base 2^32, lowest first, no leading zero
  bool negative_ = false;              // false for 0
};

/// -1, 0 or 1.
inline int sign_of(const ExactInteger& value) { return value.sign(); }

/// An exponent e for which every finite double of the list is a multiple of 2^e.
int common_exponent(const std::vector<double>& values);

}  // namespace contactscope::test
