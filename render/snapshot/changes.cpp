#include "snapshot/changes.h"

#include <cstddef>

namespace contactscope::snapshot {

void Changes::vertices(const std::vector<Vec3d>& expected, const std::vector<Vec3d>& actual) {
  if (expected.size() != actual.size()) {
    add(std::to_string(expected.size()) + " -> " + std::to_string(actual.size()) + " vertices");
    return;
  }
  std::size_t moved = 0, farthest = 0;
  double distance = -1;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (same(expected[i], actual[i], tolerance_.length)) continue;
    ++moved;
    const double d = (actual[i] - expected[i]).norm();
    // One that is no number outranks every distance.
    if (d <= distance || std::isnan(distance)) continue;
    distance = d;
    farthest = i;
  }
  if (moved == 0) return;
  add("vertex " + std::to_string(farthest) + " " +
      spell_move(expected[farthest], actual[farthest]));
  if (moved > 1) add(std::to_string(moved - 1) + " more moved");
}

}  // namespace contactscope::snapshot
