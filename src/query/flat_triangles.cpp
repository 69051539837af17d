#include "query/flat_triangles.h"

#include <algorithm>

#include "core/at.h"
#include "core/static_vector.h"
#include "geometry/predicates.h"

namespace contactscope {
namespace {

using FlatTriangle = Triangle<double>;

/// The edge from corner k to the next one.
struct TriangleEdge {
  const Vec3d& from;
  const Vec3d& to;
};
TriangleEdge edge_of(const FlatTriangle& t, int k) {
  return {at(t, k), at(t, (k + 1) % 3)};
}

/// The axis of the largest projected area of a triangle, and the sign of that area; sign 0 if the
/// triangle has no area.
struct Projection {
  int axis;
  int sign;
};
Projection projection_of(const FlatTriangle& t) {
  const Vec3d normal = predicates::Plane(t[0], t[1], t[2]).normal;
  int axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  for (int tried = 0; tried < 3; ++tried, axis = (axis + 1) % 3) {
    const int sign = orient2d(t[0], t[1], t[2], axis);
    if (sign != 0) return {axis, sign};
  }
  return {0, 0};
}

/// The kind of overlap as far as the edges of `t` decide it, in a projection.
TriangleOverlapKind kind_by_edges(const FlatTriangle& t, const Projection& projection,
                                  const FlatTriangle& other) {
  TriangleOverlapKind kind = TriangleOverlapKind::Coplanar;
  for (int k = 0; k < 3; ++k) {
    int innermost = -1;
    for (const Vec3d& corner : other) {
      const TriangleEdge edge = edge_of(t, k);
      const int side = orient2d(edge.from, edge.to, corner, projection.axis) * projection.sign;
      innermost = std::max(innermost, side);
      if (side > 0) break;
    }
    if (innermost < 0) return TriangleOverlapKind::None;
    if (innermost == 0) kind = TriangleOverlapKind::Touching;
  }
  return kind;
}

bool on_one_line(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  return orient2d(a, b, c, 0) == 0 && orient2d(a, b, c, 1) == 0 && orient2d(a, b, c, 2) == 0;
}

/// True if a point is in a closed triangle, with an area (sign != 0) or without one.
bool contains(const FlatTriangle& t, const Projection& projection, const Vec3d& point) {
  if (projection.sign != 0) {
    if (orient3d(t[0], t[1], t[2], point) != 0) return false;
    for (int k = 0; k < 3; ++k) {
      const TriangleEdge edge = edge_of(t, k);
      if (orient2d(edge.from, edge.to, point, projection.axis) * projection.sign < 0) return false;
    }
    return true;
  }
  // On the line of the three corners, or equal to them: the box decides.
  for (int axis = 0; axis < 3; ++axis) {
    const auto [least, most] = std::minmax({t[0][axis], t[1][axis], t[2][axis]});
    if (!(least <= point[axis] && point[axis] <= most)) return false;
  }
  return on_one_line(t[0], t[1], point) && on_one_line(t[1], t[2], point) &&
         on_one_line(t[2], t[0], point);
}

/// Common points of two triangles; their hull is the intersection. At most six corners of one in
/// the other, nine crossings of edges, and three edges of each through the other.
class SharedPoints {
 public:
  void add(const Vec3d& point) { points_.push_back(point); }
  bool empty() const { return points_.empty(); }

  void add_corners(const FlatTriangle& of, const FlatTriangle& in, const Projection& projection) {
    for (const Vec3d& corner : of)
      if (contains(in, projection, corner)) add(corner);
  }

  /// Adds edges that cross between their ends. add_corners finds corners on edges.
  void add_crossing(const TriangleEdge& a, const TriangleEdge& b) {
    if (orient3d(a.from, a.to, b.from, b.to) != 0) return;
    for (int axis = 0; axis < 3; ++axis) {
      const int from = orient2d(a.from, a.to, b.from, axis);
      const int to = orient2d(a.from, a.to, b.to, axis);
      if (from == 0 && to == 0) continue;  // the plane of both edges may be seen edge-on
      if (from * to >= 0) return;
      const double of_from = predicates::exact_orient2d(b.from, b.to, a.from, axis);
      const double of_to = predicates::exact_orient2d(b.from, b.to, a.to, axis);
      if (predicates::sign_of(of_from) * predicates::sign_of(of_to) < 0)
        add(crossing_point(a.from, of_from, a.to, of_to));
      return;
    }
  }

