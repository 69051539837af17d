#include "query/triangle_overlap.h"

#include <type_traits>
#include <utility>

#include "geometry/predicates.h"
#include "query/flat_triangles.h"

namespace contactscope {
namespace {

using enum TriangleOverlapKind;

/// Corners in double; the conversion is exact.
const Triangle<double>& widened(const Triangle<double>& t) {
  return t;
}
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

constexpr int code_of(int a, int b, int c) {
  return 9 * a + 3 * b + c + 13;
}

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
  if (!certain) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (signs[k] == 0)
        signs[k] = predicates::sign_of(predicates::exact_orient3d(of[0], of[1], of[2], t[k]));
    }
  }
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

/// 1 if the end of the edge from a.p comes after that of the edge from b.p along the line, -1 if
/// before, 0 if they coincide.
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

template <class S>
TriangleOverlap<S> triangle_overlap(const Triangle<S>& a, const Triangle<S>& b) {
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

template <class S>
bool is_degenerate(const Triangle<S>& triangle) {
  const Triangle<double>& t = widened(triangle);
  return orient2d(t[0], t[1], t[2], 0) == 0 && orient2d(t[0], t[1], t[2], 1) == 0 &&
         orient2d(t[0], t[1], t[2], 2) == 0;
}

template TriangleOverlap<float> triangle_overlap(const Triangle<float>&, const Triangle<float>&);
template TriangleOverlap<double> triangle_overlap(const Triangle<double>&, const Triangle<double>&);
template TriangleOverlapKind triangle_overlap_kind(const Triangle<float>&, const Triangle<float>&);
template TriangleOverlapKind triangle_overlap_kind(const Triangle<double>&,
                                                   const Triangle<double>&);
template bool is_degenerate(const Triangle<float>&);
template bool is_degenerate(const Triangle<double>&);

}  // namespace contactscope
