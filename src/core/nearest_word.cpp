#include "core/nearest_word.h"

#include <algorithm>
#include <sstream>

namespace contactscope {
namespace {

/// Number of edits from `a` to `b`: a letter changed, added or removed, or two neighbours swapped
/// (Damerau 1964, each letter edited at most once). Both words are short.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> edits(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) edits[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) edits[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t changed = edits[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      edits[i][j] = std::min({edits[i - 1][j] + 1, edits[i][j - 1] + 1, changed});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        edits[i][j] = std::min(edits[i][j], edits[i - 2][j - 2] + 1);
    }
  }
  return edits[a.size()][b.size()];
}

/// Words here, each with those of other programs and of everyday language for it.
constexpr std::string_view kMeanings = R"(
contacts: contact_points collisions manifolds
normals: contact_normals
shapes: bodies objects geometry wireframe
bounds: aabbs
broad_phase: broadphase
loads: forces
float: single float32
double: float64
box: cube cuboid
sphere: ball
hull: convex polyhedron
mesh: trimesh triangle_mesh
plane: half_space
sdf: distance_field
half_extents: extents half_size half_sizes
quat_wxyz: quaternion orientation rotation
pairs: contacts collisions
position: origin translation location
rotation: orientation
triangles: faces indices
vertices: points
restitution: bounciness elasticity
friction: mu
dt: timestep time_step
angular_velocity: omega
velocity: linear_velocity
substeps: sub_steps
fov_degrees: fov
eye: camera
overlap: penetration depth
separation: depth distance
points: count
--out: -o --output --outdir --output-dir
--jobs: -j --threads
--quiet: -q
--verbose: -v
--version: -V
--format: -f
--size: --resolution
--frames: --frame
--target: --look-at
--eye: --position
--camera: --camera-position
render: draw
lint: validate
versus: compare
shrink: minimize reduce
)";

/// In lower case, without underscores; options, such as -v and -V, as they are.
std::string folded(std::string_view word) {
  if (word.starts_with('-')) return std::string(word);
  std::string text;
  for (const char c : word)
    if (c != '_') text += static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  return text;
}

/// The word here that has this meaning, of those in `candidates`. `word` is folded.
std::string meant_by(const std::string& word, const std::vector<std::string_view>& candidates) {
  std::istringstream lines{std::string(kMeanings)};
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string here;
    std::getline(words, here, ':');
    if (std::ranges::find(candidates, here) == candidates.end()) continue;
    for (std::string other; words >> other;)
      if (folded(other) == word) return here;
  }
  return {};
}

}  // namespace

std::string nearest(std::string_view word, const std::vector<std::string_view>& candidates) {
  // Up to a third of the letters may be wrong: "half_extent" is near "half_extents", "foo" is near
  // nothing. Long words are not misspelled keys and would only cost time.
  constexpr std::size_t kLongest = 64;
  if (word.size() > kLongest) return {};
  const std::string plain = folded(word);
  for (const std::string_view candidate : candidates)
    if (folded(candidate) == plain) return std::string(candidate);
  if (const std::string here = meant_by(plain, candidates); !here.empty()) return here;
  std::string best;
  std::size_t best_distance = 0;
  for (const std::string_view candidate : candidates) {
    const std::size_t distance = edit_distance(word, candidate);
    const std::size_t allowed = std::max(word.size(), candidate.size()) / 3;
    if (distance > allowed || (!best.empty() && distance >= best_distance)) continue;
    best = candidate;
    best_distance = distance;
  }
  return best;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string_view>& candidates) {
  const std::string near = nearest(word, candidates);
  return near.empty() ? "" : "did you mean '" + near + "'? ";
}

std::string quoted_list(const std::vector<std::string_view>& words, const char* last) {
  std::string list;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) list += i + 1 == words.size() ? last : ", ";
    list.append(1, '\'').append(words[i]).append(1, '\'');
  }
  return list;
}

std::string not_among(const std::vector<std::string_view>& words, const std::string& text) {
  if (words.empty() || std::ranges::find(words, text) != words.end()) return {};
  return "is '" + text + "'; " + did_you_mean(text, words) + "it may be " +
         quoted_list(words, " or ");
}

}  // namespace contactscope
