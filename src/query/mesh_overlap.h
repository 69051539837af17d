#pragma once

#include "geometry/mesh.h"
#include "query/triangle_overlap.h"

namespace contactscope {

/// Topology of a tree without its boxes: a refit keeps it, a rebuild changes it. Also stores each
/// node's parent, which the tree itself does not have.
class TreeLayout {
 public:
  struct Node {
    int next, count;  // as in AabbTree
    int parent;       // -1 for the root
    int depth;        // 0 for the root
  };

  /// Copies the layout of a tree. Returns true if it did not change. O(nodes).
  template <class S> bool update(const AabbTree<S>& tree);
  const Node& node(int index) const { return at(nodes_, index); }

 private:
  std::vector<Node> nodes_;
};

/// Two nodes, one of each tree (a, b).
using NodeIndices = std::array<int, 2>;

/// Nodes whose children were compared: pairs {first, count}, adjacent in a front.
struct ParentPair {
  NodeIndices nodes;
  NodeIndices first_child;
  int children = 0;  // 4, or 2 if one of the nodes is a leaf
};

/// Cut where the simultaneous traversal of two trees ended: node pairs with separated boxes, and
/// pairs of leaves. Every pair of triangles is below exactly one of them ("bounding volume test
/// tree", Li and Chen 1998; "front", Ehmann and Lin 2001). The next frame's traversal can start
/// here. Keep one front per pair of meshes, in the same order.
///
/// A front is valid for any poses, and for any vertices as long as the trees are only refitted.
/// begin() detects a rebuilt tree and resets the front.
class MeshFront {
 public:
  /// In depth-first order: all pairs below a common pair are adjacent.
  std::vector<NodeIndices> pairs;

  /// Before each traversal: resets an invalid front to the pair of the roots. No tree may be empty.
  template <class S> void begin(const AabbTree<S>& a, const AabbTree<S>& b);

  /// The pair whose last children are these two nodes; none for the roots and other pairs.
  std::optional<ParentPair> parent_of_last_child(const NodeIndices& nodes) const;

  /// True if the pair at `place` in a front of `size` pairs may be replaced by its parent in this
  /// frame. Each pair has its turn once in kTurns frames.
  bool may_climb(std::size_t place, std::size_t size) const {
    return place * kTurns / size == static_cast<std::size_t>(turn_);
  }

 private:
  // Each pair tries its parents, wasted while their boxes overlap, once in this many frames.
  static constexpr int kTurns = 8;

  TreeLayout a_, b_;
  int turn_ = 0;
};

/// A triangle of mesh a and one of mesh b that share a point.
template <class S> struct MeshIntersection {
  int a = -1;  // triangle indices
  int b = -1;
  TriangleOverlap<S> overlap;  // a's frame; its kind is never None
};

/// Cost of the simultaneous traversal of both trees.
struct MeshOverlapCounts {
  std::int64_t node_pairs = 0;      // tests between boxes of nodes
  std::int64_t leaf_pairs = 0;      // overlapping leaves, whose triangles' boxes are tested
  std::int64_t triangle_pairs = 0;  // exact tests between triangles
};

template <class S> struct MeshOverlap {
  std::vector<MeshIntersection<S>> intersections;  // by a, then by b
  MeshOverlapCounts counts;
  bool overlapping() const { return !intersections.empty(); }
};

/// Two nodes whose boxes were compared.
struct NodePairVisit {
  int a = 0;  // indices into the trees
  int b = 0;
  bool overlaps = false;  // only then the traversal continued below
  friend bool operator==(const NodePairVisit&, const NodePairVisit&) = default;
};

/// Finds every pair of triangles of two meshes that share a point.
///
/// The vertices of b are first moved into a's frame and rounded (vertices_in). For these and a's
/// vertices the pairs and their kinds are exact. Boxes of b are recomputed around the moved
/// vertices, so none is lost. Segments are rounded as described at triangle_overlap.
///
/// `visits` receives the node pairs in the order of comparison; it may be null.
///
/// Source: Gottschalk, Lin and Manocha 1996, "OBBTree", section 5, simultaneous traversal, with
/// axis-aligned boxes. For two inner nodes with overlapping boxes, the children of one are compared
/// with those of the other; a leaf is compared with the children of an inner node.
///
/// With a `front` the traversal starts where the last call ended, and stores its new end there (Li
/// and Chen 1998; Ehmann and Lin 2001, section 5). Pairs above the front are skipped: boxes contain
/// those of their children exactly, so a pair overlaps if one below it does. If all children of a
/// pair are separated, one call in eight compares the pair itself, which replaces them if its boxes
/// are separated as well. If the roots are separated, they replace the front at once. The result is
/// bitwise the same; counts and visits contain the actual comparisons.
template <class S>
MeshOverlap<S> mesh_overlap(const Mesh<S>& a, const Mesh<S>& b, const Pose<S>& b_in_a,
                            std::vector<NodePairVisit>* visits = nullptr,
                            MeshFront* front = nullptr);

/// Vertices of a mesh in the parent frame of `pose`: transformed in double by the rotation matrix,
/// then rounded to S. For S = double they are off by a few roundings.
template <class S> std::vector<Vec3<S>> vertices_in(const Mesh<S>& mesh, const Pose<S>& pose);

}  // namespace contactscope
