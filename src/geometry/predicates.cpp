#include "geometry/predicates.h"

namespace contactscope::predicates {
namespace {

// ---- Exact expansions: Shewchuk 1997, section 2. Step names are from the paper.

/// An exact sum of two doubles: `head` is the rounded result, `tail` its rounding error.
struct Exact {
  double tail, head;
};

Exact two_sum(double a, double b) {
  const double head = a + b;
  const double of_b = head - a;
  const double of_a = head - of_b;
  return {(a - of_a) + (b - of_b), head};
}

/// The same if |a| >= |b|.
Exact fast_two_sum(double a, double b) {
  const double head = a + b;
  return {b - (head - a), head};
}

/// Splits a number into halves of 26 bits each (Dekker), whose products are exact.
Exact split(double a) {
  constexpr double kSplitter = 0x1p27 + 1;
  const double scaled = kSplitter * a;
  const double high = scaled - (scaled - a);
  return {a - high, high};
}

Exact two_product(double a, double b, const Exact& halves) {
  const double head = a * b;
  const Exact other = split(a);
  const double error =
      ((head - other.head * halves.head) - other.tail * halves.head) - other.head * halves.tail;
  return {other.tail * halves.tail - error, head};
}

/// An exact sum of nonzero terms that do not overlap and ascend, so the last one has its sign.
template <int kMax> struct Expansion {
  std::array<double, static_cast<std::size_t>(kMax)> terms;  // only the first `count` are set
  int count = 0;

  void push(double term) {
    if (term != 0) terms[static_cast<std::size_t>(count++)] = term;
  }
  double operator[](int i) const { return terms[static_cast<std::size_t>(i)]; }

  /// The sum, correct up to a few roundings, with the exact sign. The other terms together never
  /// exceed the last one; if their rounded sum cancels it, the last term is returned.
  double estimate() const {
    double sum = 0;
    for (int i = 0; i < count; ++i) sum += (*this)[i];
    return sum != 0 || count == 0 ? sum : (*this)[count - 1];
  }
};

/// a - b, exactly.
Expansion<2> difference(double a, double b) {
  const Exact exact = two_sum(a, -b);
  Expansion<2> result;
  result.push(exact.tail);
  result.push(exact.head);
  return result;
}

/// FAST-EXPANSION-SUM without zeros: a + sign b, terms in ascending magnitude.
template <int kA, int kB>
Expansion<kA + kB> sum(const Expansion<kA>& a, const Expansion<kB>& b, double sign = 1) {
  int i = 0, j = 0;
  const auto next = [&] {
    const bool take_a = j == b.count || (i < a.count && std::abs(a[i]) < std::abs(b[j]));
    return take_a ? a[i++] : sign * b[j++];
  };
  Expansion<kA + kB> result;
  const int terms = a.count + b.count;
  if (terms == 0) return result;
  double carried = next();
  for (int k = 1; k < terms; ++k) {
    const Exact exact = two_sum(carried, next());
    result.push(exact.tail);
    carried = exact.head;
  }
  result.push(carried);
  return result;
}

/// SCALE-EXPANSION without zeros.
template <int kA> Expansion<2 * kA> scaled(const Expansion<kA>& a, double factor) {
  Expansion<2 * kA> result;
  if (a.count == 0 || factor == 0) return result;
  const Exact halves = split(factor);
  const Exact first = two_product(a[0], factor, halves);
  result.push(first.tail);
  double carried = first.head;
  for (int i = 1; i < a.count; ++i) {
    const Exact product = two_product(a[i], factor, halves);
    const Exact low = two_sum(carried, product.tail);
    result.push(low.tail);
    const Exact high = fast_two_sum(product.head, low.head);
    result.push(high.tail);
    carried = high.head;
  }
  result.push(carried);
  return result;
}

/// a times a difference of two doubles.
template <int kA> Expansion<4 * kA> product(const Expansion<kA>& a, const Expansion<2>& b) {
  Expansion<2 * kA> low, high;
  if (b.count > 0) low = scaled(a, b[0]);
  if (b.count > 1) high = scaled(a, b[1]);
  return sum(low, high);
}

/// a b - c d.
Expansion<16> minor(const Expansion<2>& a, const Expansion<2>& b, const Expansion<2>& c,
                    const Expansion<2>& d) {
  return sum(product(a, b), product(c, d), -1);
}

// ---- 128-bit integers.

__extension__ using Wide = __int128;

/// Numbers as integer multiples of 1 / `scale`.
template <std::size_t kCount> struct Grid {
  std::array<std::int64_t, kCount> numbers;
  double scale;
};

/// A sum of six products of three 41-bit numbers stays below 2^127.
constexpr int kGridBits = 41;

/// Converts to a common grid where the largest number has kGridBits bits; none if one is off it.
template <std::size_t kCount>
std::optional<Grid<kCount>> on_grid(const std::array<double, kCount>& numbers) {
  constexpr std::uint64_t kBias = 1023, kMantissaBits = 52;
  // Range in which the predicates are valid; the cube of the grid's unit is normal there.
  constexpr std::uint64_t kMin = kBias - 303, kMax = kBias + 337;
  double largest = 0;
  for (const double number : numbers) largest = std::max(largest, std::abs(number));
  // The scale is a power of two, built from its bits.
  const std::uint64_t exponent = std::bit_cast<std::uint64_t>(largest) >> kMantissaBits;
  if (exponent < kMin || exponent > kMax) return std::nullopt;
  Grid<kCount> grid;
  grid.scale = std::bit_cast<double>((2 * kBias + kGridBits - 1 - exponent) << kMantissaBits);
  for (std::size_t i = 0; i < kCount; ++i) {
    const double moved = numbers[i] * grid.scale;
    grid.numbers[i] = static_cast<std::int64_t>(moved);
    if (static_cast<double>(grid.numbers[i]) != moved) return std::nullopt;
  }
  return grid;
}

Wide minor(std::int64_t a, std::int64_t b, std::int64_t c, std::int64_t d) {
  return static_cast<Wide>(a) * b - static_cast<Wide>(c) * d;
}

/// Stores to - from in `result`; returns true if it is exact.
bool exact_difference(double to, double from, double& result) {
  const Exact exact = two_sum(to, -from);
  result = exact.head;
  return exact.tail == 0;
}

}  // namespace

double exact_orient3d(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
  std::array<double, 9> m;  // rows b - a, c - a, d - a
  bool exact = true;
  for (int i = 0; i < 3; ++i) {
    const auto column = static_cast<std::size_t>(i);
    exact &= exact_difference(b[i], a[i], m[column]);
    exact &= exact_difference(c[i], a[i], m[3 + column]);
    exact &= exact_difference(d[i], a[i], m[6 + column]);
  }
  if (exact) {
    if (const std::optional<Grid<9>> grid = on_grid(m)) {
      const auto& n = grid->numbers;
      const Wide value = minor(n[1], n[5], n[2], n[4]) * n[6] +
                         minor(n[2], n[3], n[0], n[5]) * n[7] +
                         minor(n[0], n[4], n[1], n[3]) * n[8];
      const double unit = 1 / grid->scale;
      return static_cast<double>(value) * unit * unit * unit;
    }
  }
  const auto row = [&a](const Vec3d& point) {
    return std::array<Expansion<2>, 3>{difference(point.x(), a.x()), difference(point.y(), a.y()),
                                       difference(point.z(), a.z())};
  };
  const auto u = row(b), v = row(c), w = row(d);
  const auto x = product(minor(u[1], v[2], u[2], v[1]), w[0]);
  const auto y = product(minor(u[2], v[0], u[0], v[2]), w[1]);
  const auto z = product(minor(u[0], v[1], u[1], v[0]), w[2]);
  return sum(sum(x, y), z).estimate();
}

double exact_orient2d(const Vec3d& a, const Vec3d& b, const Vec3d& c, int axis) {
  const int x = (axis + 1) % 3, y = (axis + 2) % 3;
  return minor(difference(b[x], a[x]), difference(c[y], a[y]), difference(b[y], a[y]),
               difference(c[x], a[x]))
      .estimate();
}

}  // namespace contactscope::predicates
