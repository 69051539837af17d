#include "query/mesh_overlap.h"

#include <algorithm>
#include <type_traits>
#include <utility>

#include "core/at.h"
#include "core/pack.h"

namespace contactscope {
namespace {

template <class S>
Triangle<S> corners_of(const std::vector<Vec3<S>>& vertices, const std::array<int, 3>& triangle) {
  return {at(vertices, triangle[0]), at(vertices, triangle[1]), at(vertices, triangle[2])};
}

/// overlaps(), for floats with all axes at once. Lanes: lower x, y, z and an upper x that is not
/// looked at, against upper x, y, z and a lower z.
template <class S>
bool boxes_overlap(const Aabb<S>& a, const Aabb<S>& b) {
  if constexpr (std::is_same_v<S, float>) {
    static_assert(sizeof(Aabb<float>) == 6 * sizeof(float));
    using Four = lanes::Pack<float>;
    const auto lower = [](const Aabb<float>& box) { return lanes::load<float>(box.lower.data()); };
    const auto upper = [](const Aabb<float>& box) {
      const Four last = lanes::load<float>(box.lower.data() + 2);
      return __builtin_shufflevector(last, last, 1, 2, 3, 0);
    };
    return (lanes::bits<float>((lower(a) <= upper(b)) & (lower(b) <= upper(a))) & 7u) == 7u;
  } else {
    return overlaps(a, b);
  }
}

template <class S>
class MeshTraversal {
 public:
  using Tree = AabbTree<S>;

  MeshTraversal(const Mesh<S>& a, const Mesh<S>& b, const Pose<S>& b_in_a,
                std::vector<NodePairVisit>* visits)
      : a_(a), b_(b), vertices_b_(vertices_in(b, b_in_a)), tree_b_(b.tree), visits_(visits) {
    tree_b_.refit(vertices_b_, b.triangles);
  }

  MeshOverlap<S> run() {
    if (!a_.tree.nodes.empty() && !tree_b_.nodes.empty()) visit(0, 0);
    while (!open_.empty()) {
      const auto [i, j] = open_.back();
      open_.pop_back();
      open(i, j);
    }
    std::ranges::sort(result_.intersections, {}, [](const MeshIntersection<S>& intersection) {
      return std::pair(intersection.a, intersection.b);
    });
    return std::move(result_);
  }

 private:
  void visit(int i, int j) {
    const bool hit = boxes_overlap(at(a_.tree.nodes, i).box, at(tree_b_.nodes, j).box);
    ++result_.counts.node_pairs;
    if (visits_ != nullptr) visits_->push_back({i, j, hit});
    if (hit) open_.push_back({i, j});
  }

  /// Two nodes whose boxes overlap.
  void open(int i, int j) {
    const typename Tree::Node& a = at(a_.tree.nodes, i);
    const typename Tree::Node& b = at(tree_b_.nodes, j);
    if (a.leaf() && b.leaf()) {
      compare_leaves(a, b);
    } else if (a.leaf()) {
      visit(i, j + 1);
      visit(i, tree_b_.right_of(j));
    } else if (b.leaf()) {
      visit(i + 1, j);
      visit(a_.tree.right_of(i), j);
    } else {
      const int right_a = a_.tree.right_of(i), right_b = tree_b_.right_of(j);
      visit(i + 1, j + 1);
      visit(i + 1, right_b);
      visit(right_a, j + 1);
      visit(right_a, right_b);
    }
  }

  void compare_leaves(const typename Tree::Node& a, const typename Tree::Node& b) {
    ++result_.counts.leaf_pairs;
    for (int k = a.next; k < a.next + a.count; ++k) {
      if (!boxes_overlap(at(a_.tree.boxes, k), b.box)) continue;
      for (int l = b.next; l < b.next + b.count; ++l) {
        if (boxes_overlap(at(a_.tree.boxes, k), at(tree_b_.boxes, l)))
          compare_triangles(at(a_.tree.triangles, k), at(tree_b_.triangles, l));
      }
    }
  }

  void compare_triangles(int a, int b) {
    ++result_.counts.triangle_pairs;
    const TriangleOverlap<S> overlap = triangle_overlap(
        corners_of(a_.vertices, at(a_.triangles, a)), corners_of(vertices_b_, at(b_.triangles, b)));
    if (overlap.kind != TriangleOverlapKind::None) result_.intersections.push_back({a, b, overlap});
  }

  const Mesh<S>& a_;
  const Mesh<S>& b_;
  std::vector<Vec3<S>> vertices_b_;  // a's frame
  Tree tree_b_;                      // a's frame
  std::vector<NodePairVisit>* visits_;
  std::vector<std::pair<int, int>> open_;  // nodes that overlap
  MeshOverlap<S> result_;
};

}  // namespace

template <class S>
std::vector<Vec3<S>> vertices_in(const Mesh<S>& mesh, const Pose<S>& pose) {
  const Pose<double> exact = pose.template cast<double>();
  const Mat3<double> rotation = exact.rotation.toRotationMatrix();
  return mapped(mesh.vertices, [&](const Vec3<S>& vertex) -> Vec3<S> {
    const Vec3d moved = rotation * vertex.template cast<double>() + exact.position;
    return moved.cast<S>();
  });
}

template <class S>
MeshOverlap<S> mesh_overlap(const Mesh<S>& a, const Mesh<S>& b, const Pose<S>& b_in_a,
                            std::vector<NodePairVisit>* visits) {
  return MeshTraversal<S>(a, b, b_in_a, visits).run();
}

template std::vector<Vec3<float>> vertices_in(const Mesh<float>&, const Pose<float>&);
template std::vector<Vec3<double>> vertices_in(const Mesh<double>&, const Pose<double>&);
template MeshOverlap<float> mesh_overlap(const Mesh<float>&, const Mesh<float>&, const Pose<float>&,
                                         std::vector<NodePairVisit>*);
template MeshOverlap<double> mesh_overlap(const Mesh<double>&, const Mesh<double>&,
                                          const Pose<double>&, std::vector<NodePairVisit>*);

}  // namespace contactscope
