#include "bench/overlap_pairs.h"

namespace contactscope::bench {

std::vector<std::pair<std::string, OverlapPass>> peer_passes(const std::vector<BoxPair>&) {
  return {};
}

}  // namespace contactscope::bench
