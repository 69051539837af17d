#pragma once

#include "core/convex_polygon.h"
#include "reduce/steps.h"

namespace contactscope {

/// Packs as wide as the build allows; the rest of namespace lanes works on them, too.
namespace widest {

template <class S> using Pack = lanes::Widest<S>;
template <class S> using Flags = decltype(Pack<S>{} < Pack<S>{});
template <class S> Pack<S> load(const S* from) { return lanes::load_pack<Pack<S>>(from); }
template <class S, class Value> Pack<S> each(const Value& value) {
  return lanes::pack_of<Pack<S>>([&value](int lane) -> S { return value(lane); });
}
template <class S> Pack<S> all(S value) {
  return each<S>([value](int) { return value; });
}

}  // namespace widest

/// Contact points seen along the normal: the corners of their convex hull, one array per
/// coordinate. The arrays repeat at least twice, so that loops need not wrap: corner i + count is
/// corner i again, also in the lanes after the last corner.
template <class S> class Patch {
  // The plane.
  Vec3<S> origin_;
  Vec3<S> u_, v_;
  S up_;        // 1, or -1 if v_ is reversed
  S rounding_;  // of a coordinate, metres

  static constexpr int kRoom = static_cast<int>(2 * kMaxManifoldPoints) + 2 * lanes::kWidest<S>;

 public:
  static constexpr int kLanes = lanes::kWidest<S>;

  /// One to kMaxManifoldPoints points. Those off a common plane are projected along the normal.
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

/// Corners of a patch, counter-clockwise in its coordinates, each below count().
template <class S> struct CornerRing {
  S doubled_area = S(0);
  StaticVector<int, kMaxManifoldPoints> corners;
};

/// Doubled area of the largest quadrilateral, exact up to rounding. Needs at least four corners.
template <class S> S area_of_best_quadrilateral(const Patch<S>& patch);

/// The largest quadrilateral with corner `through`; among equals the first in order from there.
template <class S> CornerRing<S> best_quadrilateral_through(const Patch<S>& patch, int through);

/// The two farthest corners; one if they coincide.
template <class S> CornerRing<S> farthest_pair(const Patch<S>& patch);

/// The ring of at most `most` >= 2 corners of a patch that keeps the most: the largest one, the two
/// extremes if most is 2 or the patch is flat, or one corner if all coincide. Among equals the one
/// with the first corner by its point's id, then the first in order from there.
template <class S>
CornerRing<S> largest_ring(const Candidates<S>& points, const Patch<S>& patch, int most);

/// The points of a ring, counter-clockwise seen against the normal, beginning with the deepest: the
/// earliest of those whose separations differ by at most `depth_tie`, metres.
template <class S>
KeptIndices points_of(const Patch<S>& patch, const CornerRing<S>& ring, S depth_tie);

/// Doubled area of the convex hull of a choice, or squared distance of its extremes.
template <class S> S measure(const Candidates<S>& points, const KeptIndices& kept, bool by_length);

/// The previous frame's points, in their order, if all exist, one has a separation of at most
/// `deep`, metres, and they are as large as `kept` up to rounding. Otherwise `kept`.
template <class S>
KeptIndices as_before_if_equal(const Candidates<S>& points, const Patch<S>& patch,
                               const KeptIndices& kept, S deep, const ReduceOptions& options);

/// A choice of points that contains a given point.
template <class S> struct ChoiceWith {
  S doubled_area;   // of the hull of all kept points; 0 for a line or a point
  bool is_in_ring;  // otherwise the given point is not a corner and is kept in addition
};

/// The choice of at most `most` >= 1 points that contains `point` and keeps the most, into `kept`
/// (empty before), `point` first. If another point at the same place is a corner of the patch,
/// `point` replaces it. `depth_tie` as in points_of().
template <class S>
ChoiceWith<S> largest_with(const Candidates<S>& points, Patch<S>& patch, int point, int most,
                           S depth_tie, KeptIndices& kept);

/// The doubled area of the triangle of `centre` and the edge from corner i to j. 0 if the edge is
/// seen from behind: the hull of ring and centre then lacks that edge.
template <class S> S seen(const Patch<S>& patch, const Vec2<S>& centre, int i, int j) {
  return std::max(S(0), cross(patch.corner(i) - centre, patch.corner(j) - centre));
}

}  // namespace contactscope
