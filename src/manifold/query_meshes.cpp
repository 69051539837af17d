#include <algorithm>

#include "core/instantiate.h"
#include "manifold/queried_pair.h"
#include "query/mesh_overlap.h"
#include "query/winding.h"

namespace contactscope {
namespace {

const char* to_word(TriangleOverlapKind kind) {
  constexpr const char* kWords[] = {"none", "touching", "proper", "coplanar"};
  return kWords[static_cast<int>(kind)];
}

/// Touching triangles share no interior point. Guigue and Devillers 2003 call an overlap proper if it
/// is not within one plane.
bool counts(TriangleOverlapKind kind, QueryComparison comparison) {
  return kind == TriangleOverlapKind::Proper ||
         (kind == TriangleOverlapKind::Coplanar && comparison != QueryComparison::Proper) ||
         (kind == TriangleOverlapKind::Touching && comparison == QueryComparison::Inclusive);
}

template <class S>
void record_intersections(const MeshOverlap<S>& found, const Pose<S>& pose_a, trace::Pair& record) {
  const ToWorld<S> to_world(pose_a);
  for (const MeshIntersection<S>& crossing : found.intersections) {
    trace::Intersection& recorded = record.intersections.emplace_back();
    const TriangleOverlap<S>& overlap = crossing.overlap;
    recorded.a = crossing.a;
    recorded.b = crossing.b;
    recorded.kind = to_word(overlap.kind);
    recorded.a_degenerate = overlap.a_degenerate;
    recorded.b_degenerate = overlap.b_degenerate;
    if (overlap.kind == TriangleOverlapKind::Coplanar) continue;
    const auto placed = [&](const Vec3<S>& point) -> Vec3d {
      return to_world.point(point).template cast<double>();
    };
    recorded.segment = {placed(overlap.segment[0]), placed(overlap.segment[1])};
  }
  record.query->trees = trace::TreeCounts{static_cast<int>(found.counts.node_pairs),
                                          static_cast<int>(found.counts.leaf_pairs),
                                          static_cast<int>(found.counts.triangle_pairs)};
}

/// For each node, the range of triangles below it, in the order of the tree.
template <class S> std::vector<std::pair<int, int>> triangles_below(const AabbTree<S>& tree) {
  std::vector<std::pair<int, int>> ranges(tree.nodes.size());  // first and count
  // Backwards, because a node's children come after it.
  for (int i = count_of(tree.nodes) - 1; i >= 0; --i) {
    const auto& node = at(tree.nodes, i);
    at(ranges, i) = node.leaf()
                        ? std::pair(node.next, node.count)
                        : std::pair(at(ranges, i + 1).first,
                                    at(ranges, i + 1).second + at(ranges, tree.right_of(i)).second);
  }
  return ranges;
}

template <class S>
std::vector<trace::NodePair> recorded_node_pairs(const AabbTree<S>& a, const AabbTree<S>& b,
                                                 const std::vector<NodePairVisit>& visits) {
  const auto below_a = triangles_below(a), below_b = triangles_below(b);
  return mapped(visits, [&](const NodePairVisit& visit) -> trace::NodePair {
    const auto [before_a, count_a] = at(below_a, visit.a);
    const auto [before_b, count_b] = at(below_b, visit.b);
    return {before_a, count_a,        before_b,
            count_b,  visit.overlaps, at(a.nodes, visit.a).leaf() && at(b.nodes, visit.b).leaf()};
  });
}

template <class S>
trace::Containment recorded_containment(Containment containment, const Mesh<S>& b) {
  switch (containment) {
    case Containment::AInB:
      return {"inside", "outside"};
    case Containment::BInA:
      return {"outside", "inside"};
    case Containment::AHasHoles:
      return {"open", open_edges(b).empty() ? "unknown" : "open"};
    case Containment::BHasHoles:
      return {"unknown", "open"};
    case Containment::Separation:
      break;
  }
  return {"outside", "outside"};
}

}  // namespace

template <class S>
Answer<S> query_meshes(const Mesh<S>& a, const Pose<S>& pose_a, const Mesh<S>& b,
                       const Pose<S>& pose_b, const Question& question, trace::Pair* record,
                       const trace::Stages& stages, MeshFront* front) {
  const Pose<S> b_in_a = relative_pose(pose_a, pose_b);
  const bool watched = record != nullptr && stages.node_pairs;
  std::vector<NodePairVisit> visits;
  const MeshOverlap<S> found = mesh_overlap(a, b, b_in_a, watched ? &visits : nullptr, front);
  Answer<S> answer;
  answer.method = QueryMethod::Triangles;
  answer.trees = found.counts;
  answer.overlap = std::ranges::any_of(found.intersections, [&](const MeshIntersection<S>& one) {
    return counts(one.overlap.kind, question.comparison);
  });
  if (record) record_intersections(found, pose_a, *record);
  if (watched) record->query->node_pairs = recorded_node_pairs(a.tree, b.tree, visits);
  if (found.overlapping()) return answer;
  const Containment containment = mesh_containment(a, b, b_in_a);
  answer.overlap = containment == Containment::AInB || containment == Containment::BInA;
  if (record) record->query->containment = recorded_containment(containment, b);
  return answer;
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(query_meshes);

}  // namespace contactscope
