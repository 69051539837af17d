#include "support/exact_integer.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace contactscope::test {
namespace {

using Digits = std::vector<std::uint32_t>;

/// -1, 0 or 1 as |a| is less than, equal to or greater than |b|.
int compare(const Digits& a, const Digits& b) {
  if (a.size() != b.size()) return a.size() < b.size() ? -1 : 1;
  for (std::size_t i = a.size(); i-- > 0;) {
    if (a[i] != b[i]) return a[i] < b[i] ? -1 : 1;
  }
  return 0;
}

Digits added(const Digits& a, const Digits& b) {
  Digits result;
  std::uint64_t carry = 0;
  for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
    carry += (i < a.size() ? a[i] : 0ull) + (i < b.size() ? b[i] : 0ull);
    result.push_back(static_cast<std::uint32_t>(carry));
    carry >>= 32;
  }
  result.push_back(static_cast<std::uint32_t>(carry));
  return result;
}

/// |a| - |b| for |a| >= |b|.
Digits subtracted(const Digits& a, const Digits& b) {
  Digits result;
  std::int64_t borrow = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::int64_t digit = std::int64_t{a[i]} - (i < b.size() ? b[i] : 0u) - borrow;
    borrow = digit < 0 ? 1 : 0;
    digit += borrow << 32;
    result.push_back(static_cast<std::uint32_t>(digit));
  }
  return result;
}

}  // namespace

ExactInteger::ExactInteger(std::int64_t value) : negative_(value < 0) {
  const std::uint64_t magnitude =
      negative_ ? 0 - static_cast<std::uint64_t>(value) : static_cast<std::uint64_t>(value);
  digits_ = {static_cast<std::uint32_t>(magnitude), static_cast<std::uint32_t>(magnitude >> 32)};
  trim();
}

void ExactInteger::trim() {
  while (!digits_.empty() && digits_.back() == 0) digits_.pop_back();
  if (digits_.empty()) negative_ = false;
}

ExactInteger ExactInteger::of(double value, int exponent) {
  int of_value = 0;
  const double fraction = std::frexp(value, &of_value);  // value = fraction 2^of_value
  auto mantissa = static_cast<std::int64_t>(std::ldexp(fraction, 53));
  int shift = of_value - 53 - exponent;
  while (shift < 0 && mantissa % 2 == 0 && mantissa != 0) {
    mantissa /= 2;
    ++shift;
  }
  assert(shift >= 0 || mantissa == 0);
  if (mantissa == 0) return {};
  ExactInteger power;
  power.digits_.assign(static_cast<std::size_t>(shift / 32), 0);
  power.digits_.push_back(1u << (shift % 32));
  return ExactInteger(mantissa) * power;
}

double ExactInteger::top_digits(int& exponent) const {
  const std::size_t dropped = digits_.size() > 3 ? digits_.size() - 3 : 0;
  double value = 0;
  for (std::size_t i = digits_.size(); i-- > dropped;) value = value * 0x1p32 + digits_[i];
  exponent = static_cast<int>(32 * dropped);
  return negative_ ? -value : value;
}

double ExactInteger::to_double() const {
  int exponent = 0;
  const double top = top_digits(exponent);
  return std::ldexp(top, exponent);
}

double ExactInteger::ratio(const ExactInteger& a, const ExactInteger& b) {
  int of_a = 0, of_b = 0;
  const double top_a = a.top_digits(of_a), top_b = b.top_digits(of_b);
  return std::ldexp(top_a / top_b, of_a - of_b);
}

ExactInteger ExactInteger::operator-() const {
  ExactInteger result = *this;
  result.negative_ = !negative_ && !digits_.empty();
  return result;
}

ExactInteger operator+(const ExactInteger& a, const ExactInteger& b) {
  ExactInteger result;
  if (a.negative_ == b.negative_) {
    result.digits_ = added(a.digits_, b.digits_);
    result.negative_ = a.negative_;
  } else {
    const bool a_larger = compare(a.digits_, b.digits_) >= 0;
    result.digits_ = a_larger ? subtracted(a.digits_, b.digits_) : subtracted(b.digits_, a.digits_);
    result.negative_ = a_larger ? a.negative_ : b.negative_;
  }
  result.trim();
  return result;
}

ExactInteger operator*(const ExactInteger& a, const ExactInteger& b) {
  ExactInteger result;
  result.digits_.assign(a.digits_.size() + b.digits_.size(), 0);
  for (std::size_t i = 0; i < a.digits_.size(); ++i) {
    std::uint64_t carry = 0;
    for (std::size_t j = 0; j < b.digits_.size(); ++j) {
      carry += std::uint64_t{a.digits_[i]} * b.digits_[j] + result.digits_[i + j];
      result.digits_[i + j] = static_cast<std::uint32_t>(carry);
      carry >>= 32;
    }
    result.digits_[i + b.digits_.size()] = static_cast<std::uint32_t>(carry);
  }
  result.negative_ = a.negative_ != b.negative_;
  result.trim();
  return result;
}

int common_exponent(const std::vector<double>& values) {
  int least = std::numeric_limits<int>::max();
  for (const double value : values) {
    if (value == 0) continue;
    int exponent = 0;
    std::frexp(value, &exponent);
    least = std::min(least, exponent - 53);
  }
  return least == std::numeric_limits<int>::max() ? 0 : least;
}

}  // namespace contactscope::test
