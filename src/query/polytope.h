#pragma once

#include <array>
#include <cstdint>

#include "core/static_vector.h"
#include "query/blow_up.h"
#include "query/epa.h"

namespace contactscope {

/// A triangle of the polytope, seen from outside.
template <class S>
struct PolytopeFace {
  std::array<std::int16_t, 3> vertices;    // counter-clockwise
  std::array<std::int16_t, 3> neighbours;  // face across the edge from vertices[k] to the next
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
class Polytope {
 public:
  static constexpr int kMaxVertices = 4 + kMaxEpaIterations;
  static constexpr int kMaxFaces = 2 * kMaxVertices;

  /// `tetrahedron` has four points that span a volume. Points within `rounding` of a plane are on
  /// it.
  Polytope(const StartSimplex<S>& tetrahedron, S rounding);

  const PolytopeFace<S>& face(int index) const { return faces_[static_cast<std::size_t>(index)]; }
  const DifferencePoint<S>& vertex(int index) const {
    return vertices_[static_cast<std::size_t>(index)];
  }
  int vertex_count() const { return static_cast<int>(vertices_.size()); }
  int face_slots() const { return static_cast<int>(faces_.size()); }

  /// The open face nearest to the origin; -1 when all are closed.
  int nearest_open() const;
  /// Distance of the surface from the origin.
  S distance() const;
  void close(int face) { faces_[static_cast<std::size_t>(face)].is_closed = true; }
  bool has_vertex(const IndexPair& pair) const;

  /// Replaces the faces that `point` sees, among them `seen`, by those between it and their horizon.
  /// False, and nothing changed, where rounding has made the horizon no simple loop.
  bool expand(int seen, const DifferencePoint<S>& point);

 private:
  int add_face(int first, int second, int third);
  void measure(PolytopeFace<S>& face) const;
  bool is_seen_from(const PolytopeFace<S>& face, const Vec3<S>& point) const;
  const Vec3<S>& corner(const PolytopeFace<S>& face, int k) const {
    return vertex(face.vertices[static_cast<std::size_t>(k % 3)]).point;
  }
  void link(int face, int edge, int neighbour, int neighbour_edge);
  int edge_from(int face, int vertex) const;

  S rounding_;
  StaticVector<DifferencePoint<S>, kMaxVertices> vertices_;
  StaticVector<PolytopeFace<S>, kMaxFaces> faces_;
  StaticVector<std::int16_t, kMaxFaces> free_;
};

}  // namespace contactscope
