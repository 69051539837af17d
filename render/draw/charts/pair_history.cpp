#include "draw/charts/pair_history.h"

#include <algorithm>
#include <string>

namespace contactscope::draw {

bool same_pair(const trace::Pair& one, const trace::Pair& other) {
  return one.a == other.a && one.b == other.b && one.label == other.label;
}

std::vector<const trace::Pair*> pair_history(const std::vector<trace::Frame>& frames,
                                             const trace::Pair& wanted) {
  std::vector<const trace::Pair*> history;
  std::size_t usual = 0;  // where it was: mostly each frame has all in the same order
  for (const trace::Frame& frame : frames) {
    const std::vector<trace::Pair>& pairs = frame.pairs;
    if (usual >= pairs.size() || !same_pair(pairs[usual], wanted)) {
      const auto found = std::ranges::find_if(
          pairs, [&](const trace::Pair& pair) { return same_pair(pair, wanted); });
      usual = static_cast<std::size_t>(found - pairs.begin());
    }
    history.push_back(usual < pairs.size() ? &pairs[usual] : nullptr);
  }
  return history;
}

std::string pair_name(const trace::Pair& pair) {
  return pair.label.empty() ? pair.a + ", " + pair.b : pair.label;
}

}  // namespace contactscope::draw
