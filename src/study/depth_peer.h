#pragma once

#include "core/vec3.h"
#include "study/random_cases.h"

namespace contactscope {

/// Depth and normal of one pair by another library; the depth is negative if it finds none.
struct PeerDepth {
  double depth = -1;             // metres
  Vec3d normal = Vec3d::Zero();  // from A to B, in A's frame
};

/// Results of one method of another library.
struct DepthPeer {
  std::string name;                 // "Bullet, EPA"
  std::vector<double> nanoseconds;  // per pair, one per repetition
  std::vector<PeerDepth> found;     // one per pair
};

/// Runs the program `contactscope-depth-peers`, which is built if Bullet and libccd are installed,
/// from one of `folders` or $PATH; empty if there is none. Throws std::runtime_error if it fails.
///
/// Peers have absolute tolerances, so each pair is scaled to a size of 1 m, and the depths back.
/// Input, as words: `repetitions` and `pairs` with their numbers; then for each pair the vertices of
/// A and of B in A's frame, each with their count. Output: for each method `name` and a line of
/// text, `nanoseconds` with their count and values, and a line per pair: depth and normal.
std::vector<DepthPeer> run_depth_peers(const std::vector<std::string>& folders,
                                       const std::vector<OverlappingHulls>& pairs, int repetitions);

}  // namespace contactscope
