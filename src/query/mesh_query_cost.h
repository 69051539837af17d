#pragma once

#include "query/mesh_overlap.h"

namespace contactscope {

/// Detects if the trees of a pair of meshes have become expensive: compares the node pairs that
/// mesh_overlap() tests with those when the trees were new. Keep one instance per pair of meshes.
///
/// Node pairs also increase when meshes approach, where a rebuild would not help. So their number
/// is related to the pairs of triangles with overlapping boxes, which do not depend on the trees:
/// for two spheres of 9,680 triangles, 1.6 per pair if 29,408 pairs meet, and 2.1 if 2,594 do. If g
/// times as many pairs meet as in the base, equally good trees test min(1, g) to max(1, g) times as
/// many node pairs.
///
/// The base is the first query after the last build, or a later one that is cheaper in both counts.
/// If g leaves the range 1/2 to 2, the current query becomes the next base.
class MeshQueryCost {
 public:
  enum class Verdict : std::uint8_t {
    Unknown,  // too few triangles meet, no base yet, or neither of the others
    AsNew,    // at most kWorstTreeCost times the minimum for equally good trees
    Worse,    // more than kWorstTreeCost times the maximum for equally good trees
  };

  Verdict judge(const MeshOverlapCounts& counts) {
    if (counts.triangle_pairs < kFewestTrianglePairs) return Verdict::Unknown;
    const auto over_base = [&](std::int64_t MeshOverlapCounts::*count) {
      return static_cast<double>(counts.*count) / static_cast<double>(base_.*count);
    };
    const double growth = over_base(&MeshOverlapCounts::triangle_pairs);
    const double nodes = over_base(&MeshOverlapCounts::node_pairs);
    if (base_.triangle_pairs == 0 || growth < 0.5 || growth > 2) {
      base_ = counts;
      return Verdict::Unknown;
    }
    if (nodes < std::min(1.0, growth)) base_ = counts;
    if (nodes > kWorstTreeCost * std::max(1.0, growth)) return Verdict::Worse;
    return nodes <= kWorstTreeCost * std::min(1.0, growth) ? Verdict::AsNew : Verdict::Unknown;
  }

  /// How to update a tree next; Unknown leaves it to the tree's surface areas, if Auto.
  static TreeUpdate update_after(Verdict verdict, TreeUpdate how) {
    if (how != TreeUpdate::Auto || verdict == Verdict::Unknown) return how;
    return verdict == Verdict::Worse ? TreeUpdate::Rebuild : TreeUpdate::Refit;
  }

  /// Call this when one of the trees was rebuilt.
  void restart() { base_ = {}; }

 private:
  static constexpr std::int64_t kFewestTrianglePairs = 64;

  MeshOverlapCounts base_;  // zero triangle pairs: no base
};

}  // namespace contactscope
