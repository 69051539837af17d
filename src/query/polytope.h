#pragma once

#include <array>

#include "core/at.h"
#include "core/static_vector.h"
#include "query/penetration_bounds.h"

namespace contactscope {

/// A tetrahedron of the difference that holds the origin within rounding, or what stands in its way.
template <class S>
struct StartSimplex {
  int count = 0;  // 4: a tetrahedron; less: the difference reaches nowhere out of these
  std::array<DifferencePoint<S>, 4> points;
  Vec3<S> outward = Vec3<S>::UnitX();  // of count < 4: unit, across the difference
};

/// A triangle of the polytope, seen from outside.
template <class S>
struct PolytopeFace {
  std::array<int, 3> vertices;    // counter-clockwise
  std::array<int, 3> neighbours;  // face across the edge from vertices[k] to the next
  bool is_alive;
  bool is_closed;            // no support point lies beyond it as far as rounding lets us see
  Vec3<S> normal;            // outward, unit; zero where the triangle has no area
  S offset;                  // normal . x of its plane
  Vec3<S> direction;         // unit, outward: along which to look for the next point
  S distance;                // of the triangle from the origin
  std::array<S, 3> weights;  // of its point nearest to the origin
};

/// The polytope of EPA: a closed surface of triangles inside the Minkowski difference around the
/// origin, in units. Room for every expansion that EPA may make; nothing on the heap.
template <class S>
struct Polytope {
  static constexpr int kMaxVertices = 4 + kMaxEpaIterations;
  static constexpr int kMaxFaces = 2 * kMaxVertices;

  /// `tetrahedron` has four points that span a volume. Points within `rounding` of a plane are on
  /// it.
  Polytope(const StartSimplex<S>& tetrahedron, S rounding);

  /// Corner k of a face, modulo 3.
  const DifferencePoint<S>& corner(const PolytopeFace<S>& face, int k) const {
    return at(vertices, at(face.vertices, k % 3));
  }
  /// The open face nearest to the origin; -1 when all are closed.
  int nearest_open() const;
  /// Distance of the surface from the origin.
  S distance() const;
  bool has_vertex(const IndexPair& pair) const;

  /// Replaces the faces that `point` sees, among them `seen`, by those between it and their horizon.
  /// False, and nothing changed, where rounding has made the horizon no simple loop.
  bool expand(int seen, const DifferencePoint<S>& point);

  StaticVector<DifferencePoint<S>, kMaxVertices> vertices;
  StaticVector<PolytopeFace<S>, kMaxFaces> faces;  // also those that are no longer alive

 private:
  int add_face(int first, int second, int third);
  void measure(PolytopeFace<S>& face) const;
  bool is_seen_from(const PolytopeFace<S>& face, const Vec3<S>& point) const;
  void link(int face, int edge, int neighbour, int neighbour_edge);

  S rounding_;
  StaticVector<int, kMaxFaces> free_;  // faces that are no longer alive
};

}  // namespace contactscope
