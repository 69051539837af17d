#include "broadphase/broad_phase.h"

namespace contactscope {
namespace {

using Lanes = lanes::Widest<float>;
constexpr int kLanes = lanes::kLanesOf<float, Lanes>;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

constexpr int kEnough = 256;    // boxes in a column: halving it would copy more than it saves
constexpr int kSample = 32;     // boxes sampled to choose the border
constexpr int kMaxAcross = 12;  // of them across the border: with more, halves share too much
constexpr int kDeepest = 48;

/// Finds all pairs from scratch, at the processor's full speed. Sorts boxes along one axis, and
/// divides them on the other two into columns, which keep that order. A box on a border is in both
/// columns. In a column each box is compared with those that begin before it ends, several at a
/// time. Nothing is kept between calls, so any movement costs the same. A pair in several columns
/// is reported in the one that contains the lowest corner of its overlap.
/// Source: Zomorodian and Edelsbrunner 2002, "Fast Software for Box Intersections".
class Columns : public Clonable<Columns> {
  /// A box with its axes in processing order: the first one is swept.
  struct Entry {
    float lower[3];
    float upper[3];
    int handle;

    float middle(int axis) const {
      return 0.5f * std::max(lower[axis], -kLargestCoordinate) +
             0.5f * std::min(upper[axis], kLargestCoordinate);
    }
  };
  /// Reports pairs whose overlap's lowest corner is at or beyond `lower`, and below `upper`, on the
  /// second and third axis.
  struct Region {
    float lower[3] = {-kInfinity, -kInfinity, -kInfinity};
    float upper[3] = {kInfinity, kInfinity, kInfinity};
  };

  void find_pairs(BroadPhaseRecord* record) override {
    record_ = record;
    gather();
    if (record_ != nullptr) record_->swept = axes_[0];
    divide(0, keys_.size(), Region(), 0);
    record_ = nullptr;
  }

  /// Collects all boxes in the order of their lower ends on the swept axis.
  void gather() {
    const std::array<int, 3> axes = axes_ = axes_by_spread();
    keys_.clear();
    for (int i = 0; i < handles(); ++i) keys_.push_back({sortable(box(i).lower[axes[0]]), i});
    sort_keys();
    if (entries_.size() < keys_.size()) entries_.resize(3 * keys_.size());
    for (std::size_t k = 0; k < keys_.size(); ++k) {
      const Aabb<float>& from = box(keys_[k].handle);
      Entry& entry = entries_[k];
      for (int i = 0; i < 3; ++i) {
        entry.lower[i] = from.lower[axes[static_cast<std::size_t>(i)]];
        entry.upper[i] = from.upper[axes[static_cast<std::size_t>(i)]];
      }
      entry.handle = keys_[k].handle;
    }
  }

  /// Axes by spread of the boxes' middles, largest first: the sweep separates most pairs.
  std::array<int, 3> axes_by_spread() const {
    Vec3<double> sum = Vec3<double>::Zero(), squares = Vec3<double>::Zero();
    double count = 0;
    const int step = std::max(1, handles() / 1024);
    for (int i = 0; i < handles(); i += step) {
      if (!is_bounded(box(i))) continue;
      const Vec3<double> middle = box(i).center().cast<double>();
      sum += middle;
      squares += middle.cwiseProduct(middle);
      ++count;
    }
    const Vec3<double> spread = count * squares - sum.cwiseProduct(sum);
    std::array<int, 3> axes = {0, 1, 2};
    std::ranges::stable_sort(axes, std::greater<>(), [&](int axis) { return spread[axis]; });
    return axes;
  }

  struct Key {
    std::uint32_t key;
    int handle;
  };

  /// An integer that sorts like the number.
  static std::uint32_t sortable(float number) {
    const auto whole = std::bit_cast<std::uint32_t>(number + 0.0f);  // -0 is 0
    return whole & 0x80000000u ? ~whole : whole | 0x80000000u;
  }

  /// Radix sort in three passes, lowest digits first.
  void sort_keys() {
    constexpr int kBits = 11;
    constexpr std::uint32_t kDigit = (1u << kBits) - 1;
    sorted_keys_.resize(keys_.size());
    for (int shift = 0; shift < 32; shift += kBits) {
      std::array<int, kDigit + 2> first{};
      for (const Key& key : keys_) ++first[(key.key >> shift & kDigit) + 1];
      for (std::size_t d = 1; d < first.size(); ++d) first[d] += first[d - 1];
      for (const Key& key : keys_) at(sorted_keys_, first[key.key >> shift & kDigit]++) = key;
      keys_.swap(sorted_keys_);
    }
  }

  /// Divides the entries from `begin` on. Its halves go behind `end`, the end of all entries.
  void divide(std::size_t begin, std::size_t end, const Region& region, int depth) {
    ++counts_.visits;
    int axis = 0;
    float border = 0;
    const std::size_t count = end - begin;
    if (count <= kEnough || depth == kDeepest || !choose_border(begin, end, axis, border)) {
      sweep(begin, end, region);
      return;
    }
    if (entries_.size() < end + 2 * count) entries_.resize(2 * (end + 2 * count));
    const Entry* const from = entries_.data() + begin;
    Entry* const below = entries_.data() + end;
    Entry* const above = below + count;
    std::size_t below_count = 0, above_count = 0;
    for (std::size_t i = 0; i < count; ++i) {
      // No branch, which would be unpredictable.
      below[below_count] = from[i];
      above[above_count] = from[i];
      below_count += from[i].lower[axis] < border;
      above_count += from[i].upper[axis] >= border;
    }
    std::move(above, above + above_count, below + below_count);
    const std::size_t middle = end + below_count;
    Region half = region;
    half.lower[axis] = border;
    divide(middle, middle + above_count, half, depth + 1);
    half = region;
    half.upper[axis] = border;
    divide(end, middle, half, depth + 1);
  }

