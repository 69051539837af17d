#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/mesh.h"

namespace contactscope {

/// What another library's distance field of a mesh came to.
struct PeerField {
  std::string name;  // of the library, with its version
  double build = 0;  // milliseconds, the least of some
  double bytes = 0;
  std::vector<double> nanoseconds;  // of a query, one a repetition
  std::vector<double> distances;    // at each point, metres, negative inside
  std::vector<Vec3d> gradients;     // of them; unit where the library makes them so
};

/// Asks the program `contactscope-field-NAME`, which is built where the library is installed, and found in
/// one of `folders` or in $PATH; empty where there is none. Throws std::runtime_error of one that fails.
///
/// It reads, as words: `cells`, so many along the longest side; `band` in cells; `repetitions`; then
/// `vertices`, `triangles` and `points`, each with its number and then all numbers. It writes `name` and its
/// line, `build`, `bytes`, `nanoseconds` with their number and each, and a line a point: distance and
/// gradient.
std::optional<PeerField> run_field_peer(const std::vector<std::string>& folders,
                                        const std::string& name, const Mesh<double>& mesh,
                                        int cells, int band, int repetitions,
                                        const std::vector<Vec3d>& points);

}  // namespace contactscope
