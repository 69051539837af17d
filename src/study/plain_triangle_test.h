#pragma once

#include <algorithm>
#include <cstddef>

#include "query/triangle_overlap.h"

namespace contactscope {

/// Textbook baseline for the exact test: every edge of each triangle against the other, by signs of
/// volumes in plain floating point. Volumes up to `epsilon`, metres, times an area count as zero;
/// with 0 it trusts the signs.
template <class S>
class PlainTriangleTest {
 public:
  explicit PlainTriangleTest(S epsilon) : epsilon_(epsilon) {}

  bool overlap(const Triangle<S>& a, const Triangle<S>& b) const {
    for (std::size_t k = 0; k < 3; ++k)
      if (meets(a[k], a[(k + 1) % 3], b) != None || meets(b[k], b[(k + 1) % 3], a) != None)
        return true;
    return false;
  }

  /// Proper if an edge crosses the other's interior, Touching if they share a point otherwise; does
  /// not detect coplanar triangles.
  TriangleOverlapKind kind(const Triangle<S>& a, const Triangle<S>& b) const {
    TriangleOverlapKind found = None;
    for (std::size_t k = 0; k < 3; ++k)
      found = std::max({found, meets(a[k], a[(k + 1) % 3], b), meets(b[k], b[(k + 1) % 3], a)});
    return found;
  }

 private:
  static constexpr TriangleOverlapKind None = TriangleOverlapKind::None;

  int sign(S value, S scale) const {
    return (value > epsilon_ * scale) - (value < -epsilon_ * scale);
  }
  TriangleOverlapKind meets(const Vec3<S>& p, const Vec3<S>& q, const Triangle<S>& t) const {
    const Vec3<S> normal = (t[1] - t[0]).cross(t[2] - t[0]);
    const S length = normal.norm();
    const int p_side = sign(normal.dot(p - t[0]), length);
    const int q_side = sign(normal.dot(q - t[0]), length);
    if (p_side * q_side > 0) return None;
    if (p_side == 0 && q_side == 0)
      return meets_in_plane(p, q, t, normal) ? TriangleOverlapKind::Touching : None;
    int least = 1, most = -1;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3<S> across = (q - p).cross(t[k] - p);
      const int side = sign(across.dot(t[(k + 1) % 3] - p), across.norm());
      least = std::min(least, side);
      most = std::max(most, side);
    }
    if (least < 0 && most > 0) return None;
    const bool through = p_side * q_side < 0 && (least > 0 || most < 0);
    return through ? TriangleOverlapKind::Proper : TriangleOverlapKind::Touching;
  }
  bool meets_in_plane(const Vec3<S>& p, const Vec3<S>& q, const Triangle<S>& t,
                      const Vec3<S>& normal) const {
    const auto side = [&](const Vec3<S>& from, const Vec3<S>& to, const Vec3<S>& of) {
      return sign(normal.dot((to - from).cross(of - from)), normal.norm() * (to - from).norm());
    };
    bool inside = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3<S>&from = t[k], &to = t[(k + 1) % 3];
      if (side(p, q, from) * side(p, q, to) <= 0 && side(from, to, p) * side(from, to, q) <= 0)
        return true;
      inside = inside && side(from, to, p) >= 0;
    }
    return inside;
  }

  S epsilon_;
};

}  // namespace contactscope
