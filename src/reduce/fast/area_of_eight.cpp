#include "reduce/steps.h"

#include "core/three.h"

namespace contactscope {
namespace {

constexpr int kEight = 8;

template <class S> constexpr int kPacks = kEight / lanes::kWidest<S>;

/// One number for each of eight points.
template <class S> struct Eight {
  using P = lanes::Widest<S>;
  P of[kPacks<S>];

  /// Element-wise: what(pack of one, pack of another ...).
  template <class What, class... Others>
  [[gnu::always_inline]] static Eight from(const What& what, const Others&... others) {
    Eight result;
    for (int i = 0; i < kPacks<S>; ++i) result.of[i] = what(others.of[i]...);
    return result;
  }
};

/// Bit i is set if holds(numbers of point i ...), a comparison of packs.
template <class S, class Holds, class... Others>
[[gnu::always_inline]] inline std::uint32_t bits_of(const Holds& holds, const Others&... others) {
  std::uint32_t bits = 0;
  for (int i = 0; i < kPacks<S>; ++i)
    bits |= lanes::bits<S>(holds(others.of[i]...)) << (i * lanes::kWidest<S>);
  return bits;
}

template <class S> [[gnu::always_inline]] inline S most_of(const Eight<S>& values) {
  typename Eight<S>::P most = values.of[0];
  for (int i = 1; i < kPacks<S>; ++i) most = lanes::larger(most, values.of[i]);
  return lanes::largest<S>(most)[0];
}

/// The earliest point with this score.
template <class S> [[gnu::always_inline]] inline int earliest(const Eight<S>& scores, S most) {
  using P = typename Eight<S>::P;
  return std::countr_zero(bits_of<S>([&](const P& score) { return score == most; }, scores) |
                          1U << kEight);
}

/// Eight positions, one array per coordinate. Missing points repeat the first, which is earlier.
template <class S> struct Positions {
  Eight<S> x, y, z;

  /// Vectors from, and to, a position.
  [[gnu::always_inline]] Positions from(const Vec3<S>& place) const {
    using P = typename Eight<S>::P;
    const auto each = [](const Eight<S>& all, S one) {
      return Eight<S>::from([one](const P& value) -> P { return value - one; }, all);
    };
    return {each(x, place.x()), each(y, place.y()), each(z, place.z())};
  }
  [[gnu::always_inline]] Positions to(const Vec3<S>& place) const {
    using P = typename Eight<S>::P;
    const auto each = [](const Eight<S>& all, S one) {
      return Eight<S>::from([one](const P& value) -> P { return one - value; }, all);
    };
    return {each(x, place.x()), each(y, place.y()), each(z, place.z())};
  }
  [[gnu::always_inline]] Eight<S> dot(const Vec3<S>& v) const {
    using P = typename Eight<S>::P;
    return Eight<S>::from(
        [&v](const P& px, const P& py, const P& pz) {
          return dot_sum<S>(P(v.x() * px), P(v.y() * py), P(v.z() * pz));
        },
        x, y, z);
  }
  [[gnu::always_inline]] Eight<S> squared_norm() const {
    using P = typename Eight<S>::P;
    return Eight<S>::from(
        [](const P& px, const P& py, const P& pz) {
          return dot_sum<S>(P(px * px), P(py * py), P(pz * pz));
        },
        x, y, z);
  }
};

/// (qa x qb) . normal: Candidates::doubled_area() for all q.
template <class S>
[[gnu::always_inline]] inline Eight<S> doubled_areas(const Positions<S>& qa, const Positions<S>& qb,
                                                     const Vec3<S>& normal) {
  using P = typename Eight<S>::P;
  return Eight<S>::from(
      [&](const P& ax, const P& ay, const P& az, const P& bx, const P& by, const P& bz) {
        return dot_sum<S>(P((ay * bz - az * by) * normal.x()), P((az * bx - ax * bz) * normal.y()),
                          P((ax * by - ay * bx) * normal.z()));
      },
      qa.x, qa.y, qa.z, qb.x, qb.y, qb.z);
}

template <class S>
[[gnu::always_inline]] inline Positions<S> positions_of(const Candidates<S>& points) {
  using P = typename Eight<S>::P;
  Positions<S> result;
  if constexpr (lanes::kWidest<S> == 4) {
    // Loads four at a time, then transposes from one register per point to one per coordinate.
    const auto position = [&](int i) __attribute__((always_inline)) {
      return lanes::load_pack<P>(points[i < points.count() ? i : 0].data());
    };
    for (int i = 0; i < kPacks<S>; ++i) {
      const P a = position(4 * i), b = position(4 * i + 1), c = position(4 * i + 2),
              d = position(4 * i + 3);
      const P low_ab = __builtin_shufflevector(a, b, 0, 4, 1, 5);
      const P low_cd = __builtin_shufflevector(c, d, 0, 4, 1, 5);
      const P high_ab = __builtin_shufflevector(a, b, 2, 6, 3, 7);
      const P high_cd = __builtin_shufflevector(c, d, 2, 6, 3, 7);
      result.x.of[i] = __builtin_shufflevector(low_ab, low_cd, 0, 1, 4, 5);
      result.y.of[i] = __builtin_shufflevector(low_ab, low_cd, 2, 3, 6, 7);
      result.z.of[i] = __builtin_shufflevector(high_ab, high_cd, 0, 1, 4, 5);
    }
  } else {
    const ContactPoint<S>* at[kEight];
    for (int i = 0; i < kEight; ++i) at[i] = points.points.data() + (i < points.count() ? i : 0);
    for (int i = 0; i < kPacks<S>; ++i) {
      const auto each = [&](int axis) __attribute__((always_inline)) {
        return lanes::pack_of<P>(
            [&](int lane) { return at[i * lanes::kWidest<S> + lane]->position[axis]; });
      };
      result.x.of[i] = each(0);
      result.y.of[i] = each(1);
      result.z.of[i] = each(2);
    }
  }
  return result;
}

}  // namespace

/// Gregorius 2015, "Contact Point Reduction: 1st Point" to "4th Point (5)", as in area.cpp and
/// grow.h: the same sums and products in the same order, the earliest among equals.
template <class S>
[[gnu::flatten]] bool area_of_eight(const Candidates<S>& points, KeptIndices& kept) {
  using P = typename Eight<S>::P;
  const Vec3<S>& normal = points.normal;
  const Positions<S> at = positions_of(points);
  const Eight<S> along = at.from(points[0]).dot(steps::fixed_direction(normal));
  const int first = earliest(along, most_of(along)) % kEight;
  const Positions<S> to_first = at.to(points[first]);
  const Eight<S> distances = to_first.squared_norm();
  const S farthest = most_of(distances);
  // Limits the fourth powers of lengths below to finite numbers.
  constexpr S kFar = sizeof(S) == 4 ? S(2e8) : S(2e74);
  if (!(farthest > S(0) && farthest < kFar)) return false;
  const int second = earliest(distances, farthest);

  const S negligible = points.negligible_area(first, second);
  const Positions<S> to_second = at.to(points[second]);
  const Eight<S> doubled = doubled_areas(to_first, to_second, normal);
  const Eight<S> sizes =
      Eight<S>::from([](const P& area) { return lanes::larger(area, P(-area)); }, doubled);
  const S largest = most_of(sizes);
  if (!(largest > negligible)) return false;
  const int third = earliest(sizes, largest);
  kept.push_back(first);
  kept.push_back(second);
  kept.push_back(third);

  // If the ring third, first, second is clockwise, areas outside it are positive.
  const bool left =
      (bits_of<S>([](const P& area) { return area > P{}; }, doubled) >> third & 1U) != 0;
  const S clockwise = left ? S(-1) : S(1);
  const Positions<S> to_third = at.to(points[third]);
  const Eight<S> of_edges[] = {doubled_areas(to_third, to_first, normal), doubled,
                               doubled_areas(to_second, to_third, normal)};
  // Points of the ring and unused indices add nothing.
  alignas(32) constexpr S kNumbers[kEight] = {0, 1, 2, 3, 4, 5, 6, 7};
  const S count = static_cast<S>(points.count());
  const S a = static_cast<S>(first), b = static_cast<S>(second), c = static_cast<S>(third);
  Eight<S> added;
  for (int i = 0; i < kPacks<S>; ++i) {
    const P number = lanes::load_pack<P>(kNumbers + i * lanes::kWidest<S>);
    P most = lanes::larger(P(of_edges[0].of[i] * clockwise), P(of_edges[1].of[i] * clockwise));
    most = lanes::larger(most, P(of_edges[2].of[i] * clockwise));
    const auto is_other = (number != a) & (number != b) & (number != c) & (number < count);
    added.of[i] = is_other ? most : P{};
  }
  const S most = most_of(added);
  const int fourth = most > negligible ? earliest(added, most) : -1;
  if (fourth >= 0) kept.push_back(fourth);
  return true;
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(area_of_eight);

}  // namespace contactscope
