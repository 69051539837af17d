#include <unordered_set>

#include "broadphase/broad_phase.h"

namespace contactscope {
namespace {

/// Mean swaps per endpoint beyond which sorting from scratch is faster.
constexpr std::int64_t kMaxSwaps = 32;

/// Sweep and prune: keeps the ends of all boxes sorted on each of the three axes, and the
/// overlapping pairs. From call to call few ends are swapped, and an insertion sort fixes the
/// order. When the lower end of one box passes the upper end of another, their overlap may begin or
/// end. A scene with large jumps is sorted from scratch.
/// Source: Baraff 1992, "Dynamic Simulation of Non-Penetrating Rigid Bodies", section 2.3; Cohen et
/// al. 1995, "I-COLLIDE".
class SweepAndPrune : public Clonable<SweepAndPrune> {
  struct End {
    float at;
    int handle;
    bool upper;

    // At equal positions lower ends come first: boxes that touch overlap.
    friend bool operator<(const End& a, const End& b) {
      return a.at < b.at || (a.at == b.at && a.upper < b.upper);
    }
  };

  void added(int handle) override { came_.push_back(handle); }

  void find_pairs(BroadPhaseRecord* record) override {
    for (const int handle : came_) {
      for (std::vector<End>& ends : axes_) {
        ends.push_back({0, handle, false});
        ends.push_back({0, handle, true});
      }
    }
    // Each new end moves past about a third of the others.
    const bool many_came = came_.size() > 4 * static_cast<std::size_t>(kMaxSwaps);
    came_.clear();
    update_ends();
    if (many_came || !restore_order(record)) sort_from_scratch();
    for (const std::uint64_t key : kept_)
      report(static_cast<int>(key >> 32), static_cast<int>(key & 0xffffffffu));
  }

  void update_ends() {
    for (int axis = 0; axis < 3; ++axis) {
      for (End& end : at(axes_, axis))
        end.at = end.upper ? box(end.handle).upper[axis] : box(end.handle).lower[axis];
    }
  }

  /// False if too much jumped; then neither order nor pairs are valid.
  bool restore_order(BroadPhaseRecord* record) {
    std::int64_t left = kMaxSwaps * static_cast<std::int64_t>(axes_[0].size());
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<End>& ends = at(axes_, axis);
      for (std::size_t i = 1; i < ends.size(); ++i) {
        const End end = ends[i];
        std::size_t k = i;
        for (; k > 0 && end < ends[k - 1]; --k) {
          pass(end, ends[k - 1], axis, record);
          ends[k] = ends[k - 1];
        }
        ends[k] = end;
        counts_.swaps += static_cast<std::int64_t>(i - k);
        left -= static_cast<std::int64_t>(i - k);
        if (left < 0) {
          if (record != nullptr) record->swaps.clear();
          return false;
        }
      }
    }
    return true;
  }

  /// `end` moves down past `other`.
  void pass(const End& end, const End& other, int axis, BroadPhaseRecord* record) {
    if (end.upper == other.upper) return;
    const std::uint64_t key = key_of(end.handle, other.handle);
    bool counts = false;
    if (end.upper) {
      counts = kept_.erase(key) > 0;
    } else {
      ++counts_.comparisons;
      counts = overlaps(box(end.handle), box(other.handle)) && kept_.insert(key).second;
    }
    if (record == nullptr) return;
    record->swaps.push_back({axis, end.at, end.upper ? other.handle : end.handle,
                             end.upper ? end.handle : other.handle, !end.upper, counts});
  }

  /// Sorts all three axes, and finds the pairs along the axis with the largest spread of ends.
  void sort_from_scratch() {
    kept_.clear();
    std::size_t longest = 0;
    double most = -1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::vector<End>& ends = axes_[axis];
      std::sort(ends.begin(), ends.end());
      double spread = ends.empty() ? 0
                                   : static_cast<double>(ends[3 * ends.size() / 4].at) -
                                         ends[ends.size() / 4].at;
      if (spread > most) {
        most = spread;
        longest = axis;
      }
    }
    std::vector<int>& open = open_;
    open.clear();
    place_.assign(static_cast<std::size_t>(handles()), -1);
    for (const End& end : axes_[longest]) {
      int& place = at(place_, end.handle);
      if (end.upper) {
        at(open, place) = open.back();
        at(place_, open.back()) = place;
        open.pop_back();
        continue;
      }
      for (const int other : open) {
        ++counts_.comparisons;
        if (overlaps(box(end.handle), box(other))) kept_.insert(key_of(end.handle, other));
      }
      place = count_of(open);
      open.push_back(end.handle);
    }
  }

  static std::uint64_t key_of(int i, int j) {
    const auto low = static_cast<std::uint64_t>(std::min(i, j));
    return low << 32 | static_cast<std::uint64_t>(std::max(i, j));
  }

  std::size_t own_memory() const override {
    std::size_t bytes = bytes_of(came_) + bytes_of(open_) + bytes_of(place_);
    for (const std::vector<End>& ends : axes_) bytes += bytes_of(ends);
    // A node has its key and a pointer; a bucket is one pointer.
    return bytes + kept_.size() * 2 * sizeof(void*) + kept_.bucket_count() * sizeof(void*);
  }

  std::vector<End> axes_[3];
  std::unordered_set<std::uint64_t> kept_;  // pairs that overlap
  std::vector<int> came_;                   // since the last call
  std::vector<int> open_, place_;           // boxes at the sweep's position, and their index there
};

}  // namespace

BroadPhaseInfo sweep_and_prune_broad_phase() {
  return info_of<SweepAndPrune>(
      "sweep_and_prune", "ends in order on three axes, pairs kept: for scenes that move little");
}

}  // namespace contactscope
