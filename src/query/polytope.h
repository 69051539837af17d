#pragma once

#include "query/penetration_bounds.h"

namespace contactscope {

/// A tetrahedron of the difference around the origin within rounding, or a degenerate simplex.
template <class S> struct StartSimplex {
  int count = 0;  // 4: a tetrahedron; less: the difference does not extend beyond these points
  std::array<DifferencePoint<S>, 4> points;
  Vec3<S> outward = Vec3<S>::UnitX();  // if count < 4: unit, across the difference
};

/// A triangle of the polytope.
template <class S> struct PolytopeFace {
  std::array<int, 3> vertices;    // counter-clockwise seen from outside
  std::array<int, 3> neighbours;  // face across the edge from vertices[k] to the next
  bool is_alive;
  bool is_closed;            // no support point lies beyond it within rounding
  Vec3<S> normal;            // outward, unit; zero for a triangle without area
  S offset;                  // of its plane: normal . x
  Vec3<S> direction;         // unit, outward: search direction for the next point
  S distance;                // from the origin to the triangle
  std::array<S, 3> weights;  // barycentric, of its point closest to the origin
};

/// The polytope of EPA: a closed triangle mesh around the origin inside the Minkowski difference,
/// in units. Has capacity for all expansions of EPA, without heap allocations.
template <class S> struct Polytope {
  static constexpr int kMaxVertices = 4 + kMaxEpaIterations;
  static constexpr int kMaxFaces = 2 * kMaxVertices;

  /// `tetrahedron` spans a volume. Points within `rounding` of a plane are on it.
  Polytope(const StartSimplex<S>& tetrahedron, S rounding);

  /// Corner k, modulo 3, of a face.
  const DifferencePoint<S>& corner(const PolytopeFace<S>& face, int k) const {
    return at(vertices, at(face.vertices, k % 3));
  }
  /// The open face closest to the origin; -1 if all are closed.
  int nearest_open() const;
  /// Distance from the origin to the surface.
  S distance() const;
  bool has_vertex(const IndexPair& pair) const;

  /// Replaces the faces visible from `point`, including `seen`, by a cone from their horizon to it.
  /// Returns false and changes nothing if rounding leaves no simple loop as the horizon.
  bool expand(int seen, const DifferencePoint<S>& point);

  StaticVector<DifferencePoint<S>, kMaxVertices> vertices;
  StaticVector<PolytopeFace<S>, kMaxFaces> faces;  // including removed ones

 private:
  int add_face(int first, int second, int third);
  void measure(PolytopeFace<S>& face) const;
  bool is_seen_from(const PolytopeFace<S>& face, const Vec3<S>& point) const;
  void link(int face, int edge, int neighbour, int neighbour_edge);

  S rounding_;
  StaticVector<int, kMaxFaces> free_;  // indices of removed faces
};

}  // namespace contactscope
