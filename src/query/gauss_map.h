#pragma once

#include "geometry/hull.h"

namespace contactscope {

/// Finds the edges of B that make a face of the Minkowski difference A - B with one edge of A.
/// Source: Gregorius, "The Separating Axis Test between Convex Polyhedra", GDC 2013.
///
/// On the Gauss map (the unit sphere of normals) an edge of A is the arc between the normals a1 and
/// a2 of its two faces. B is subtracted, so an edge of B is the arc between -b1 and -b2. These arcs
/// divide the sphere into the directions in which each vertex of B is its deepest.
///
///           -b1
///      v     |     u
///     a1 .---x----. a2     the arcs cross at x, so the two edges make a face with normal x
///            |
///           -b2
///
/// The talk tests every edge of B against the arc (IsMinkowskiFace). We walk along the arc instead,
/// from the region of `start`, B's support vertex for a1, to that of `end`, the one for a2. This
/// visits only the edges that the arc crosses: a few per edge of A, for any size of B.
///
/// Steps: n(t) = (1 - t) a1 + t a2 runs along the arc. Leave the region of v towards the neighbour
/// u for which n(t) . (u - v) first turns negative, at t = f1 / (f1 - f2) with f1 = a1 . (u - v)
/// and f2 = a2 . (u - v) < 0. Only a sign and a ratio matter, so edges can have any length.
///
/// Each step moves to a vertex of B that is deeper along a2, so the walk ends; the limit on its
/// length covers ties that rounding turns into a cycle. An arc that only touches another is no
/// crossing, or one at a face normal, which the face queries measure. Calls visit(half_edge of B,
/// from v to u). `a1` and `a2` are in B's own frame.
template <class S, class Visit>
void walk_arc(const Hull<S>& b, const Vec3<S>& a1, const Vec3<S>& a2, int start, int end,
              const Visit& visit) {
  constexpr S kTie = S(16) * std::numeric_limits<S>::epsilon();
  int vertex = start;
  S reached = 0;  // t
  for (int step = 0; step < 2 * b.vertex_count() && vertex != end; ++step) {
    int leaving = -1, deeper = -1;
    S leaving_t = S(2);
    for (const int edge : b.around_vertex(vertex)) {
      const Vec3<S> along = b.target(edge) - b.origin(edge);
      const S f1 = a1.dot(along), f2 = a2.dot(along);
      if (f2 < S(0)) {
        const S t = f1 > S(0) ? f1 / (f1 - f2) : S(0);
        if (t < leaving_t) {
          leaving_t = t;
          leaving = edge;
        }
      } else if (f1 + (reached + kTie) * (f2 - f1) < S(0)) {
        deeper = edge;
      }
    }
    if (deeper >= 0) [[unlikely]] {
      leaving = deeper;
    } else if (leaving < 0) {
      return;  // as deep as `end`
    } else if (leaving_t > S(0) && leaving_t >= reached - kTie) {
      visit(leaving);
      reached = std::max(reached, leaving_t);
    }
    vertex = at(b.half_edges, Hull<S>::twin(leaving)).origin;
  }
}

}  // namespace contactscope
