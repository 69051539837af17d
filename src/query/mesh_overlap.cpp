#include "query/mesh_overlap.h"

namespace contactscope {

template <class S> bool TreeLayout::update(const AabbTree<S>& tree) {
  const auto same = [](const Node& kept, const typename AabbTree<S>::Node& node) {
    return kept.next == node.next && kept.count == node.count;
  };
  if (std::ranges::equal(nodes_, tree.nodes, same)) return true;
  nodes_.clear();
  for (const typename AabbTree<S>::Node& node : tree.nodes)
    nodes_.push_back({node.next, node.count, -1, 0});
  // Children come after their parent.
  for (int i = 0; i < count_of(tree.nodes); ++i) {
    if (at(tree.nodes, i).leaf()) continue;
    for (const int child : {i + 1, tree.right_of(i)}) {
      at(nodes_, child).parent = i;
      at(nodes_, child).depth = at(nodes_, i).depth + 1;
    }
  }
  return false;
}

template <class S> void MeshFront::begin(const AabbTree<S>& a, const AabbTree<S>& b) {
  const bool same_a = a_.update(a), same_b = b_.update(b);
  if (!same_a || !same_b || pairs.empty()) pairs = {{0, 0}};
  turn_ = (turn_ + 1) % kTurns;
}

std::optional<ParentPair> MeshFront::parent_of_last_child(const NodeIndices& nodes) const {
  const auto [i, j] = nodes;
  const TreeLayout::Node &a = a_.node(i), &b = b_.node(j);
  // Both trees are descended level by level until one is at a leaf: last the deeper one, or both.
  const bool a_went = a.depth >= b.depth, b_went = b.depth >= a.depth;
  if (a.depth == 0 && b.depth == 0) return std::nullopt;
  const bool last_a = !a_went || i != a.parent + 1, last_b = !b_went || j != b.parent + 1;
  if (!last_a || !last_b) return std::nullopt;
  return ParentPair{{a_went ? a.parent : i, b_went ? b.parent : j},
                    {a_went ? a.parent + 1 : i, b_went ? b.parent + 1 : j},
                    a_went && b_went ? 4 : 2};
}

namespace {

template <class S>
Triangle<S> corners_of(const std::vector<Vec3<S>>& vertices, const std::array<int, 3>& triangle) {
  return {at(vertices, triangle[0]), at(vertices, triangle[1]), at(vertices, triangle[2])};
}

/// overlaps(); in float all axes at once: lower x, y, z, upper x, against upper x, y, z, lower z.
template <class S> bool boxes_overlap(const Aabb<S>& a, const Aabb<S>& b) {
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

template <class S> class MeshTraversal {
 public:
  using Tree = AabbTree<S>;

  MeshTraversal(const Mesh<S>& a, const Mesh<S>& b, const Pose<S>& b_in_a,
                std::vector<NodePairVisit>* visits)
      : a_(a), b_(b), vertices_b_(vertices_in(b, b_in_a)), tree_b_(b.tree), visits_(visits) {
    tree_b_.refit(vertices_b_, b.triangles);
  }

  MeshOverlap<S> run(MeshFront* front) {
    if (!a_.tree.nodes.empty() && !tree_b_.nodes.empty()) {
      if (front != nullptr)
        run_from(*front);
      else
        run_from_roots();
    }
    std::ranges::sort(result_.intersections, {}, [](const MeshIntersection<S>& intersection) {
      return std::pair(intersection.a, intersection.b);
    });
    return std::move(result_);
  }

 private:
  void run_from_roots() {
    const auto visit = [this](int i, int j) {
      if (compare(i, j)) open_.push_back({i, j});
    };
    visit(0, 0);
    while (!open_.empty()) {
      const auto [i, j] = open_.back();
      open_.pop_back();
      if (at(a_.tree.nodes, i).leaf() && at(tree_b_.nodes, j).leaf())
        compare_leaves(i, j);
      else
        for_children(i, j, visit);
    }
  }

  void run_from(MeshFront& front) {
    front.begin(a_.tree, tree_b_);
    if (front.pairs.size() > 1 && !compare(0, 0)) {
      front.pairs = {{0, 0}};
      return;
    }
    std::vector<NodeIndices> before;
    before.swap(front.pairs);
    front.pairs.reserve(before.size());
    separation_ = 0;
    for (std::size_t place = 0; place < before.size(); ++place) {
      const auto [i, j] = before[place];
      if (compare(i, j)) {
        descend(i, j, front);
      } else {
        keep_separated(i, j, front);
        if (front.may_climb(place, before.size())) climb(front);
      }
    }
  }

  /// Descends below two nodes whose boxes overlap and appends to the front.
  void descend(int i, int j, MeshFront& front) {
    if (at(a_.tree.nodes, i).leaf() && at(tree_b_.nodes, j).leaf()) {
      compare_leaves(i, j);
      front.pairs.push_back({i, j});
      separation_ = 0;
      return;
    }
    for_children(i, j, [&](int child_i, int child_j) {
      if (compare(child_i, child_j))
        descend(child_i, child_j, front);
      else
        keep_separated(child_i, child_j, front);
    });
  }

  void keep_separated(int i, int j, MeshFront& front) {
    front.pairs.push_back({i, j});
    ++separation_;
  }

  /// Replaces children at the end of the front by their parents, while all of them are separated.
  void climb(MeshFront& front) {
    while (const auto parent = front.parent_of_last_child(front.pairs.back())) {
      const auto [i, j] = parent->nodes;
      if (separation_ < parent->children ||
          *(front.pairs.end() - parent->children) != parent->first_child)
        return;
      if ((i == 0 && j == 0) || compare(i, j)) return;  // the roots are known to overlap
      front.pairs.resize(front.pairs.size() - static_cast<std::size_t>(parent->children));
      separation_ -= parent->children;
      keep_separated(i, j, front);
    }
  }

  bool compare(int i, int j) {
    const bool hit = boxes_overlap(at(a_.tree.nodes, i).box, at(tree_b_.nodes, j).box);
    ++result_.counts.node_pairs;
    if (visits_ != nullptr) visits_->push_back({i, j, hit});
    return hit;
  }

  /// Visits the child pairs of two nodes, not both leaves, in order.
  template <class Visit> void for_children(int i, int j, const Visit& visit) const {
    if (at(a_.tree.nodes, i).leaf()) {
      visit(i, j + 1);
      visit(i, tree_b_.right_of(j));
    } else if (at(tree_b_.nodes, j).leaf()) {
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

  void compare_leaves(int i, int j) {
    const typename Tree::Node& a = at(a_.tree.nodes, i);
    const typename Tree::Node& b = at(tree_b_.nodes, j);
    ++result_.counts.leaf_pairs;
    for (int k = a.next; k < a.next + a.count; ++k) {
      if (!boxes_overlap(at(a_.tree.boxes, k), b.box)) continue;
      for (int l = b.next; l < b.next + b.count; ++l)
        if (boxes_overlap(at(a_.tree.boxes, k), at(tree_b_.boxes, l)))
          compare_triangles(at(a_.tree.triangles, k), at(tree_b_.triangles, l));
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
  std::vector<std::pair<int, int>> open_;  // overlapping nodes
  int separation_ = 0;  // number of consecutive separated pairs at the end of the front
  MeshOverlap<S> result_;
};

}  // namespace

template <class S> std::vector<Vec3<S>> vertices_in(const Mesh<S>& mesh, const Pose<S>& pose) {
  const Pose<double> exact = pose.template cast<double>();
  const Mat3<double> rotation = exact.rotation.toRotationMatrix();
  return mapped(mesh.vertices, [&](const Vec3<S>& vertex) -> Vec3<S> {
    const Vec3d moved = rotation * vertex.template cast<double>() + exact.position;
    return moved.cast<S>();
  });
}

template <class S>
MeshOverlap<S> mesh_overlap(const Mesh<S>& a, const Mesh<S>& b, const Pose<S>& b_in_a,
                            std::vector<NodePairVisit>* visits, MeshFront* front) {
  return MeshTraversal<S>(a, b, b_in_a, visits).run(front);
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(vertices_in, mesh_overlap);

}  // namespace contactscope