  /// Adds an edge with its ends strictly on both sides of a triangle that has an area.
  void add_piercing(const TriangleEdge& edge, const FlatTriangle& t) {
    const double of_from = predicates::exact_orient3d(t[0], t[1], t[2], edge.from);
    const double of_to = predicates::exact_orient3d(t[0], t[1], t[2], edge.to);
    if (predicates::sign_of(of_from) * predicates::sign_of(of_to) >= 0) return;
    int least = 1, most = -1;
    for (int k = 0; k < 3; ++k) {
      const TriangleEdge side = edge_of(t, k);
      const int sign = orient3d(edge.from, edge.to, side.from, side.to);
      least = std::min(least, sign);
      most = std::max(most, sign);
    }
    if (least < 0 && most > 0) return;
    add(crossing_point(edge.from, of_from, edge.to, of_to));
  }

  /// The two points with the largest distance. All are on one line, up to rounding.
  std::array<Vec3d, 2> ends() const {
    std::array<Vec3d, 2> farthest{points_[0], points_[0]};
    double largest = 0;
    for (int i = 0; i < count_of(points_); ++i) {
      for (int j = 0; j < i; ++j) {
        const double distance = (at(points_, i) - at(points_, j)).lpNorm<1>();
        if (distance <= largest) continue;
        largest = distance;
        farthest = {at(points_, j), at(points_, i)};
      }
    }
    return farthest;
  }

 private:
  StaticVector<Vec3d, 6 + 9 + 6> points_;
};

}  // namespace

Vec3d crossing_point(const Vec3d& p, double of_p, const Vec3d& q, double of_q) {
  if (of_p == 0) return p;
  if (of_q == 0) return q;
  // Always from the lexicographically smaller end, so that all triangles at an edge get the same
  // point.
  const bool swapped = std::lexicographical_compare(q.begin(), q.end(), p.begin(), p.end());
  const Vec3d& from = swapped ? q : p;
  const Vec3d& to = swapped ? p : q;
  const double of_from = swapped ? of_q : of_p, of_to = swapped ? of_p : of_q;
  const double share = of_from / (of_from - of_to);
  const Vec3d point = from + share * (to - from);
  // Rounding must not leave the box of the edge.
  return point.cwiseMax(from.cwiseMin(to)).cwiseMin(from.cwiseMax(to));
}

TriangleOverlap<double> flat_triangle_overlap(const Triangle<double>& a, const Triangle<double>& b,
                                              bool wants_segment) {
  using enum TriangleOverlapKind;
  const Projection seen_a = projection_of(a), seen_b = projection_of(b);
  TriangleOverlap<double> result;
  const bool a_degenerate = seen_a.sign == 0, b_degenerate = seen_b.sign == 0;
  SharedPoints shared;
  if (!a_degenerate && !b_degenerate) {
    // One plane: the same axis works for b.
    const Projection of_b{seen_a.axis, orient2d(b[0], b[1], b[2], seen_a.axis)};
    const TriangleOverlapKind by_a = kind_by_edges(a, seen_a, b);
    const TriangleOverlapKind by_b = by_a == None ? None : kind_by_edges(b, of_b, a);
    if (by_b == None) return result;
    result.kind = by_a == Touching ? Touching : by_b;
    if (result.kind == Coplanar || !wants_segment) return result;
    shared.add_corners(a, b, seen_b);
    shared.add_corners(b, a, seen_a);
  } else {
    shared.add_corners(a, b, seen_b);
    shared.add_corners(b, a, seen_a);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) shared.add_crossing(edge_of(a, i), edge_of(b, j));
      if (!b_degenerate) shared.add_piercing(edge_of(a, i), b);
      if (!a_degenerate) shared.add_piercing(edge_of(b, i), a);
    }
    if (shared.empty()) return result;
    result = {Touching, a_degenerate, b_degenerate};
  }
  result.segment = shared.ends();
  return result;
}

}  // namespace contactscope
