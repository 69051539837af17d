#pragma once

#include "broadphase/broad_phase.h"
#include "study/study.h"

namespace contactscope {

/// Finds overlapping pairs of many boxes, step by step: one of ours or another library's.
class PairFinder {
 public:
  virtual ~PairFinder() = default;
  /// Moves box i to boxes[i]. The first call adds all boxes and lists them in `moved`; later calls
  /// have as many boxes, and those not in `moved` are unchanged.
  virtual void place(std::span<const Aabb<float>> boxes, std::span<const int> moved) = 0;
  /// Adds each pair once to the empty `found`, in any order; pairs may only nearly overlap.
  virtual void find(std::vector<BoxPair>& found) = 0;
  /// Since creation; 0 if not counted.
  virtual std::int64_t comparisons() const { return 0; }
  /// Bytes in use; 0 if unknown.
  virtual std::size_t memory() const { return 0; }
};

struct PairFinderInfo {
  std::string name;
  int most_boxes;           // more would take minutes
  int most_of_mixed_sizes;  // likewise, for sizes over three decades
  std::function<std::unique_ptr<PairFinder>()> make;
};

std::vector<PairFinderInfo> own_pair_finders();

/// The study `broad_phase` with these finders, measured in turn, and ascending numbers of boxes.
std::vector<trace::Study> study_pair_finders(const std::vector<PairFinderInfo>& finders,
                                             std::span<const int> numbers_of_boxes,
                                             const StudyOptions& options,
                                             const StudyProgress& progress);

}  // namespace contactscope
