#pragma once

#include "geometry/mesh.h"

namespace contactscope {

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
