#pragma once

#include "core/convex_polygon.h"
#include "core/pack.h"
#include "reduce/steps.h"

namespace contactscope {

/// Packs as wide as the build allows; the rest of namespace lanes works on them, too.
namespace widest {

template <class S>
using Pack = lanes::Widest<S>;
template <class S>
using Flags = decltype(Pack<S>{} < Pack<S>{});
template <class S>
Pack<S> load(const S* from) {
  return lanes::load_pack<Pack<S>>(from);
}
template <class S, class Value>
Pack<S> each(const Value& value) {
  return lanes::pack_of<Pack<S>>([&value](int lane) -> S { return value(lane); });
}
template <class S>
Pack<S> all(S value) {
  return each<S>([value](int) { return value; });
}

}  // namespace widest

/// Contact points seen along the normal: the corners of their convex hull, one array per
/// coordinate. The arrays repeat at least twice, so that loops need not wrap: corner i + count is
/// corner i again, also in the lanes after the last corner.
template <class S>
class Patch {
  // The plane.
  Vec3<S> origin_;
  Vec3<S> u_, v_;
  S up_;        // 1, or -1 if v_ is reversed
  S rounding_;  // of a coordinate, metres

  static constexpr int kRoom = static_cast<int>(2 * kMaxManifoldPoints) + 2 * lanes::kWidest<S>;

 public:
  static constexpr int kLanes = lanes::kWidest<S>;

  /// At least one point and at most kMaxManifoldPoints. Points off a common plane are projected
  /// along the normal.
  explicit Patch(const Candidates<S>& points);

  Vec2<S> corner(int i) const { return {xs[i], ys[i]}; }
  /// A contact point in the coordinates of the corners.
  Vec2<S> project(const Vec3<S>& position) const;
  /// A distance within rounding is zero.
  bool coincide(const Vec2<S>& a, const Vec2<S>& b) const {
    return (b - a).squaredNorm() <= rounding_ * rounding_;
  }
  /// Whether counter-clockwise corners are clockwise seen against the normal.
  bool is_mirrored() const { return up_ < S(0); }

  int count;             // number of corners
  bool is_flat = false;  // all points are on a line or coincide: the area is only rounding
  S doubled_area;        // of the whole hull
  S tie;                 // doubled areas, and squared lengths, that differ by no more are ties
  // Not initialised: only two rounds and the lanes after them are used.
  int point[kMaxManifoldPoints];     // contact point at each corner
  S separation[kMaxManifoldPoints];  // of that point
  // Metres, relative to the first point. Counter-clockwise in these coordinates.
  alignas(sizeof(widest::Pack<S>)) S xs[kRoom];
  alignas(sizeof(widest::Pack<S>)) S ys[kRoom];

 private:
  /// Reads and projects the points.
  void project_all(ContactPoints<S> points);
  /// Repeats the corners.
  void repeat();
  void make_convex();
  /// Computes area and lengths. Returns false if the corners are not in convex order.
  bool measure();
};

extern template class Patch<float>;
extern template class Patch<double>;

}  // namespace contactscope
