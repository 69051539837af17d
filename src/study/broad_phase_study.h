#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "broadphase/broad_phase.h"
#include "study/study.h"

namespace contactscope {

/// Finds the pairs of many boxes that overlap, step by step: one of ours, or another library's.
class PairFinder {
 public:
  virtual ~PairFinder() = default;
  /// Box i is at boxes[i] now. The first call, where `moved` names all of them, adds them; later
  /// ones have as many boxes, and those that `moved` does not name are where they were.
  virtual void place(std::span<const Aabb<float>> boxes, std::span<const int> moved) = 0;
  /// Adds each pair once to `found`, which is empty, in any order. Beyond those that overlap there may
  /// be some that nearly do.
  virtual void find(std::vector<BoxPair>& found) = 0;
  /// Since it was made; 0 where it does not count.
  virtual std::int64_t comparisons() const { return 0; }
  /// Bytes that it holds; 0 where it does not know.
  virtual std::size_t memory() const { return 0; }
};

struct PairFinderInfo {
  std::string name;
  int most_boxes;           // of more it would take minutes
  int most_of_mixed_sizes;  // likewise, of sizes over three decades
  std::function<std::unique_ptr<PairFinder>()> make;
};

/// The broad phases of this project.
std::vector<PairFinderInfo> own_pair_finders();

/// The study `broad_phase` with these finders, which take turns, and these numbers of boxes, ascending.
std::vector<trace::Study> study_pair_finders(const std::vector<PairFinderInfo>& finders,
                                             std::span<const int> numbers_of_boxes,
                                             const StudyOptions& options,
                                             const StudyProgress& progress);

}  // namespace contactscope
