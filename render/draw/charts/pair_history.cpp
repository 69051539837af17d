#include "draw/charts/pair_history.h"

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <string_view>

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

const trace::Pair* first_pair(const trace::Frame& frame, bool (*holds)(const trace::Pair&)) {
  const auto found = std::ranges::find_if(frame.pairs, holds);
  return found == frame.pairs.end() ? nullptr : &*found;
}

std::vector<const trace::Pair*> distinct_pairs(const std::vector<trace::Frame>& frames,
                                               bool (*holds)(const trace::Pair&)) {
  std::set<std::array<std::string_view, 3>> known;
  std::vector<const trace::Pair*> pairs;
  for (const trace::Frame& frame : frames) {
    for (const trace::Pair& pair : frame.pairs) {
      if (holds(pair) && known.insert({pair.a, pair.b, pair.label}).second) pairs.push_back(&pair);
    }
  }
  return pairs;
}

std::vector<const trace::Pair*> pair_history(const std::vector<trace::Frame>& frames,
                                             const trace::Pair& wanted) {
  std::vector<const trace::Pair*> history;
  const auto is_wanted = [&](const trace::Pair& pair) {
    return pair.a == wanted.a && pair.b == wanted.b && pair.label == wanted.label;
  };
  std::size_t usual = 0;  // where it was: mostly each frame has all in the same order
  for (const trace::Frame& frame : frames) {
    const std::vector<trace::Pair>& pairs = frame.pairs;
    if (usual >= pairs.size() || !is_wanted(pairs[usual]))
      usual = static_cast<std::size_t>(std::ranges::find_if(pairs, is_wanted) - pairs.begin());
    history.push_back(usual < pairs.size() ? &pairs[usual] : nullptr);
  }
  return history;
}

std::string pair_name(const trace::Pair& pair) {
  return pair.label.empty() ? pair.a + ", " + pair.b : pair.label;
}

std::string axis_of(const trace::Pair& pair) {
  if (pair.sat) return pair.sat->chosen;
  return pair.cache && pair.cache->hit ? pair.cache->axis : std::string();
}

std::vector<AxisMoment> axis_history(const std::vector<const trace::Pair*>& pairs) {
  std::vector<AxisMoment> history;
  std::string last;
  std::optional<std::array<int, 2>> last_features;
  for (const trace::Pair* pair : pairs) {
    AxisMoment& moment = history.emplace_back();
    if (pair == nullptr || axis_of(*pair).empty()) continue;
    std::optional<std::array<int, 2>> features;
    if (pair->sat) features = chosen_features(*pair->sat);
    moment = {pair, axis_of(*pair), false};
    const bool other_axis = !last.empty() && moment.axis != last;
    moment.switched =
        other_axis || (!last.empty() && features && last_features && *features != *last_features);
    if (features || other_axis) last_features = features;
    last = moment.axis;
  }
  return history;
}

}  // namespace contactscope::draw
