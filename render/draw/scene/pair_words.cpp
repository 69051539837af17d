#include "draw/scene/pair_words.h"

#include <algorithm>
#include <cmath>

#include "draw/scene/quantity.h"

namespace contactscope::draw {
namespace {

constexpr double kMarginal = 0.05;  // of how far the corners of the support are apart

}  // namespace

PairState state_of(const trace::Pair& pair, double touching) {
  if (pair.state == "separated") return pair.separation < 0 ? PairState::Skipped : PairState::Apart;
  return pair.separation > touching ? PairState::WithinMargin : PairState::Touching;
}

std::string spell_state(PairState state) {
  switch (state) {
    case PairState::Apart:
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

const char* gap_or_overlap(double separation) {
  return separation > 0 ? "gap" : "overlap";
}

std::string spell_separation(double separation, double noise) {
  return std::string(gap_or_overlap(separation)) + " " + spell_length(std::abs(separation), noise);
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

std::string in_words(std::string code) {
  for (const char* name : {"gjk", "epa", "mpr", "sat", "aabb", "obb"}) {
    if (code != name) continue;
    std::ranges::transform(code, code.begin(),
                           [](char c) { return static_cast<char>(c - 'a' + 'A'); });
    return code;
  }
  std::ranges::replace(code, '_', ' ');
  return code;
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
