#include "lint/wrong_pairs.h"

#include <cmath>

namespace contactscope::lint {
namespace {

/// Pairs kept individually. With the distinct later ones they take some megabytes.
constexpr std::size_t kWhole = 4000;
constexpr std::size_t kMax = 2 * kWhole;
/// Depths within this factor are the same.
constexpr double kSameDepth = 1.05;

/// Key of everything that is reported of a pair, except its position in the trace.
std::string signature_of(const WrongPair& pair) {
  std::string signature = pair.explained_by.to_string();
  signature += pair.severe ? '#' : pair.gross ? '!' : '.';
  signature += std::to_string(static_cast<int>(pair.problem.kind));
  if (pair.deeper != 0) {
    signature += pair.deeper > 0 ? '+' : '-';
    signature +=
        std::to_string(std::lround(std::log(std::abs(pair.deeper)) / std::log(kSameDepth)));
  }
  return signature;
}

}  // namespace

void WrongPairs::add(WrongPair pair, bool individually) {
  ++count_;
  std::string signature;
  if (kept_.size() >= kWhole && !individually) {
    if (places_.empty())
      for (std::size_t i = 0; i < kept_.size(); ++i) places_.emplace(signature_of(kept_[i]), i);
    signature = signature_of(pair);
    const auto known = places_.find(signature);
    // With thousands of distinct errors their exact frequencies do not matter.
    if (known != places_.end() || kept_.size() >= kMax) {
      ++kept_[known != places_.end() ? known->second : kept_.size() - 1].times;
      return;
    }
    places_.emplace(std::move(signature), kept_.size());
  }
  kept_.push_back(std::move(pair));
}

int WrongPairs::untold() const {
  int count = 0;
  for (const WrongPair& pair : kept_) count += pair.record ? 0 : pair.times;
  return count;
}

}  // namespace contactscope::lint
