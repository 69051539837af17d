#pragma once

#include <algorithm>
#include <cstdint>

#include "query/mesh_overlap.h"

namespace contactscope {

/// Whether the trees of a pair of meshes have become expensive: the node pairs that mesh_overlap()
/// compares beside those that it compared when the trees were new. Keep one for each pair.
///
/// More are also compared where the meshes come closer to each other, which no new tree would help.
/// So the count is set beside the pairs of triangles whose boxes overlap: these are the same with any
/// trees, because they are not boxes of nodes. Trees that stay as good as they are compare node pairs
/// for the way down to the triangles, and a share for each pair of them: of two spheres of 9,680
/// triangles 1.6 for each where 29,408 pairs meet, 2.1 where 2,594 do. So where g times as many pairs
/// meet as in the base, as good trees compare from min(1, g) to max(1, g) times as many node pairs.
///
/// The base is the first query since the last build, or a later one that is cheaper by both counts.
/// Where the meshes come so close or go so far apart that g is beyond 1/2 to 2, that query is the
/// next base.
class MeshQueryCost {
 public:
  enum class Verdict : std::uint8_t {
    Unknown,  // too few triangles meet, nothing to compare with, or between the two others
    AsNew,    // at most kWorstTreeCost times the least that as good trees compare
    Worse,    // more than kWorstTreeCost times the most that they compare
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

  /// How to update a tree of which queries came to this verdict. An automatic one is left to its
  /// surfaces where they say nothing.
  static TreeUpdate update_after(Verdict verdict, TreeUpdate how) {
    if (how != TreeUpdate::Auto || verdict == Verdict::Unknown) return how;
    return verdict == Verdict::Worse ? TreeUpdate::Rebuild : TreeUpdate::Refit;
  }

  /// One of the trees was built anew.
  void begin_anew() { base_ = {}; }

 private:
  static constexpr std::int64_t kFewestTrianglePairs = 64;

  MeshOverlapCounts base_;  // no pairs of triangles: there is none
};

}  // namespace contactscope
