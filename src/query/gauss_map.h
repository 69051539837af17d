#pragma once

namespace contactscope {

/// Whether an edge of A and an edge of B make a face of the Minkowski difference A - B, so that
/// their cross product is worth measuring. Source: Gregorius, "The Separating Axis Test between
/// Convex Polyhedra", GDC 2013, IsMinkowskiFace.
///
/// On the Gauss map (the unit sphere of normals) an edge of A is the arc between the normals a1 and
/// a2 of its two faces, an edge of B the arc between -b1 and -b2: negated, since B is subtracted.
///
///           -b1
///            |
///     a1 .---x----. a2     the arcs cross at x, so the two edges make a face with normal x
///            |
///           -b2
///
/// Arc a1 a2 lies in the plane at right angles to A's edge. The arcs cross when -b1 and -b2 lie on
/// two sides of that plane, a1 and a2 on two sides of the other, and both in one hemisphere. Where
/// the talk takes triple products of normals, we take the edges themselves, which are parallel to
/// a1 x a2 and b1 x b2, and so have four dot products and no cross product, division or root.
///
/// `b1_along_a` is b1 . edge A, and so on; edges run with their first face on the left, so that
/// edge A is along a1 x a2. An arc that only touches the other is no crossing: its normal is a face
/// normal, which the face queries measure.
template <class S>
constexpr bool sides_differ(S first, S second) {
  return first * second < S(0);
}

template <class S>
constexpr bool same_hemisphere(S b1_along_a, S a1_along_b) {
  return b1_along_a * a1_along_b > S(0);
}

template <class S>
constexpr bool is_minkowski_face(S b1_along_a, S b2_along_a, S a1_along_b, S a2_along_b) {
  return sides_differ(b1_along_a, b2_along_a) && sides_differ(a1_along_b, a2_along_b) &&
         same_hemisphere(b1_along_a, a1_along_b);
}

}  // namespace contactscope
