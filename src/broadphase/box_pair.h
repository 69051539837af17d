#pragma once

#include <compare>
#include <cstddef>
#include <vector>

namespace contactscope {

/// Two boxes of a broad phase, by their handles; a < b.
struct BoxPair {
  int a = 0;
  int b = 0;
  friend auto operator<=>(const BoxPair&, const BoxPair&) = default;
};

/// Sorts the pairs of one step. It keeps its lists, which are as long as the pairs are many: to ask the
/// system for them in each step takes longer than to sort.
class PairSorter {
 public:
  /// Sorts pairs of different handles below `handles` ascending, in time linear in both counts where
  /// that is faster than comparing.
  void sort(std::vector<BoxPair>& pairs, int handles);

  std::size_t memory() const;

 private:
  std::vector<int> first_of_a_, first_of_b_;  // where the pairs of a handle begin
  std::vector<BoxPair> by_b_;
};

}  // namespace contactscope
