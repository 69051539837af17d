#include "broadphase/sort_pairs.h"

#include <algorithm>

#include "core/at.h"

namespace contactscope {
namespace {

/// A stable counting sort by one handle of the pairs.
void sort_by(int BoxPair::*handle, const std::vector<BoxPair>& from, std::vector<int>& first,
             std::vector<BoxPair>& to) {
  std::ranges::fill(first, 0);
  for (const BoxPair& pair : from) ++at(first, pair.*handle + 1);
  for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
  for (const BoxPair& pair : from) at(to, at(first, pair.*handle)++) = pair;
}

}  // namespace

void sort_pairs(std::vector<BoxPair>& pairs, int handles) {
  if (count_of(pairs) < handles / 4) {
    std::ranges::sort(pairs);
    return;
  }
  std::vector<BoxPair> by_b(pairs.size());
  std::vector<int> first(static_cast<std::size_t>(handles) + 1);
  sort_by(&BoxPair::b, pairs, first, by_b);
  sort_by(&BoxPair::a, by_b, first, pairs);
}

}  // namespace contactscope
