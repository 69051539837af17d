#include "geometry/aabb_tree.h"

#include <cassert>

#include "trace/pair.h"

namespace contactscope {
namespace {

template <class S>
trace::Box traced(const Aabb<S>& box) {
  return {box.lower.template cast<double>(), box.upper.template cast<double>()};
}

}  // namespace

template <class S>
trace::Tree AabbTree<S>::recorded_query(const Aabb<S>& box) const {
  trace::Tree record;
  record.box = traced(box);
  std::vector<int> ends;  // ends of the subtrees that contain node i
  for (int i = 0; i < count_of(nodes);) {
    while (!ends.empty() && ends.back() <= i) ends.pop_back();
    const Node& node = at(nodes, i);
    const bool hit = overlaps(node.box, box);
    record.visits.push_back({traced(node.box), count_of(ends), node.leaf(), hit});
    if (hit && node.leaf()) {
      any_of_leaf(node, OverlapsWith<S>(box), [&](int place) {
        record.candidates.push_back(at(triangles, place));
        return false;
      });
    }
    if (!node.leaf()) ends.push_back(node.next);
    i = hit || node.leaf() ? i + 1 : node.next;
  }
  return record;
}

template <class S>
void AabbTree<S>::refit(std::span<const Vec3<S>> vertices,
                        std::span<const std::array<int, 3>> corners) {
  assert(corners.size() == triangles.size());
  boxes = mapped(triangles, [&](int triangle) { return box_of(vertices, at(corners, triangle)); });
  fit_nodes();
}

template <class S>
void AabbTree<S>::fit_nodes() {
  // Backwards: children come after their parent.
  for (std::size_t i = nodes.size(); i-- > 0;) {
    Node& node = nodes[i];
    node.box = {};
    if (node.leaf()) {
      for (int k = node.next; k < node.next + node.count; ++k) node.box.include(at(boxes, k));
    } else {
      node.box.include(nodes[i + 1].box);
      node.box.include(at(nodes, right_of(static_cast<int>(i))).box);
    }
  }
}

template <class S>
double AabbTree<S>::expected_cost() const {
  double weighted = 0;
  for (const Node& node : nodes) {
    const int boxes_tested = node.leaf() ? node.count : 2;
    weighted += boxes_tested * surface_area(node.box.template cast<double>());
  }
  const double all = surface_area(bounds().template cast<double>());
  // All triangles on one line: assume that every query visits every box.
  return all > 0 ? weighted / all : static_cast<double>(nodes.size() + triangles.size());
}

template <class T>
AabbTree<T> aabb_tree_cast(const AabbTree<double>& tree) {
  const auto cast = [](const AabbTree<double>::Node& node) -> typename AabbTree<T>::Node {
    return {node.box.cast<T>(), node.next, node.count};
  };
  return {mapped(tree.nodes, cast), tree.triangles, cast_each<Aabb<T>>(tree.boxes)};
}

template struct AabbTree<float>;
template struct AabbTree<double>;
template AabbTree<float> aabb_tree_cast(const AabbTree<double>&);
template AabbTree<double> aabb_tree_cast(const AabbTree<double>&);

}  // namespace contactscope
