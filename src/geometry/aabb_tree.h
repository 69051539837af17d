#pragma once

#include "geometry/aabb.h"

namespace contactscope {

namespace trace {
struct Tree;
}

/// Bounding volume hierarchy over triangles, in the frame and unit of their vertices.
///
///     nodes   0 -------- root          Node 0 comes first, then its whole left subtree, then its
///            /        |                whole right one. A query walks the array forwards and skips
///           1         4                the subtree of each box that it misses, so it needs
///          / |       / |               neither a stack nor parent links.
///         2   3     5   6
///
/// Triangles are visited in array order, left before right. It depends only on the boxes.
template <class S> struct AabbTree {
  struct Node {
    Aabb<S> box;
    int next;   // leaf: its first triangle in `triangles`; else: the node after the subtree
    int count;  // leaf: number of triangles; else: 0

    bool leaf() const { return count > 0; }
  };

  std::vector<Node> nodes;     // empty if there are no triangles
  std::vector<int> triangles;  // in tree order
  std::vector<Aabb<S>> boxes;  // one for each entry of `triangles`

  /// The right child of an inner node; the left child is the next node.
  int right_of(int node) const {
    const Node& left = at(nodes, node + 1);
    return left.leaf() ? node + 2 : left.next;
  }

  /// Box around all triangles; empty if there are none.
  Aabb<S> bounds() const { return nodes.empty() ? Aabb<S>{} : nodes.front().box; }

  /// Calls visit(triangle) for each triangle whose own box overlaps or touches `box`.
  template <class Visit> void query(const Aabb<S>& box, Visit&& visit) const {
    any_of(box, [&](int triangle) {
      visit(triangle);
      return false;
    });
  }

  /// Whether holds(triangle) for any that a query with `box` visits; stops at the first.
  template <class Holds> bool any_of(const Aabb<S>& box, Holds&& holds) const {
    const OverlapsWith<S> overlaps_box(box);
    const auto holds_at = [&](int place) { return holds(at(triangles, place)); };
    const int node_count = count_of(nodes);
    int i = 0;
    while (i < node_count) {
      const Node& node = at(nodes, i);
      const bool hit = overlaps_box(node.box);
      if (hit && node.leaf() && any_of_leaf(node, overlaps_box, holds_at)) return true;
      i = hit || node.leaf() ? i + 1 : node.next;
    }
    return false;
  }

  /// Adds the positions in `triangles` that query() visits to `places`. Has no branches on which boxes
  /// of a leaf are hit: they would be mispredicted. Returns false if there may be too many.
  template <std::size_t kMax>
  bool find_places(const Aabb<S>& box, StaticVector<int, kMax>& places) const {
    const OverlapsWith<S> overlaps_box(box);
    for (int i = 0; i < count_of(nodes);) {
      const Node& node = at(nodes, i);
      const bool hit = overlaps_box(node.box);
      i = hit || node.leaf() ? i + 1 : node.next;
      if (!hit || !node.leaf()) continue;
      if (count_of(places) + node.count > static_cast<int>(kMax)) return false;
      for (int place = node.next; place < node.next + node.count; ++place) {
        places.push_back(place);
        places.truncate(places.size() - (overlaps_box(at(boxes, place)) ? 0 : 1));
      }
    }
    return true;
  }

  /// The triangles of query() in the same order, as candidates, with the traversal that found them.
  trace::Tree recorded_query(const Aabb<S>& box) const;

  /// Expected number of box tests for a small query that hits the root, by the surface area
  /// heuristic: two per inner node, one per triangle in a leaf, weighted by the node's surface over
  /// the root's (Goldsmith and Salmon 1987). 0 for no triangles. Compare it with the value after
  /// the build to see how much refits have degraded the tree. O(n).
  double expected_cost() const;

  /// Recomputes all boxes after vertices moved. The topology stays, so queries get slower as the
  /// mesh is distorted. `corners` are the vertex indices of each triangle, as many as at the build.
  void refit(std::span<const Vec3<S>> vertices, std::span<const std::array<int, 3>> corners);

  /// Recomputes the boxes of all nodes from `boxes`.
  void fit_nodes();

 private:
  template <class Holds>
  bool any_of_leaf(const Node& node, const OverlapsWith<S>& overlaps_box, Holds&& holds) const {
    return any_hit(
        node.count, [&](int k) { return overlaps_box(at(boxes, node.next + k)); },
        [&](int k) { return holds(node.next + k); });
  }
};

/// Maximum number of nodes on a path from the root to a leaf, for any input.
inline constexpr int kMaxAabbTreeDepth = 64;

template <class S>
Aabb<S> box_of(std::span<const Vec3<S>> vertices, const std::array<int, 3>& corners) {
  Aabb<S> box;
  for (const int corner : corners) box.include(at(vertices, corner));
  return box;
}

/// Builds a tree over the boxes of triangles 0, 1, 2, ..., none of them empty. O(n log n).
/// Source: Wald 2007, "On fast Construction of SAH-based Bounding Volume Hierarchies".
AabbTree<double> build_aabb_tree(std::span<const Aabb<double>> boxes);

/// The same tree in another scalar. Its boxes are those of the rounded triangles, as in Aabb::cast.
template <class T> AabbTree<T> aabb_tree_cast(const AabbTree<double>& tree);

}  // namespace contactscope
