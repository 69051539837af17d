#include "query/triangle_overlap.h"

#include "core/static_vector.h"
#include "geometry/predicates.h"

namespace contactscope {
namespace {

using enum TriangleOverlapKind;
using FlatTriangle = Triangle<double>;

/// The edge from corner k to the next one.
struct TriangleEdge {
  const Vec3d& from;
  const Vec3d& to;
};
TriangleEdge edge_of(const FlatTriangle& t, int k) { return {at(t, k), at(t, (k + 1) % 3)}; }

/// The axis of a triangle's largest projected area, and its sign; 0 if it has no area.
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
  TriangleOverlapKind kind = Coplanar;
  for (int k = 0; k < 3; ++k) {
    int innermost = -1;
    for (const Vec3d& corner : other) {
      const TriangleEdge edge = edge_of(t, k);
      const int side = orient2d(edge.from, edge.to, corner, projection.axis) * projection.sign;
      innermost = std::max(innermost, side);
      if (side > 0) break;
    }
    if (innermost < 0) return None;
    if (innermost == 0) kind = Touching;
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

/// Intersection of the edge from p to q with a plane or line, at signed distances `of_p` and `of_q`
/// in any unit, of opposite signs or one zero. On the edge, and the same if the ends are swapped.
Vec3d crossing_point(const Vec3d& p, double of_p, const Vec3d& q, double of_q) {
  if (of_p == 0) return p;
  if (of_q == 0) return q;
  // From the lexicographically smaller end, so that all triangles at an edge get the same point.
  const bool swapped = std::lexicographical_compare(q.begin(), q.end(), p.begin(), p.end());
  const Vec3d& from = swapped ? q : p;
  const Vec3d& to = swapped ? p : q;
  const double of_from = swapped ? of_q : of_p, of_to = swapped ? of_p : of_q;
  const double share = of_from / (of_from - of_to);
  const Vec3d point = from + share * (to - from);
  // Rounding must not leave the box of the edge.
  return point.cwiseMax(from.cwiseMin(to)).cwiseMin(from.cwiseMax(to));
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

/// The rare cases of triangle_overlap: one triangle is in the other's plane, or has no area. Steps:
///   1. both have an area: project along the axis of largest area. No edge has the whole other
///      triangle on its outer side or on itself: Coplanar. An edge has it strictly on its outer
///      side: None. Otherwise Touching, at corners of the two;
///   2. else: collect corners inside the other triangle, crossings of edges, and edges that pierce
///      the other. The two points with the largest distance are the ends.
/// `segment` is only set if `wants_segment`.
TriangleOverlap<double> flat_triangle_overlap(const Triangle<double>& a, const Triangle<double>& b,
                                              bool wants_segment) {
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

/// Corners in double; the conversion is exact.
const Triangle<double>& widened(const Triangle<double>& t) { return t; }
Triangle<double> widened(const Triangle<float>& t) {
  return {t[0].cast<double>(), t[1].cast<double>(), t[2].cast<double>()};
}

/// Position of a triangle relative to a plane, by the signs of its corners.
enum class Side : std::uint8_t {
  Separation,  // all strictly on one side
  Leaning,     // on one side, with a corner or an edge in the plane
  Across,      // on both sides
  Within,      // all in the plane
};
struct Lie {
  Side side;
  std::uint8_t lone;  // the corner shared by the two edges that reach the plane
  bool lone_above;    // above the plane; a corner in the plane counts to the side without others
};

constexpr int code_of(int a, int b, int c) { return 9 * a + 3 * b + c + 13; }

constexpr Lie lie_of(int a, int b, int c) {
  const std::array<int, 3> signs{a, b, c};
  int above = 0, below = 0;
  for (const int sign : signs) {
    above += sign > 0;
    below += sign < 0;
  }
  if (above + below == 0) return {Side::Within, 0, false};
  if (above == 3 || below == 3) return {Side::Separation, 0, false};
  const Side side = above > 0 && below > 0 ? Side::Across : Side::Leaning;
  // One corner above and the others not, or the opposite.
  const bool lone_above = above == 1 || (above == 0 && below == 2);
  const bool lone_in_plane = side == Side::Leaning && above + below == 2;
  const int lone_sign = lone_in_plane ? 0 : lone_above ? 1 : -1;
  std::uint8_t lone = 0;
  while (signs[lone] != lone_sign) ++lone;
  return {side, lone, lone_above};
}

constexpr std::array<Lie, 27> make_lies() {
  std::array<Lie, 27> lies{};
  for (int a = -1; a <= 1; ++a)
    for (int b = -1; b <= 1; ++b)
      for (int c = -1; c <= 1; ++c)
        lies[static_cast<std::size_t>(code_of(a, b, c))] = lie_of(a, b, c);
  return lies;
}
constexpr std::array<Lie, 27> kLies = make_lies();

/// Position of `t` relative to the plane of `of`.
Lie lie(const Triangle<double>& t, const Triangle<double>& of) {
  const predicates::Plane plane(of[0], of[1], of[2]);
  std::array<int, 3> signs;
  bool certain = true;
  for (std::size_t k = 0; k < 3; ++k) {
    const predicates::Filtered filtered = plane.filtered(t[k]);
    signs[k] = (filtered.value > filtered.error) - (filtered.value < -filtered.error);
    certain &= signs[k] != 0;
  }
  if (!certain)
    for (std::size_t k = 0; k < 3; ++k)
      if (signs[k] == 0)
        signs[k] = predicates::sign_of(predicates::exact_orient3d(of[0], of[1], of[2], t[k]));
  return kLies[static_cast<std::size_t>(code_of(signs[0], signs[1], signs[2]))];
}

/// A triangle relative to its lone corner.
///
///            p           The line of both planes crosses the edges from p to q
///           / |          and from p to r. If p is above the other plane, and the
///     -----x---x-----    other triangle is turned so that its own p is above this
///         /     |        one, pq of a comes before pr, and pr of b before pq.
///        q-------r
struct Fan {
  const Vec3d* p;
  const Vec3d* q;
  const Vec3d* r;

  Fan(const Triangle<double>& t, int lone, bool turned)
      : p(&t[static_cast<std::size_t>(lone)]),
        q(&t[static_cast<std::size_t>(turned ? (lone + 2) % 3 : (lone + 1) % 3)]),
        r(&t[static_cast<std::size_t>(turned ? (lone + 1) % 3 : (lone + 2) % 3)]) {}
};

/// The order along the line of the ends of the edges from a.p and b.p: 1, -1, or 0.
int order(const Vec3d& p_a, const Vec3d& to_a, const Vec3d& p_b, const Vec3d& to_b) {
  return orient3d(p_a, to_a, p_b, to_b);
}

/// Intersection of the edge from p to `to` with the plane of `of`.
Vec3d end_at(const Vec3d& p, const Vec3d& to, const Triangle<double>& of) {
  return crossing_point(p, orient3d_value(of[0], of[1], of[2], p), to,
                        orient3d_value(of[0], of[1], of[2], to));
}

template <bool kWantsSegment>
TriangleOverlap<double> overlap(const Triangle<double>& a, const Triangle<double>& b) {
  const Lie of_b = lie(b, a);
  if (of_b.side == Side::Separation) return {};
  const Lie of_a = lie(a, b);
  if (of_a.side == Side::Separation) return {};
  if (of_a.side == Side::Within || of_b.side == Side::Within)
    return flat_triangle_overlap(a, b, kWantsSegment);
  const Fan fan_a(a, of_a.lone, !of_b.lone_above), fan_b(b, of_b.lone, !of_a.lone_above);
  const int first = order(*fan_a.p, *fan_a.q, *fan_b.p, *fan_b.q);
  if (first > 0) return {};
  const int last = order(*fan_a.p, *fan_a.r, *fan_b.p, *fan_b.r);
  if (last < 0) return {};
  TriangleOverlap<double> result;
  const bool both_across = of_a.side == Side::Across && of_b.side == Side::Across;
  result.kind = both_across && first < 0 && last > 0 ? Proper : Touching;
  if constexpr (kWantsSegment) {
    const bool begins_on_b = order(*fan_a.p, *fan_a.q, *fan_b.p, *fan_b.r) < 0;
    const bool ends_on_b = order(*fan_a.p, *fan_a.r, *fan_b.p, *fan_b.q) > 0;
    result.segment = {begins_on_b ? end_at(*fan_b.p, *fan_b.r, a) : end_at(*fan_a.p, *fan_a.q, b),
                      ends_on_b ? end_at(*fan_b.p, *fan_b.q, a) : end_at(*fan_a.p, *fan_a.r, b)};
  }
  return result;
}

}  // namespace

template <class S> TriangleOverlap<S> triangle_overlap(const Triangle<S>& a, const Triangle<S>& b) {
  const TriangleOverlap<double> exact = overlap<true>(widened(a), widened(b));
  return {exact.kind,
          exact.a_degenerate,
          exact.b_degenerate,
          {exact.segment[0].template cast<S>(), exact.segment[1].template cast<S>()}};
}

template <class S>
TriangleOverlapKind triangle_overlap_kind(const Triangle<S>& a, const Triangle<S>& b) {
  return overlap<false>(widened(a), widened(b)).kind;
}

template <class S> bool is_degenerate(const Triangle<S>& triangle) {
  const Triangle<double>& t = widened(triangle);
  return on_one_line(t[0], t[1], t[2]);
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(triangle_overlap, triangle_overlap_kind, is_degenerate);

}  // namespace contactscope
