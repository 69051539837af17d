#include "broadphase/broad_phase.h"

namespace contactscope {
namespace {

using Cell = std::array<std::int32_t, 3>;

/// Boxes that cover more cells are compared with all others instead.
constexpr std::int64_t kMaxCells = 64;
/// Cell size over the median of the boxes' largest sides. With 1, a box of that size is in up to
/// eight cells; larger cells contain more boxes that do not meet.
constexpr float kCellOfMedian = 1.5f;

/// A uniform grid without bounds, with its cells in a hash table: for boxes of similar size. Cells
/// are sized by the boxes and made again in each call.
///
/// A pair is reported only in the cell that contains the lowest corner of its overlap. Boxes far
/// larger than a cell, or infinite, are compared with all.
/// Source: Teschner et al. 2003, "Optimized Spatial Hashing for Collision Detection of Deformable
/// Objects".
class Grid : public Clonable<Grid> {
  struct Entry {
    Cell cell;
    int handle;
  };

  void find_pairs(BroadPhaseRecord* record) override {
    choose_cells();
    sort_into_cells();
    if (record != nullptr) report_cells(*record);
    for (std::size_t bucket = 0; bucket + 1 < first_.size(); ++bucket) {
      for (int i = first_[bucket]; i < first_[bucket + 1]; ++i) {
        for (int j = i + 1; j < first_[bucket + 1]; ++j)
          compare_in_cell(at(sorted_, i), at(sorted_, j));
      }
    }
    compare_with_all(large_, record);
  }

  /// Cells by bucket, and in a bucket in order of appearance.
  void report_cells(BroadPhaseRecord& record) const {
    for (std::size_t bucket = 0; bucket + 1 < first_.size(); ++bucket) {
      const auto begin = record.cells.size();
      std::vector<Cell> cells;
      for (int i = first_[bucket]; i < first_[bucket + 1]; ++i) {
        const Cell& cell = at(sorted_, i).cell;
        const auto found = std::ranges::find(cells, cell);
        if (found == cells.end()) {
          const Vec3<float> lower = cell_ * Vec3<int>(cell[0], cell[1], cell[2]).cast<float>();
          record.cells.push_back({.box = {lower, lower + Vec3<float>::Constant(cell_)}});
        }
        BroadPhaseCell& recorded =
            record.cells[begin + static_cast<std::size_t>(found - cells.begin())];
        recorded.tests += recorded.members++;
        if (found == cells.end()) cells.push_back(cell);
      }
    }
  }

  void choose_cells() {
    sides_.clear();
    for (int i = 0; i < handles(); ++i)
      if (is_bounded(box(i))) sides_.push_back(box(i).extent().maxCoeff());
    cell_ = 1;
    if (sides_.empty()) return;
    const auto middle = sides_.begin() + static_cast<std::ptrdiff_t>(sides_.size() / 2);
    std::nth_element(sides_.begin(), middle, sides_.end());
    // If most boxes are points, any size works, as long as the cells of the others can be counted.
    const float largest = *std::max_element(middle, sides_.end());
    cell_ = std::max({kCellOfMedian * *middle, largest / 1024, 1e-30f});
  }

  /// False if a coordinate has no cell index.
  bool cell_at(const Vec3<float>& point, Cell& cell) const {
    for (int axis = 0; axis < 3; ++axis) {
      const float number = std::floor(point[axis] / cell_);
      if (!(std::abs(number) < 1e9f)) return false;
      cell[static_cast<std::size_t>(axis)] = static_cast<std::int32_t>(number);
    }
    return true;
  }

  void sort_into_cells() {
    entries_.clear();
    large_.clear();
    for (int i = 0; i < handles(); ++i) {
      Cell lower{}, upper{};
      std::int64_t cells = kMaxCells + 1;
      if (is_bounded(box(i)) && cell_at(box(i).lower, lower) && cell_at(box(i).upper, upper)) {
        cells = 1;
        for (std::size_t axis = 0; axis < 3 && cells <= kMaxCells; ++axis)
          cells *= std::int64_t{upper[axis]} - lower[axis] + 1;
      }
      if (cells > kMaxCells) {
        large_.push_back(i);
        continue;
      }
      for (std::int32_t x = lower[0]; x <= upper[0]; ++x) {
        for (std::int32_t y = lower[1]; y <= upper[1]; ++y)
          for (std::int32_t z = lower[2]; z <= upper[2]; ++z) entries_.push_back({{x, y, z}, i});
      }
    }
    counts_.visits += static_cast<std::int64_t>(entries_.size());

    // Counting sort by bucket: entries of one bucket are adjacent.
    std::size_t buckets = 1;
    while (buckets < entries_.size()) buckets *= 2;
    first_.assign(buckets + 1, 0);
    const auto bucket_of = [&](const Cell& cell) {
      const auto part = [&](std::size_t axis, std::uint32_t prime) {
        return static_cast<std::uint32_t>(cell[axis]) * prime;
      };
      std::uint32_t hash = part(0, 73856093u) ^ part(1, 19349663u) ^ part(2, 83492791u);
      hash ^= hash >> 15;
      return static_cast<std::size_t>(hash) & (buckets - 1);
    };
    for (const Entry& entry : entries_) ++first_[bucket_of(entry.cell) + 1];
    for (std::size_t b = 1; b <= buckets; ++b) first_[b] += first_[b - 1];
    sorted_.resize(entries_.size());
    std::vector<int>& next = next_;
    next = first_;
    for (const Entry& entry : entries_) at(sorted_, next[bucket_of(entry.cell)]++) = entry;
  }

  void compare_in_cell(const Entry& i, const Entry& j) {
    if (i.cell != j.cell) return;  // different cells in one bucket
    ++counts_.comparisons;
    const Aabb<float>&a = box(i.handle), &b = box(j.handle);
    Cell home{};
    if (!overlaps(a, b) || !cell_at(a.lower.cwiseMax(b.lower), home) || home != i.cell) return;
    report(i.handle, j.handle);
  }

  std::size_t own_memory() const override {
    return bytes_of(sides_) + bytes_of(entries_) + bytes_of(sorted_) + bytes_of(first_) +
           bytes_of(next_) + bytes_of(large_);
  }

  float cell_ = 1;  // metres
  std::vector<float> sides_;
  std::vector<Entry> entries_, sorted_;
  std::vector<int> first_, next_;  // first entry of each bucket
  std::vector<int> large_;         // ascending
};

}  // namespace

BroadPhaseInfo grid_broad_phase() {
  return info_of<Grid>("grid",
                       "a uniform grid, its cells in a hash table: for boxes of similar size");
}

}  // namespace contactscope
