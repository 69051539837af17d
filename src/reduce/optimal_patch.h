#pragma once

#include "core/pack.h"
#include "reduce/reducer.h"

namespace contactscope {

/// Packs as wide as the build allows; the rest of namespace lanes works on them too.
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

template <class S>
struct PlanePoint {
  S x, y;

  PlanePoint operator-(const PlanePoint& other) const { return {x - other.x, y - other.y}; }
};

/// Doubled signed area of the triangle 0, a, b.
template <class S>
S cross(const PlanePoint<S>& a, const PlanePoint<S>& b) {
  return a.x * b.y - a.y * b.x;
}

template <class S>
S squared_distance(const PlanePoint<S>& a, const PlanePoint<S>& b) {
  const PlanePoint<S> d = b - a;
  return d.x * d.x + d.y * d.y;
}

/// Contact points seen along the normal: the corners of their convex hull, each coordinate in an
/// array of its own. It goes round twice and more, so that nothing that goes round has to wrap:
/// corner i + count is corner i again, also in the lanes after the last corner.
template <class S>
class Patch {
 public:
  /// At most kMaxManifoldPoints points, at least one; finite, `normal` a unit vector. Points off a
  /// common plane are laid into it along the normal.
  Patch(ContactPoints<S> points, const Vec3<S>& normal);

  static constexpr int kLanes = lanes::kWidest<S>;

  int count() const { return count_; }
  /// Metres, relative to the first point. Counter-clockwise in these coordinates.
  PlanePoint<S> corner(int i) const { return {x_[i], y_[i]}; }
  const S* x() const { return x_; }
  const S* y() const { return y_; }
  /// The contact point at corner i < count().
  int point(int i) const { return point_[i]; }
  /// Of that point.
  S separation(int i) const { return separation_[i]; }
  /// A contact point in the coordinates of the corners.
  PlanePoint<S> project(const Vec3<S>& position) const;

  /// Of the whole hull.
  S doubled_area() const { return doubled_area_; }
  /// All points are on a line, or coincide: the area is nothing but rounding.
  bool is_flat() const { return is_flat_; }
  /// A distance within rounding is none.
  bool coincide(const PlanePoint<S>& a, const PlanePoint<S>& b) const {
    return squared_distance(a, b) <= rounding_ * rounding_;
  }

  /// Whether counter-clockwise corners are clockwise seen against the normal.
  bool is_mirrored() const { return up_ < S(0); }
  /// Lets corner i stand for another contact point at the same place.
  void rename(int i, int point, S separation) {
    point_[i] = point;
    separation_[i] = separation;
  }

 private:
  static constexpr int kRoom = static_cast<int>(2 * kMaxManifoldPoints) + 2 * kLanes;

  /// Reads and projects the points.
  void project_all(ContactPoints<S> points);
  /// Lets the corners go round again.
  void repeat();
  void make_convex();
  /// Area and lengths. False when the corners are not in convex order.
  bool measure();

  Vec3<S> origin_;
  Vec3<S> u_, v_;
  S up_;  // 1, or -1 when v_ is turned about
  int count_;
  bool is_flat_ = false;
  S doubled_area_;
  S rounding_;  // of a coordinate, metres
  // Not initialised: only two rounds and the lanes after them are used.
  int point_[kMaxManifoldPoints];
  S separation_[kMaxManifoldPoints];
  alignas(sizeof(widest::Pack<S>)) S x_[kRoom];
  alignas(sizeof(widest::Pack<S>)) S y_[kRoom];
};

extern template class Patch<float>;
extern template class Patch<double>;

}  // namespace contactscope
