#pragma once

#include <array>
#include <optional>
#include <vector>

#include "geometry/aabb_tree.h"

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
  template <class S>
  bool update(const AabbTree<S>& tree);

  const Node& node(int index) const { return at(nodes_, index); }

 private:
  std::vector<Node> nodes_;
};

/// Two nodes, one of each tree (a, b).
using NodeIndices = std::array<int, 2>;

/// Two nodes whose children were compared with each other. The {first, count} child pairs are
/// adjacent in a front.
struct ParentPair {
  NodeIndices nodes;
  NodeIndices first_child;
  int children = 0;  // 4, or 2 if one of the nodes is a leaf
};

/// Cut where the simultaneous traversal of two trees ended: node pairs with separated boxes, and
/// pairs of leaves. Every pair of triangles is below exactly one of them ("bounding volume test
/// tree", Li and Chen 1998; "front", Ehmann and Lin 2001). The traversal of the next frame can
/// start here and skip the pairs above. Keep one front per pair of meshes, in the same order; see
/// mesh_overlap().
///
/// A front is valid for any poses, and for any vertices as long as the trees are only refitted.
/// begin() detects a rebuilt tree and resets the front.
class MeshFront {
 public:
  /// In depth-first order: all pairs below a common pair are adjacent.
  std::vector<NodeIndices> pairs;

  /// Call this before each traversal: an invalid front is reset to the pair of the roots. Neither
  /// tree may be empty.
  template <class S>
  void begin(const AabbTree<S>& a, const AabbTree<S>& b);

  /// The pair whose last children are these two nodes; none for the roots and other pairs.
  std::optional<ParentPair> parent_of_last_child(const NodeIndices& nodes) const;

  /// True if the pair at `place` in a front of `size` pairs may be replaced by its parent in this
  /// frame. Each pair has its turn once in kTurns frames.
  bool may_climb(std::size_t place, std::size_t size) const {
    return place * kTurns / size == static_cast<std::size_t>(turn_);
  }

 private:
  // Comparing a parent pair is wasted while its own boxes overlap, so each pair tries it only once
  // in this many frames.
  static constexpr int kTurns = 8;

  TreeLayout a_, b_;
  int turn_ = 0;
};

}  // namespace contactscope
