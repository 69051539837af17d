#pragma once

#include "query/triangle_overlap.h"
#include "trace/study.h"

namespace contactscope {

__extension__ using Wide = __int128;

/// Textbook baseline for the exact test: every edge of each triangle against the other, by signs of
/// volumes. Volumes up to `epsilon`, metres, times an area count as zero; with 0 it trusts the
/// signs. Shares no code with the exact test.
///
/// In whole numbers (std::int64_t) it is exact while differences of coordinates are below 2^26: a
/// product of a normal and a cross product then fits into 128 bits.
template <class S> class PlainTriangleTest {
 public:
  explicit PlainTriangleTest(S epsilon = 0) : epsilon_(epsilon) {}

  bool overlap(const Triangle<S>& a, const Triangle<S>& b) const {
    for (std::size_t k = 0; k < 3; ++k)
      if (meets(a[k], a[(k + 1) % 3], b) != None || meets(b[k], b[(k + 1) % 3], a) != None)
        return true;
    return false;
  }

  /// Proper if an edge crosses the other's interior, else Touching; not for coplanar triangles.
  TriangleOverlapKind kind(const Triangle<S>& a, const Triangle<S>& b) const {
    TriangleOverlapKind found = None;
    for (std::size_t k = 0; k < 3; ++k)
      found = std::max({found, meets(a[k], a[(k + 1) % 3], b), meets(b[k], b[(k + 1) % 3], a)});
    return found;
  }

 private:
  static constexpr TriangleOverlapKind None = TriangleOverlapKind::None;

  static constexpr bool kIsWhole = std::is_integral_v<S>;

  static auto dot(const Vec3<S>& a, const Vec3<S>& b) {
    if constexpr (kIsWhole)
      return Wide(a[0]) * b[0] + Wide(a[1]) * b[1] + Wide(a[2]) * b[2];
    else
      return a.dot(b);
  }
  static S length(const Vec3<S>& v) {
    if constexpr (kIsWhole)
      return 0;  // no epsilon needs it
    else
      return v.norm();
  }
  template <class Value> int sign(Value value, S scale) const {
    return (value > epsilon_ * scale) - (value < -epsilon_ * scale);
  }
  TriangleOverlapKind meets(const Vec3<S>& p, const Vec3<S>& q, const Triangle<S>& t) const {
    const Vec3<S> normal = (t[1] - t[0]).cross(t[2] - t[0]);
    const int p_side = sign(dot(normal, p - t[0]), length(normal));
    const int q_side = sign(dot(normal, q - t[0]), length(normal));
    if (p_side * q_side > 0) return None;
    if (p_side == 0 && q_side == 0)
      return meets_in_plane(p, q, t, normal) ? TriangleOverlapKind::Touching : None;
    int least = 1, most = -1;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3<S> across = (q - p).cross(t[k] - p);
      const int side = sign(dot(across, t[(k + 1) % 3] - p), length(across));
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
      return sign(dot(normal, (to - from).cross(of - from)), length(normal) * length(to - from));
    };
    bool inside = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3<S>&from = t[k], &to = t[(k + 1) % 3];
      const int of_from = side(p, q, from), of_to = side(p, q, to), of_p = side(from, to, p);
      const bool collinear = kIsWhole && of_from == 0 && of_to == 0;
      if (of_from * of_to <= 0 && of_p * side(from, to, q) <= 0 &&
          (!collinear || boxes_meet(p, q, from, to)))
        return true;
      inside = inside && of_p >= 0;
    }
    return inside;
  }
  static bool boxes_meet(const Vec3<S>& p, const Vec3<S>& q, const Vec3<S>& r, const Vec3<S>& s) {
    return (r.cwiseMin(s).array() <= p.cwiseMax(q).array()).all() &&
           (p.cwiseMin(q).array() <= r.cwiseMax(s).array()).all();
  }

  S epsilon_;
};

/// Two triangles, the second with its first corner at (1/2 + i u, 1/2 + j u, 0) m, where u is the
/// spacing of the scalar's numbers from 1/2 on; -64 <= i, j <= 64. The first one lies in the plane
/// x - y + z = 0, and its corners use all digits of the scalar. For i = j that corner is well
/// inside it, and they touch. The other corners of the second one are on the side of larger x, so
/// the triangles are separated for i > j and cross for i < j. Every coordinate is exact.
template <class S> std::array<Triangle<S>, 2> nearly_touching(int i, int j);

/// A map of the answers of three tests for these: plain signs in float and in double, and the exact
/// test. After Kettner, Mehlhorn, Pion, Schirra and Yap 2008, "Classroom examples of robustness
/// problems in geometric computations"; their point on a line is a corner on a plane here.
trace::Study triangle_answers();

}  // namespace contactscope
