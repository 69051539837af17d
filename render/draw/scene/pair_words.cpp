#include "draw/scene/pair_words.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace contactscope::draw {
namespace {

constexpr double kMarginal = 0.05;  // share of the size of the support

}  // namespace

PairState state_of(const trace::Pair& pair, double touching) {
  const auto has_points = [](const trace::Manifold& manifold) { return !manifold.points.empty(); };
  // A pair with points is not separated, whatever an engine's trace says: titles count its points.
  if (pair.state == "separated" && std::ranges::none_of(pair.manifolds, has_points))
    return pair.separation < 0 ? PairState::Skipped : PairState::Separation;
  return pair.separation > touching ? PairState::WithinMargin : PairState::Touching;
}

std::string spell_state(PairState state) {
  switch (state) {
    case PairState::Separation:
      return "apart";
    case PairState::WithinMargin:
      return "within the margin";
    case PairState::Touching:
      return "touching";
    case PairState::Skipped:
      break;
  }
  return "overlap, contact skipped";
}

const char* gap_or_overlap(double separation) { return separation > 0 ? "gap" : "overlap"; }

std::string spell_separation(double separation, double noise, const LengthUnit& unit) {
  return std::string(gap_or_overlap(separation)) + " " +
         spell_length(std::abs(separation), noise, unit);
}

std::string spell_axis(const std::string& axis) {
  if (axis == "face_a") return "face of A";
  if (axis == "face_b") return "face of B";
  if (axis == "edge_edge") return "edges of A and B";
  if (axis == "closest_points") return "closest points";
  return axis;
}

std::string spell_features(const std::string& type) {
  const std::size_t dash = type.find('-');
  if (dash == std::string::npos) return type;
  return type.substr(0, dash) + " on " + type.substr(dash + 1);
}

std::string in_words(std::string_view code) {
  // Phrases where the code alone is not clear enough.
  constexpr std::pair<std::string_view, std::string_view> kPhrases[] = {
      {"optimal", "best area"},
      {"optimal_deepest", "best area with the deepest"},
      {"area_deepest", "area, the deepest first"}};
  constexpr std::pair<std::string_view, std::string_view> kNames[] = {
      {"gjk", "GJK"},     {"epa", "EPA"},       {"mpr", "MPR"},     {"sat", "SAT"},
      {"aabb", "AABB"},   {"obb", "OBB"},       {"bvh", "BVH"},     {"sdf", "SDF"},
      {"ode", "ODE"},     {"mjx", "MJX"},       {"jolt", "Jolt"},   {"bullet", "Bullet"},
      {"physx", "PhysX"}, {"newton", "Newton"}, {"dart", "DART"},   {"mujoco", "MuJoCo"},
      {"box3d", "Box3D"}, {"rapier", "Rapier"}, {"parry", "Parry"}, {"fcl", "FCL"}};
  for (const auto& [phrase, words] : kPhrases)
    if (code == phrase) return std::string(words);
  std::string text;
  while (!code.empty()) {
    const std::size_t end = std::min(code.find_first_of("_ "), code.size());
    std::string_view word = code.substr(0, end);
    for (const auto& [known, name] : kNames)
      if (word == known) word = name;
    text += word;
    if (end < code.size()) text += ' ';
    code.remove_prefix(std::min(end + 1, code.size()));
  }
  return text;
}

Balance balance_of(const trace::Stability& stability) {
  if (stability.verdict == "no contact") return Balance::NoContact;
  if (stability.verdict != "stable") return Balance::Unstable;
  double reach = 0;
  for (const Vec3d& corner : stability.support)
    reach = std::max(reach, (corner - stability.support.front()).norm());
  return stability.margin < kMarginal * reach ? Balance::Marginal : Balance::Stable;
}

std::string spell_balance(Balance balance) {
  switch (balance) {
    case Balance::Stable:
      return "stable";
    case Balance::Marginal:
      return "marginal";
    case Balance::Unstable:
      return "unstable";
    case Balance::NoContact:
      break;
  }
  return "no contact";
}

}  // namespace contactscope::draw
