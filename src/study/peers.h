#pragma once

#include "study/random_cases.h"

/// Results of other libraries, by programs of their own.
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

/// Results for another library's distance field of a mesh.
struct PeerField {
  std::string name;  // of the library, with version
  double build = 0;  // milliseconds, the minimum
  double bytes = 0;
  std::vector<double> nanoseconds;  // per query, one per repetition
  std::vector<double> distances;    // at each point, metres, negative inside
  std::vector<Vec3d> gradients;     // at each point; unit if the library normalises them
};

/// Runs the program `contactscope-field-NAME`, which is built if the library is installed, from one
/// of `folders` or $PATH; empty if there is none. Throws std::runtime_error if it fails.
///
/// Its input, as words: `cells`, the number along the longest side; `band` in cells; `repetitions`;
/// then `vertices`, `triangles` and `points`, each with its count and all numbers. Its output:
/// `name` and a line of text, `build`, `bytes`, `nanoseconds` with their count and values, and a
/// line per point: distance and gradient.
std::optional<PeerField> run_field_peer(const std::vector<std::string>& folders,
                                        const std::string& name, const Mesh<double>& mesh,
                                        int cells, int band, int repetitions,
                                        const std::vector<Vec3d>& points);

}  // namespace contactscope
