#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/pose.h"
#include "geometry/mesh.h"
#include "query/mesh_front.h"
#include "query/triangle_overlap.h"

namespace contactscope {

/// A triangle of mesh a and one of mesh b that share a point.
template <class S>
struct MeshIntersection {
  int a = -1;  // triangles
  int b = -1;
  TriangleOverlap<S> overlap;  // a's frame; its kind is never None
};

/// What the simultaneous traversal of both trees cost.
struct MeshOverlapCounts {
  std::int64_t node_pairs = 0;      // boxes of nodes tested against each other
  std::int64_t leaf_pairs = 0;      // leaves whose boxes overlap: their triangles' boxes are tested
  std::int64_t triangle_pairs = 0;  // triangles tested against each other, exactly
};

template <class S>
struct MeshOverlap {
  std::vector<MeshIntersection<S>> intersections;  // by a, then by b
  MeshOverlapCounts counts;

  bool overlapping() const { return !intersections.empty(); }
};

/// Two nodes whose boxes were compared.
struct NodePairVisit {
  int a = 0;  // nodes of the trees, in their order
  int b = 0;
  bool overlaps = false;  // only then what is below was looked at

  friend bool operator==(const NodePairVisit&, const NodePairVisit&) = default;
};

/// Every pair of triangles of two meshes that share a point.
///
/// What is exact: the vertices of b are moved into a's frame first, see vertices_in, which rounds
/// them; for the triangles between these and a's own vertices the answer is exact, in which pairs
/// there are and in their kinds. Boxes of b are made anew around the moved vertices, so that no
/// pair is lost to a box that was rounded or turned. A segment is rounded as triangle_overlap says.
///
/// `visits` gets the node pairs in the order in which they were compared; nullptr when nobody
/// watches.
///
/// Source: Gottschalk, Lin and Manocha 1996, "OBBTree", section 5, the simultaneous traversal, with
/// axis-aligned boxes. Of two inner nodes whose boxes overlap, the children of one are compared with
/// those of the other; a leaf is compared with the children of an inner node.
///
/// With a `front` the traversal begins where that of the last call ended, and leaves there where it
/// ends (Li and Chen 1998; Ehmann and Lin 2001, section 5): pairs above the front are not compared.
/// Boxes hold those of their children exactly, so that a pair overlaps if one below it does. Where
/// all children of a pair are apart the pair is compared, in one call of eight, and takes their
/// place if its boxes are apart as well; if the roots are, the front is given up for them at once.
/// The result is the same, bit for bit; counts and visits are what was really compared.
template <class S>
MeshOverlap<S> mesh_overlap(const Mesh<S>& a, const Mesh<S>& b, const Pose<S>& b_in_a,
                            std::vector<NodePairVisit>* visits = nullptr,
                            MeshFront* front = nullptr);

/// The vertices of a mesh in a parent frame: turned by the matrix of the rotation and shifted, in
/// double, then rounded to S. With S = double they are off by some roundings of their coordinates.
template <class S>
std::vector<Vec3<S>> vertices_in(const Mesh<S>& mesh, const Pose<S>& pose);

}  // namespace contactscope
