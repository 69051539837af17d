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

/// Sorts the pairs of one step. Keeps its lists, which are as long as the pairs: allocating them in
/// each step takes longer than sorting.
class PairSorter {
 public:
  /// Sorts pairs of different handles below `handles` ascending, in time linear in both counts if
  /// that is faster than comparing.
  void sort(std::vector<BoxPair>& pairs, int handles);

  std::size_t memory() const;

 private:
  std::vector<int> first_of_a_, first_of_b_;  // index of the first pair of a handle
  std::vector<BoxPair> by_b_;
};

}  // namespace contactscope
