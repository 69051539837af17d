#include "draw/charts/axis_history.h"

#include <array>
#include <optional>

namespace contactscope::draw {
namespace {

// The face, or the two edges, of the axis that the test chose.
std::array<int, 2> chosen_features(const trace::Sat& sat) {
  if (sat.chosen == "face_a" && sat.face_a) return {sat.face_a->face, -1};
  if (sat.chosen == "face_b" && sat.face_b) return {sat.face_b->face, -1};
  if (sat.edge) return {sat.edge->a, sat.edge->b};
  return {-1, -1};
}

}  // namespace

std::string axis_of(const trace::Pair& pair) {
  if (pair.sat) return pair.sat->chosen;
  return pair.cache && pair.cache->hit ? pair.cache->axis : std::string();
}

std::vector<AxisMoment> axis_history(const std::vector<const trace::Pair*>& pairs) {
  std::vector<AxisMoment> history(pairs.size());
  std::string last;
  std::optional<std::array<int, 2>> last_features;
  for (std::size_t f = 0; f < pairs.size(); ++f) {
    if (pairs[f] == nullptr || axis_of(*pairs[f]).empty()) continue;
    history[f] = {pairs[f], axis_of(*pairs[f]), false};
    std::optional<std::array<int, 2>> features;
    if (pairs[f]->sat) features = chosen_features(*pairs[f]->sat);
    const bool other_axis = !last.empty() && history[f].axis != last;
    history[f].switched =
        other_axis || (!last.empty() && features && last_features && *features != *last_features);
    if (features || other_axis) last_features = features;
    last = history[f].axis;
  }
  return history;
}

}  // namespace contactscope::draw
