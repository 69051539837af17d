#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/at.h"
#include "core/vec3.h"
#include "geometry/aabb.h"

namespace contactscope {

namespace trace {
struct Tree;
}

/// Tree of boxes over triangles, in the frame and the unit of their vertices.
///
///     nodes   0 -------- root          node 0 comes first, then all of its left subtree, then
///            /        |                all of its right one: a query walks the array forwards,
///           1         4                and where a box misses it goes on behind the subtree. It
///          / |       / |               needs neither a stack nor parents.
///         2   3     5   6
///
/// The order of visits is that of the array: left before right, triangles of a leaf ascending. It
/// depends on the boxes alone.
template <class S>
struct AabbTree {
  struct Node {
    Aabb<S> box;
    int next;   // of a leaf: its first triangle in `triangles`; else: the node behind the subtree
    int count;  // of a leaf: how many triangles; else: 0

    bool leaf() const { return count > 0; }
  };

  std::vector<Node> nodes;     // empty for no triangles
  std::vector<int> triangles;  // in tree order
  std::vector<Aabb<S>> boxes;  // of each of `triangles`

  /// The right child of an inner node; the left one is the next node.
  int right_of(int node) const {
    const Node& left = at(nodes, node + 1);
    return left.leaf() ? node + 2 : left.next;
  }

  /// The box of everything; empty for no triangles.
  Aabb<S> bounds() const { return nodes.empty() ? Aabb<S>{} : nodes.front().box; }

  /// Calls visit(triangle) for each triangle whose own box overlaps `box`; touching counts. Nothing
  /// is allocated.
  template <class Visit>
  void query(const Aabb<S>& box, Visit&& visit) const {
    any_of(box, [&](int triangle) {
      visit(triangle);
      return false;
    });
  }

  /// Whether holds(triangle) for any of the triangles that a query with `box` visits, in the same
  /// order; asks no more of them after the first one.
  template <class Holds>
  bool any_of(const Aabb<S>& box, Holds&& holds) const {
    return any_place_of(box, [&](int place) { return holds(at(triangles, place)); });
  }
  /// The same, of places in `triangles` and `boxes`.
  template <class Holds>
  bool any_place_of(const Aabb<S>& box, Holds&& holds) const {
    const OverlapsWith<S> overlaps_box(box);
    const int node_count = count_of(nodes);
    int i = 0;
    while (i < node_count) {
      const Node& node = at(nodes, i);
      const bool hit = overlaps_box(node.box);
      if (hit && node.leaf() && any_of_leaf(node, overlaps_box, holds)) return true;
      i = hit || node.leaf() ? i + 1 : node.next;
    }
    return false;
  }

  /// The same triangles in the same order, as candidates, and how they were found.
  trace::Tree recorded_query(const Aabb<S>& box) const;

  /// How many boxes a query tests that is small and meets the root, as the surface area heuristic
  /// expects: of each inner node two and of each leaf all its triangles', weighted by the surface
  /// of the node over that of the root (Goldsmith and Salmon 1987). 0 for no triangles. Says what a
  /// tree has become after refits, beside what it was when it was built. O(n).
  double expected_cost() const;

  /// Makes all boxes anew after vertices moved; the shape of the tree stays, so that it gets slower
  /// the more the mesh is distorted. `corners` are the vertex indices of each triangle, as many as
  /// at the build.
  void refit(std::span<const Vec3<S>> vertices, std::span<const std::array<int, 3>> corners);

  /// Makes the boxes of all nodes anew from `boxes`.
  void fit_nodes();

 private:
  template <class Holds>
  bool any_of_leaf(const Node& node, const OverlapsWith<S>& overlaps_box, Holds&& holds) const {
    for (int k = node.next; k < node.next + node.count; ++k) {
      if (overlaps_box(at(boxes, k)) && holds(k)) return true;
    }
    return false;
  }
};

/// No way from the root to a leaf has more nodes, whatever the triangles.
inline constexpr int kMaxAabbTreeDepth = 64;

/// Box of one triangle.
template <class S>
Aabb<S> box_of(std::span<const Vec3<S>> vertices, const std::array<int, 3>& corners) {
  Aabb<S> box;
  for (const int corner : corners) box.include(at(vertices, corner));
  return box;
}

/// Tree over the boxes of triangles 0, 1, 2, ...; none of them empty. O(n log n).
/// Source: Wald 2007, "On fast Construction of SAH-based Bounding Volume Hierarchies".
AabbTree<double> build_aabb_tree(std::span<const Aabb<double>> boxes);

/// The same tree in another scalar. Its boxes are exactly those of the rounded triangles, because
/// rounding is monotone.
template <class T>
AabbTree<T> aabb_tree_cast(const AabbTree<double>& tree);

}  // namespace contactscope
