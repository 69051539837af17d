#pragma once

#include "geometry/hull.h"

namespace contactscope {

/// The numbering of make_box as compile-time tables, so that code for boxes need not walk
/// half-edges. The bits of i are the signs of vertex i, set = positive. Faces are +x, -x, +y, -y,
/// +z, -z. Edges are numbered as hull_from_polygons does.
struct BoxTopology {
  std::array<HalfEdge, 24> half_edges{};
  std::array<int, 8> vertex_edges{};
  std::array<int, 6> face_edges{};

  /// Half-edges of each face, and faces around each vertex, in the order of Hull's rings.
  std::array<std::array<int, 4>, 6> face_ring{};
  std::array<std::array<int, 3>, 8> faces_around{};

  /// The half-edge that leaves vertex i along each coordinate axis, in either direction.
  std::array<std::array<int, 3>, 8> leaving{};

  constexpr int origin(int half_edge) const {
    return half_edges[static_cast<std::size_t>(half_edge)].origin;
  }
  constexpr int face(int half_edge) const {
    return half_edges[static_cast<std::size_t>(half_edge)].face;
  }
};

/// Vertices of the faces, counter-clockwise seen from outside.
inline constexpr int kBoxFaces[6][4] = {{1, 3, 7, 5}, {0, 4, 6, 2}, {2, 6, 7, 3},
                                        {0, 1, 5, 4}, {4, 5, 7, 6}, {0, 2, 3, 1}};

inline constexpr BoxTopology kBox = [] {
  BoxTopology box;
  std::size_t count = 0;
  const auto half_edge_between = [&](int origin, int target) {
    for (std::size_t i = 0; i < count; ++i)
      if (box.half_edges[i].origin == origin && box.half_edges[i ^ 1].origin == target) return i;
    box.half_edges[count] = {origin, -1, -1};
    box.half_edges[count + 1] = {target, -1, -1};
    count += 2;
    return count - 2;
  };
  for (std::size_t face = 0; face < 6; ++face) {
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t edge = half_edge_between(kBoxFaces[face][i], kBoxFaces[face][(i + 1) % 4]);
      box.half_edges[edge].face = static_cast<int>(face);
      box.face_ring[face][i] = static_cast<int>(edge);
      if (i > 0)
        box.half_edges[static_cast<std::size_t>(box.face_ring[face][i - 1])].next =
            static_cast<int>(edge);
    }
    box.face_edges[face] = box.face_ring[face][0];
    box.half_edges[static_cast<std::size_t>(box.face_ring[face][3])].next = box.face_ring[face][0];
  }
  for (std::size_t i = count; i-- > 0;) {
    const int across = box.half_edges[i].origin ^ box.half_edges[i ^ 1].origin;
    const auto origin = static_cast<std::size_t>(box.half_edges[i].origin);
    box.vertex_edges[origin] = static_cast<int>(i);
    box.leaving[origin][static_cast<std::size_t>(across / 2)] = static_cast<int>(i);
  }
  for (std::size_t vertex = 0; vertex < 8; ++vertex) {
    int edge = box.vertex_edges[vertex];
    for (std::size_t i = 0; i < 3; ++i) {
      box.faces_around[vertex][i] = box.face(edge);
      edge = box.half_edges[static_cast<std::size_t>(edge ^ 1)].next;
    }
  }
  return box;
}();

}  // namespace contactscope
