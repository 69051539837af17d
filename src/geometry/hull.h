#pragma once

#include <cstddef>
#include <iterator>
#include <vector>

#include "core/at.h"
#include "core/plane.h"
#include "core/vec3.h"

namespace contactscope {

/// Directed edge of a hull. The twin of half-edge i is i ^ 1, so undirected edge e is the
/// half-edges 2e and 2e + 1.
struct HalfEdge {
  int origin;  // vertex that it leaves
  int next;    // next half-edge around the same face, counter-clockwise seen from outside
  int face;    // face on its left
};

/// Half-edges that lie in a ring, each once, as a range: `next` of a half-edge is the one after it.
template <class Next>
struct EdgeRing {
  struct Iterator {
    using value_type = int;
    using difference_type = std::ptrdiff_t;

    int operator*() const { return edge; }
    Iterator& operator++() {
      edge = ring->next(edge);
      is_round = edge == ring->first;
      return *this;
    }
    void operator++(int) { ++*this; }
    bool operator==(std::default_sentinel_t) const { return is_round; }

    const EdgeRing* ring;
    int edge;
    bool is_round = false;
  };

  Iterator begin() const { return {this, first}; }
  std::default_sentinel_t end() const { return {}; }

  int first;
  Next next;
};
template <class Next>
EdgeRing(int, Next) -> EdgeRing<Next>;

/// Vertices and planes of a hull once more, as the loops over lanes read them (see lanes.h).
template <class S>
struct HullLanes {
  std::vector<S> vertices;  // padded with zeros
  std::vector<S> normals;   // padded with zeros
  std::vector<S> offsets;   // padded with infinity: such a face lies behind every point

  friend bool operator==(const HullLanes&, const HullLanes&) = default;
};

/// Convex polyhedron with half-edges, local frame, metres. Made by the hull builder only, which
/// keeps these promises: faces are planar within rounding, and merged when coplanar unless it was
/// asked to leave them unmerged (triangulate_faces); every vertex is used, V - E + F = 2, twins run
/// opposite, no face has more than kMaxFaceVertices vertices.
///
/// A flat hull is a polygon with two faces back to back, on one plane with opposite normals; it has
/// no volume.
template <class S>
struct Hull {
  std::vector<Vec3<S>> vertices;
  std::vector<HalfEdge> half_edges;    // two for each edge, twins adjacent
  std::vector<int> vertex_edges;       // for each vertex one half-edge that leaves it
  std::vector<int> face_edges;         // for each face one of its half-edges
  std::vector<Plane<S>> planes;        // for each face, normal outward
  HullLanes<S> lanes;                  // of `vertices` and `planes`, made by lay_out
  Vec3<S> centroid = Vec3<S>::Zero();  // centre of mass at uniform density, of a flat one of area
  S radius = 0;                        // largest distance of a vertex from the centroid
  /// Of a box as make_box makes it, numbers and all; zero of any other hull. Made by lay_out.
  Vec3<S> half_extents = Vec3<S>::Zero();

  int vertex_count() const { return static_cast<int>(vertices.size()); }
  int edge_count() const { return static_cast<int>(half_edges.size() / 2); }
  int face_count() const { return static_cast<int>(planes.size()); }

  /// No other hull has two faces.
  bool flat() const { return planes.size() == 2; }
  /// What knows boxes may go by half_extents and box_topology.h alone.
  bool is_box() const { return half_extents.x() > S(0); }

  static constexpr int twin(int half_edge) { return half_edge ^ 1; }
  const Vec3<S>& origin(int half_edge) const {
    return at(vertices, at(half_edges, half_edge).origin);
  }
  const Vec3<S>& target(int half_edge) const { return origin(twin(half_edge)); }

  /// The half-edges of a face, counter-clockwise seen from outside, from its face_edges entry on.
  auto around_face(int face) const {
    return EdgeRing{at(face_edges, face), [this](int edge) { return at(half_edges, edge).next; }};
  }
  /// The half-edges that leave a vertex, clockwise seen from outside, from its vertex_edges entry on.
  auto around_vertex(int vertex) const {
    return EdgeRing{at(vertex_edges, vertex),
                    [this](int edge) { return at(half_edges, twin(edge)).next; }};
  }
};

/// Makes `hull.lanes` and `hull.half_extents` from its vertices and planes. Whoever changes those calls
/// it anew.
template <class S>
void lay_out(Hull<S>& hull);

/// The same hull in another scalar. Vertices, planes and centroid are rounded once each from the
/// input, topology is copied.
template <class T, class S>
Hull<T> hull_cast(const Hull<S>& hull);

/// Vertex indices of a face, counter-clockwise seen from outside, in the order of around_face.
template <class S>
std::vector<int> face_vertices(const Hull<S>& hull, int face);

}  // namespace contactscope
