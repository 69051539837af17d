#include "broadphase/box_pair.h"

#include <algorithm>

#include "core/at.h"

namespace contactscope {
namespace {

/// Most lists are a few numbers long.
void sort_short(int* begin, int* end) {
  constexpr int kShort = 24;
  if (end - begin > kShort) {
    std::sort(begin, end);
    return;
  }
  for (int* i = begin; i != end; ++i) {
    const int value = *i;
    int* place = i;
    for (; place != begin && place[-1] > value; --place) *place = place[-1];
    *place = value;
  }
}

}  // namespace

void PairSorter::sort(std::vector<BoxPair>& pairs, int handles) {
  if (count_of(pairs) < handles / 4) {
    std::ranges::sort(pairs);
    return;
  }
  // A counting sort by a. What is left are as many short lists as there are boxes.
  first_.assign(static_cast<std::size_t>(handles) + 2, 0);
  for (const BoxPair& pair : pairs) ++at(first_, pair.a + 2);
  for (std::size_t i = 2; i < first_.size(); ++i) first_[i] += first_[i - 1];
  others_.resize(pairs.size());
  for (const BoxPair& pair : pairs) at(others_, at(first_, pair.a + 1)++) = pair.b;

  BoxPair* next = pairs.data();
  for (int a = 0; a < handles; ++a) {
    int* const begin = others_.data() + at(first_, a);
    int* const end = others_.data() + at(first_, a + 1);
    sort_short(begin, end);
    for (const int* b = begin; b != end; ++b) *next++ = {a, *b};
  }
}

std::size_t PairSorter::memory() const {
  return sizeof(int) * (first_.capacity() + others_.capacity());
}

}  // namespace contactscope
