#pragma once

#include <array>
#include <optional>
#include <vector>

#include "geometry/aabb_tree.h"

namespace contactscope {

/// How the nodes of a tree hang together, whatever their boxes: the same after a refit, another one
/// after a build. Where each node hangs is kept beside it, which the tree itself does not know.
class TreeLayout {
 public:
  struct Node {
    int next, count;  // as in AabbTree
    int parent;       // -1 of the root
    int depth;        // 0 of the root
  };

  /// Takes over the layout of a tree. Returns whether it was this one before. O(nodes).
  template <class S>
  bool update(const AabbTree<S>& tree);

  const Node& node(int index) const { return at(nodes_, index); }

 private:
  std::vector<Node> nodes_;
};

/// Two nodes, of the trees of a and b.
using NodeIndices = std::array<int, 2>;

/// Two nodes whose children were compared with each other: {first, count} of them stand behind each
/// other in a front.
struct ParentPair {
  NodeIndices nodes;
  NodeIndices first_child;
  int children = 0;  // 4, or 2 where one of the nodes is a leaf
};

/// Where the simultaneous traversal of two trees ended: the pairs of nodes at which it went no deeper,
/// because their boxes are apart or because both are leaves. They are a cut through the tree of all
/// pairs ("bounding volume test tree", Li and Chen 1998; "front", Ehmann and Lin 2001): every pair of
/// triangles is below exactly one of them. So the traversal of the next frame may begin with them, and
/// spares the pairs above. Keep one for each pair of meshes, in the same order; see mesh_overlap().
///
/// It holds for any poses, and for any vertices as long as the trees are refitted. Where one was
/// built anew the front is void, which is found out here.
class MeshFront {
 public:
  /// In the order of a traversal to the depth: what is below one pair stands together.
  std::vector<NodeIndices> pairs;

  /// To be called before each traversal: where the front is void it becomes the pair of the roots.
  /// Neither tree is empty.
  template <class S>
  void begin(const AabbTree<S>& a, const AabbTree<S>& b);

  /// The pair of which these two nodes are the last children; none of the roots, and of others.
  std::optional<ParentPair> parent_of_last_child(const NodeIndices& nodes) const;

  /// Whether the pair at this place of a front of `size` pairs is one of those whose turn it is in
  /// this frame to be given up for their parents. All have had their turn after kTurns frames.
  bool may_climb(std::size_t place, std::size_t size) const {
    return place * kTurns / size == static_cast<std::size_t>(turn_);
  }

 private:
  // A pair whose children are all apart is compared for nothing as long as its own boxes overlap. So
  // each is asked in one frame of so many.
  static constexpr int kTurns = 8;

  TreeLayout a_, b_;
  int turn_ = 0;
};

}  // namespace contactscope
