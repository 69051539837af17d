#pragma once

#include "core/pack.h"

namespace contactscope {

/// Axis-aligned bounding box, closed, metres. Empty at first: lower +infinity, upper -infinity.
template <class S> struct Aabb {
  using Scalar = S;

  Vec3<S> lower = Vec3<S>::Constant(std::numeric_limits<S>::infinity());
  Vec3<S> upper = Vec3<S>::Constant(-std::numeric_limits<S>::infinity());

  /// True if no point is inside, and for a box with NaN.
  bool empty() const {
    return !(lower.x() <= upper.x() && lower.y() <= upper.y() && lower.z() <= upper.z());
  }
  Vec3<S> center() const { return S(0.5) * lower + S(0.5) * upper; }
  Vec3<S> extent() const { return upper - lower; }

  bool contains(const Aabb& other) const {
    return ((lower.array() <= other.lower.array()) && (other.upper.array() <= upper.array())).all();
  }

  /// Grows to contain a point or a box. Between 0.0 and -0.0 the old value stays: the minimum
  /// instructions of NEON and SSE2 differ here, and traces are compared byte for byte.
  void include(const Vec3<S>& point) { include(Aabb{point, point}); }
  void include(const Aabb& other) {
    for (int k = 0; k < 3; ++k) {
      lower[k] = other.lower[k] < lower[k] ? other.lower[k] : lower[k];
      upper[k] = other.upper[k] > upper[k] ? other.upper[k] : upper[k];
    }
  }

  /// Rounds to nearest, which is monotone: the box of points becomes that of the rounded points.
  template <class T> Aabb<T> cast() const {
    return {lower.template cast<T>(), upper.template cast<T>()};
  }

  friend bool operator==(const Aabb&, const Aabb&) = default;
};

inline Aabb<double> box_around(std::span<const Vec3d> points) {
  Aabb<double> box;
  for (const Vec3d& point : points) box.include(point);
  return box;
}

/// Touching boxes overlap. An empty box, or one with NaN, overlaps nothing.
template <class S> bool overlaps(const Aabb<S>& a, const Aabb<S>& b) {
  // No short circuits: which comparison fails is random, so branches would be mispredicted.
  return (a.lower.x() <= b.upper.x()) & (b.lower.x() <= a.upper.x()) &
         (a.lower.y() <= b.upper.y()) & (b.lower.y() <= a.upper.y()) &
         (a.lower.z() <= b.upper.z()) & (b.lower.z() <= a.upper.z());
}

/// overlaps() for one box against many. A float box is read as two overlapping packs of four
/// numbers; the fourth lane is compared with infinity and always passes.
template <class S> class OverlapsWith {
 public:
  explicit OverlapsWith(const Aabb<S>& box) : box_(box) {
    if constexpr (kPacked) {
      constexpr S kAny = std::numeric_limits<S>::infinity();
      upper_ = lanes::Pack<S>{box.upper.x(), box.upper.y(), box.upper.z(), kAny};
      lower_ = lanes::Pack<S>{-kAny, box.lower.x(), box.lower.y(), box.lower.z()};
    }
  }

  bool operator()(const Aabb<S>& other) const {
    if constexpr (kPacked) {
      static_assert(sizeof other == 6 * sizeof(S));
      const S* const numbers = other.lower.data();
      const auto meet =
          (lanes::load<S>(numbers) <= upper_) & (lanes::load<S>(numbers + 2) >= lower_);
      return lanes::bits<S>(meet) == 0xf;
    } else {
      return overlaps(other, box_);
    }
  }

 private:
  static constexpr bool kPacked = lanes::kWidth<S> == 4;

  Aabb<S> box_;
  lanes::Pack<S> lower_, upper_;
};

/// Whether holds(i) for any i below `count` with hit(i), tried in order. Many boxes are tested before
/// the first `holds`: which ones are hit is random, and branches on it would be mispredicted.
/// `hit` answers for `kAtOnce` boxes from i on, with a bit each; none beyond `count` may be hit.
template <int kAtOnce = 1, class Hit, class Holds>
bool any_hit(int count, const Hit& hit, const Holds& holds) {
  constexpr int kMany = 64;
  for (int begin = 0; begin < count; begin += kMany) {
    const int end = std::min(count, begin + kMany);
    std::uint64_t hits = 0;
    for (int i = begin; i < end; i += kAtOnce) hits |= std::uint64_t{hit(i)} << (i - begin);
    for (; hits != 0; hits &= hits - 1)
      if (holds(begin + std::countr_zero(hits))) return true;
  }
  return false;
}

template <class S> Aabb<S> merged(Aabb<S> a, const Aabb<S>& b) {
  a.include(b);
  return a;
}

/// Total area of the six sides, square metres; 0 for an empty box.
template <class S> S surface_area(const Aabb<S>& box) {
  if (box.empty()) return S(0);
  const Vec3<S> e = box.extent();
  return S(2) * (e.x() * e.y() + e.y() * e.z() + e.z() * e.x());
}

}  // namespace contactscope
