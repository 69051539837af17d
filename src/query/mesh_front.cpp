#include "query/mesh_front.h"

#include <algorithm>

namespace contactscope {

template <class S>
bool TreeLayout::update(const AabbTree<S>& tree) {
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

template <class S>
void MeshFront::begin(const AabbTree<S>& a, const AabbTree<S>& b) {
  const bool same_a = a_.update(a), same_b = b_.update(b);
  if (!same_a || !same_b || pairs.empty()) pairs = {{0, 0}};
  turn_ = (turn_ + 1) % kTurns;
}

std::optional<ParentPair> MeshFront::parent_of_last_child(const NodeIndices& nodes) const {
  const auto [i, j] = nodes;
  const TreeLayout::Node &a = a_.node(i), &b = b_.node(j);
  // Both trees are descended level by level until one is at a leaf: the deeper node descended last,
  // or both did.
  const bool a_went = a.depth >= b.depth, b_went = b.depth >= a.depth;
  if (a.depth == 0 && b.depth == 0) return std::nullopt;
  const bool last_a = !a_went || i != a.parent + 1, last_b = !b_went || j != b.parent + 1;
  if (!last_a || !last_b) return std::nullopt;
  return ParentPair{{a_went ? a.parent : i, b_went ? b.parent : j},
                    {a_went ? a.parent + 1 : i, b_went ? b.parent + 1 : j},
                    a_went && b_went ? 4 : 2};
}

template bool TreeLayout::update(const AabbTree<float>&);
template bool TreeLayout::update(const AabbTree<double>&);
template void MeshFront::begin(const AabbTree<float>&, const AabbTree<float>&);
template void MeshFront::begin(const AabbTree<double>&, const AabbTree<double>&);

}  // namespace contactscope
