#pragma once

#include "core/pose.h"

namespace contactscope {

/// Directed edge of a hull. The twin of half-edge i is i ^ 1; edge e is half-edges 2e and 2e + 1.
struct HalfEdge {
  int origin;  // vertex where it starts
  int next;    // next half-edge around the same face, counter-clockwise seen from outside
  int face;    // face on its left
};

/// Range over a ring of half-edges, each once. `next` maps a half-edge to its successor.
template <class Next> struct EdgeRing {
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
template <class Next> EdgeRing(int, Next) -> EdgeRing<Next>;

/// Copies of a hull's vertices and planes in the layout that loops over lanes read (lanes.h).
template <class S> struct HullLanes {
  std::vector<S> vertices;  // padded with zeros
  std::vector<S> normals;   // padded with zeros
  std::vector<S> offsets;   // padded with infinity: every point is behind such a face

  friend bool operator==(const HullLanes&, const HullLanes&) = default;
};

/// Where the surface of a hull continues in shapes next to it, see join_seams().
template <class S> struct HullSeams {
  std::vector<std::uint8_t> covered;  // per face: 1 if other hulls lie against all of it
  std::vector<Vec3<S>> beyond;  // per half-edge: unit normal of the surface that continues its face
                                // there; zero: none

  bool empty() const { return covered.empty(); }
};

/// Convex polyhedron with half-edges, local frame, metres. Only the hull builder makes hulls, with
/// these invariants: faces are planar within rounding; coplanar faces are merged, unless cut again
/// by triangulate_faces; every vertex is used; V - E + F = 2; twins run in opposite directions; no
/// face has more than kMaxFaceVertices vertices.
///
/// A flat hull is a polygon: two faces on one plane with opposite normals, and no volume.
template <class S> struct Hull {
  std::vector<Vec3<S>> vertices;
  std::vector<HalfEdge> half_edges;    // two per edge, twins adjacent
  std::vector<int> vertex_edges;       // one outgoing half-edge per vertex
  std::vector<int> face_edges;         // one half-edge per face
  std::vector<Plane<S>> planes;        // one per face, normal outward
  HullLanes<S> lanes;                  // copies of `vertices` and `planes`, made by lay_out
  Vec3<S> centroid = Vec3<S>::Zero();  // at uniform density; of the area for a flat hull
  S radius = 0;                        // largest distance of a vertex from the centroid
  /// Set by lay_out for boxes that equal the result of make_box in every number; otherwise zero.
  Vec3<S> half_extents = Vec3<S>::Zero();
  HullSeams<S> seams;  // empty: nowhere
  int vertex_count() const { return static_cast<int>(vertices.size()); }
  int edge_count() const { return static_cast<int>(half_edges.size() / 2); }
  int face_count() const { return static_cast<int>(planes.size()); }

  /// True for flat hulls; no other hull has two faces.
  bool flat() const { return planes.size() == 2; }
  /// True if code may use half_extents and box_topology.h instead of the half-edges.
  bool is_box() const { return half_extents.x() > S(0); }
  static constexpr int twin(int half_edge) { return half_edge ^ 1; }
  const Vec3<S>& origin(int half_edge) const {
    return at(vertices, at(half_edges, half_edge).origin);
  }
  const Vec3<S>& target(int half_edge) const { return origin(twin(half_edge)); }

  /// Half-edges of a face, counter-clockwise seen from outside, starting with its face_edges entry.
  auto around_face(int face) const {
    return EdgeRing{at(face_edges, face), [this](int edge) { return at(half_edges, edge).next; }};
  }
  /// Outgoing half-edges of a vertex, clockwise seen from outside, from its vertex_edges entry on.
  auto around_vertex(int vertex) const {
    return EdgeRing{at(vertex_edges, vertex),
                    [this](int edge) { return at(half_edges, twin(edge)).next; }};
  }
};

/// Computes `hull.lanes` and `hull.half_extents`. Call it again after changing vertices or planes.
template <class S> void lay_out(Hull<S>& hull);

/// The same hull in another scalar; vertices, planes and centroid are rounded once.
template <class T, class S> Hull<T> hull_cast(const Hull<S>& hull);

/// Vertex indices of a face, in the order of around_face.
template <class S> std::vector<int> face_vertices(const Hull<S>& hull, int face);

}  // namespace contactscope
