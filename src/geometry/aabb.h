#pragma once

#include <algorithm>
#include <limits>
#include <span>

#include "core/pack.h"
#include "core/vec3.h"

namespace contactscope {

/// Axis-aligned bounding box, closed, metres. Made empty: lower = +infinity, upper = -infinity, so
/// that merging needs no special case.
template <class S>
struct Aabb {
  using Scalar = S;

  Vec3<S> lower = Vec3<S>::Constant(std::numeric_limits<S>::infinity());
  Vec3<S> upper = Vec3<S>::Constant(-std::numeric_limits<S>::infinity());

  /// No point is inside. True for a box with NaN too.
  bool empty() const {
    return !(lower.x() <= upper.x() && lower.y() <= upper.y() && lower.z() <= upper.z());
  }
  Vec3<S> center() const { return S(0.5) * lower + S(0.5) * upper; }
  Vec3<S> extent() const { return upper - lower; }

  /// Every point of `other` is inside, too.
  bool contains(const Aabb& other) const {
    return ((lower.array() <= other.lower.array()) && (other.upper.array() <= upper.array())).all();
  }

  /// Grows by a point or a box. Of 0.0 and -0.0 the one that was there stays, on every processor: the smaller of
  /// the two is another one to NEON than to SSE2, and traces are compared byte for byte.
  void include(const Vec3<S>& point) { include(Aabb{point, point}); }
  void include(const Aabb& other) {
    for (int k = 0; k < 3; ++k) {
      lower[k] = other.lower[k] < lower[k] ? other.lower[k] : lower[k];
      upper[k] = other.upper[k] > upper[k] ? other.upper[k] : upper[k];
    }
  }

  /// Each coordinate rounded to the nearest of the other scalar. Rounding is monotone: the result
  /// is exactly the box of the rounded points, if this is the box of the points.
  template <class T>
  Aabb<T> cast() const {
    return {lower.template cast<T>(), upper.template cast<T>()};
  }

  friend bool operator==(const Aabb&, const Aabb&) = default;
};

/// Smallest box around points.
inline Aabb<double> box_around(std::span<const Vec3d> points) {
  Aabb<double> box;
  for (const Vec3d& point : points) box.include(point);
  return box;
}

/// Boxes that touch overlap. An empty box, or one with NaN, overlaps nothing.
template <class S>
bool overlaps(const Aabb<S>& a, const Aabb<S>& b) {
  // Without short circuits: which of the six decides is a coin toss that a processor cannot learn.
  return (a.lower.x() <= b.upper.x()) & (b.lower.x() <= a.upper.x()) &
         (a.lower.y() <= b.upper.y()) & (b.lower.y() <= a.upper.y()) &
         (a.lower.z() <= b.upper.z()) & (b.lower.z() <= a.upper.z());
}

/// overlaps() with one box that is asked about many. A float's box is four numbers and four numbers, two
/// of which are twice there: the lower ends and one more, which infinity lets pass.
template <class S>
class OverlapsWith {
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

/// Smallest box around both.
template <class S>
Aabb<S> merged(Aabb<S> a, const Aabb<S>& b) {
  a.include(b);
  return a;
}

/// Square metres, all six sides; 0 for an empty box.
template <class S>
S surface_area(const Aabb<S>& box) {
  if (box.empty()) return S(0);
  const Vec3<S> e = box.extent();
  return S(2) * (e.x() * e.y() + e.y() * e.z() + e.z() * e.x());
}

}  // namespace contactscope
