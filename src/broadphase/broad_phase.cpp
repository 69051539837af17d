#include "broadphase/broad_phase.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <utility>

#include "core/at.h"

namespace contactscope {

// Each is defined in the file of its name.
BroadPhaseInfo brute_force_broad_phase(), grid_broad_phase(), sweep_and_prune_broad_phase(),
    octree_broad_phase(), tree_broad_phase(), columns_broad_phase();

const std::vector<BroadPhaseInfo>& broad_phases() {
  static const std::vector<BroadPhaseInfo> all = {
      brute_force_broad_phase(), grid_broad_phase(), sweep_and_prune_broad_phase(),
      octree_broad_phase(),      tree_broad_phase(), columns_broad_phase()};
  return all;
}

std::unique_ptr<BroadPhase> make_broad_phase(std::string_view name) {
  const auto found = std::ranges::find(broad_phases(), name, &BroadPhaseInfo::name);
  return found == broad_phases().end() ? nullptr : found->make();
}

bool is_bounded(const Aabb<float>& box) {
  return box.lower.minCoeff() >= -kLargestCoordinate && box.upper.maxCoeff() <= kLargestCoordinate;
}

Aabb<float> outward_box(const Aabb<double>& box) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  Aabb<float> rounded = box.cast<float>();
  for (int i = 0; i < 3; ++i) {
    if (static_cast<double>(rounded.lower[i]) > box.lower[i])
      rounded.lower[i] = std::nextafter(rounded.lower[i], -kInfinity);
    if (static_cast<double>(rounded.upper[i]) < box.upper[i])
      rounded.upper[i] = std::nextafter(rounded.upper[i], kInfinity);
  }
  return rounded;
}

namespace {

void refuse_empty(const Aabb<float>& box) {
  if (box.empty()) throw std::invalid_argument("a box of a broad phase is empty or has NaN");
}

}  // namespace

int BroadPhase::add(const Aabb<float>& box) {
  refuse_empty(box);
  int handle = handles();
  if (free_.empty()) {
    boxes_.push_back(box);
  } else {
    handle = free_.back();
    free_.pop_back();
    at(boxes_, handle) = box;
  }
  added(handle);
  return handle;
}

void BroadPhase::move(int handle, const Aabb<float>& box) {
  refuse_empty(box);
  const Aabb<float> from = at(boxes_, handle);
  at(boxes_, handle) = box;
  moved(handle, from);
}

void BroadPhase::remove(int handle) {
  removing(handle);
  at(boxes_, handle) = {};
  free_.push_back(handle);
}

void BroadPhase::compare_with_all(std::vector<int> large, BroadPhaseRecord* record) {
  std::ranges::sort(large);
  for (const int i : large) {
    for (int j = 0; j < handles(); ++j) {
      if (!has(j) || j == i) continue;
      if (j > i || !std::ranges::binary_search(large, j)) compare(i, j);
    }
  }
  if (record != nullptr) record->large = std::move(large);
}

bool BroadPhase::has(int handle) const {
  return handle >= 0 && handle < handles() && !box(handle).empty();
}

const std::vector<BoxPair>& BroadPhase::pairs(BroadPhaseRecord* record) {
  if (record != nullptr) *record = {};
  found_.clear();
  find_pairs(record);
  sorter_.sort(found_, handles());
  return found_;
}

PairChanges BroadPhase::changes() {
  const std::vector<BoxPair>& now = pairs();
  PairChanges result;
  std::ranges::set_difference(now, last_, std::back_inserter(result.begun));
  std::ranges::set_difference(last_, now, std::back_inserter(result.ended));
  last_ = now;
  return result;
}

std::vector<int> BroadPhase::query(const Aabb<float>& box) const {
  std::vector<int> found;
  find(box, found);
  std::ranges::sort(found);
  return found;
}

void BroadPhase::find(const Aabb<float>& box, std::vector<int>& found) const {
  counts_.comparisons += handles();
  for (int i = 0; i < handles(); ++i) {
    if (overlaps(at(boxes_, i), box)) found.push_back(i);
  }
}

std::size_t BroadPhase::memory() const {
  return bytes_of(boxes_) + bytes_of(free_) + bytes_of(found_) + bytes_of(last_) +
         sorter_.memory() + own_memory();
}

}  // namespace contactscope
