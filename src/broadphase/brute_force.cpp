#include "broadphase/broad_phase.h"

namespace contactscope {
namespace {

/// The reference: compares every box with every other one, n (n - 1) / 2 comparisons.
class BruteForce : public Clonable<BruteForce> {
  void find_pairs(BroadPhaseRecord* /*record*/) override {
    for (int i = 0; i < handles(); ++i) {
      for (int j = i + 1; has(i) && j < handles(); ++j) {
        if (has(j)) compare(i, j);
      }
    }
  }
};

}  // namespace

BroadPhaseInfo brute_force_broad_phase() {
  return info_of<BruteForce>("brute_force", "every box with every other one");
}

}  // namespace contactscope
