#include "broadphase/box_pair.h"

#include <algorithm>
#include <numeric>

#include "core/at.h"

namespace contactscope {

void PairSorter::sort(std::vector<BoxPair>& pairs, int handles) {
  if (count_of(pairs) < handles / 4) {
    std::ranges::sort(pairs);
    return;
  }
  // Counting sort by b, then a stable one by a. Neither has unpredictable branches.
  const auto numbers = static_cast<std::size_t>(handles) + 1;
  first_of_a_.assign(numbers, 0);
  first_of_b_.assign(numbers, 0);
  for (const BoxPair& pair : pairs) {
    ++at(first_of_a_, pair.a + 1);
    ++at(first_of_b_, pair.b + 1);
  }
  std::partial_sum(first_of_a_.begin(), first_of_a_.end(), first_of_a_.begin());
  std::partial_sum(first_of_b_.begin(), first_of_b_.end(), first_of_b_.begin());
  by_b_.resize(pairs.size());
  for (const BoxPair& pair : pairs) at(by_b_, at(first_of_b_, pair.b)++) = pair;
  for (const BoxPair& pair : by_b_) at(pairs, at(first_of_a_, pair.a)++) = pair;
}

std::size_t PairSorter::memory() const {
  return sizeof(int) * (first_of_a_.capacity() + first_of_b_.capacity()) +
         sizeof(BoxPair) * by_b_.capacity();
}

}  // namespace contactscope