  /// False if the halves would share too many boxes.
  bool choose_border(std::size_t begin, std::size_t end, int& axis, float& border) const {
    int least_across = kMaxAcross;
    for (const int candidate : {1, 2}) {
      std::array<float, kSample> middles;
      const auto entry = [&](int i) -> const Entry& {
        return entries_[begin + (end - begin) * static_cast<std::size_t>(i) / kSample];
      };
      for (int i = 0; i < kSample; ++i) at(middles, i) = entry(i).middle(candidate);
      std::nth_element(middles.begin(), middles.begin() + kSample / 2, middles.end());
      const float middle = middles[kSample / 2];
      int across = 0, below = 0;
      for (int i = 0; i < kSample; ++i) {
        across += entry(i).lower[candidate] < middle && entry(i).upper[candidate] >= middle;
        below += entry(i).lower[candidate] < middle;
      }
      if (across >= least_across || below == 0) continue;
      least_across = across;
      axis = candidate;
      border = middle;
    }
    return axis != 0;
  }

  /// Indices of two boxes of a column that overlap.
  struct Hit {
    int first, second;
  };

  void sweep(std::size_t begin, std::size_t end, const Region& region) {
    const int count = static_cast<int>(end - begin);
    const Entry* const entries = entries_.data() + begin;
    // One array per coordinate, padded by NaN, which compares like a box that begins after all end.
    constexpr int kSides = 5;
    const auto stride = static_cast<std::size_t>(count + kLanes);
    sides_.resize(kSides * stride);
    float* const begins = sides_.data();
    float* const lower_y = begins + stride;
    float* const upper_y = lower_y + stride;
    float* const lower_z = upper_y + stride;
    float* const upper_z = lower_z + stride;
    for (int i = 0; i < count; ++i) {
      const Entry& entry = entries[i];
      begins[i] = entry.lower[0];
      lower_y[i] = entry.lower[1];
      upper_y[i] = entry.upper[1];
      lower_z[i] = entry.lower[2];
      upper_z[i] = entry.upper[2];
    }
    std::fill_n(begins + count, kLanes, std::numeric_limits<float>::quiet_NaN());

    std::int64_t compared = 0;
    std::size_t hits = 0;
    const auto load = [](const float* from) { return lanes::load_pack<Lanes>(from); };
    for (int i = 0; i < count; ++i) {
      if (hits_.size() < hits + stride) hits_.resize(2 * (hits + stride));
      const Entry& entry = entries[i];
      // The lowest corner of the overlap is the larger of both lower corners.
      const float least_y = entry.lower[1] >= region.lower[1] ? -kInfinity : region.lower[1];
      const float least_z = entry.lower[2] >= region.lower[2] ? -kInfinity : region.lower[2];
      int j = i + 1;
      std::uint32_t before_bits = 0;
      do {
        const auto before_it_ends = load(begins + j) <= entry.upper[0];
        const auto from_y = load(lower_y + j), from_z = load(lower_z + j);
        const auto meets = before_it_ends & (from_y <= entry.upper[1]) & (from_y >= least_y) &
                           (from_z <= entry.upper[2]) & (from_z >= least_z) &
                           (load(upper_y + j) >= entry.lower[1]) &
                           (load(upper_z + j) >= entry.lower[2]);
        // Write each, keep few: which of them meet is unpredictable.
        const std::uint32_t meets_bits = lanes::bits<float>(meets);
        for (int lane = 0; lane < kLanes; ++lane) {
          hits_[hits] = {i, j + lane};
          hits += meets_bits >> lane & 1;
        }
        before_bits = lanes::bits<float>(before_it_ends);
        j += kLanes;
      } while (before_bits == (1u << kLanes) - 1);
      // The lanes that begin before it ends come first.
      compared += j - kLanes - i - 1 + std::popcount(before_bits);
    }
    for (std::size_t k = 0; k < hits; ++k)
      report(entries[hits_[k].first].handle, entries[hits_[k].second].handle);
    counts_.comparisons += compared;
    if (record_ != nullptr) report_region(region, count, compared);
  }

  void report_region(const Region& region, int members, std::int64_t tests) {
    BroadPhaseCell& cell = record_->cells.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      cell.box.lower[axes_[i]] = region.lower[i];
      cell.box.upper[axes_[i]] = region.upper[i];
    }
    cell.members = members;
    cell.tests = static_cast<int>(tests);
  }

  std::size_t own_memory() const override {
    return bytes_of(keys_) + bytes_of(sorted_keys_) + bytes_of(entries_) + bytes_of(sides_) +
           bytes_of(hits_);
  }

  std::array<int, 3> axes_{};
  BroadPhaseRecord* record_ = nullptr;  // of the current step
  std::vector<Key> keys_, sorted_keys_;
  std::vector<Entry> entries_;  // all, then those of the columns being divided
  std::vector<float> sides_;    // of one column
  std::vector<Hit> hits_;       // in it, with room for one more box
};

}  // namespace

BroadPhaseInfo columns_broad_phase() {
  return info_of<Columns>(
      "columns", "columns sorted along one axis, made anew each time: the fastest for all pairs");
}

}  // namespace contactscope
