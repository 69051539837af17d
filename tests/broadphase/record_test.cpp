#include <algorithm>
#include <numeric>

#include <gmock/gmock.h>

#include "broadphase/broad_phase.h"
#include "broadphase/random_boxes.h"

namespace contactscope {
namespace {

using testing::RandomBoxes;
using testing::Spread;

class RecordedBroadPhase : public ::testing::TestWithParam<std::string> {
 protected:
  RecordedBroadPhase() {
    RandomBoxes random(Spread::Clustered, 20, 4);
    for (int i = 0; i < 400; ++i) phase_->add(random.box());
    phase_->add({Vec3<float>::Constant(-testing::kInfinity), Vec3<float>(1, 0, 1)});
  }

  std::unique_ptr<BroadPhase> phase_ = make_broad_phase(GetParam());
};

INSTANTIATE_TEST_SUITE_P(BroadPhases, RecordedBroadPhase,
                         ::testing::Values("brute_force", "grid", "sweep_and_prune", "octree",
                                           "tree", "columns"),
                         [](const auto& tested) { return tested.param; });

TEST_P(RecordedBroadPhase, WatchingChangesNeitherPairsNorCounts) {
  const std::unique_ptr<BroadPhase> unwatched = phase_->clone();
  BroadPhaseRecord record;
  for (int step = 0; step < 3; ++step) {
    RandomBoxes random(Spread::Uniform, 1, 7);
    for (int handle = 0; handle < 400; ++handle) {
      const Vec3<float> by = random.vector(-0.05f, 0.05f);
      const Aabb<float> box = {phase_->box(handle).lower + by, phase_->box(handle).upper + by};
      phase_->move(handle, box);
      unwatched->move(handle, box);
    }
    EXPECT_EQ(phase_->pairs(&record), unwatched->pairs());
    EXPECT_EQ(phase_->counts().comparisons, unwatched->counts().comparisons);
    EXPECT_EQ(phase_->counts().visits, unwatched->counts().visits);
  }
}

TEST_P(RecordedBroadPhase, EveryBoxIsInACellThatHoldsIt) {
  BroadPhaseRecord record;
  phase_->pairs(&record);
  if (GetParam() == "brute_force" || GetParam() == "sweep_and_prune") {
    EXPECT_TRUE(record.cells.empty()) << "they have none";
    return;
  }
  int members = 0;
  for (const BroadPhaseCell& cell : record.cells) members += cell.members;
  EXPECT_GE(members + static_cast<int>(record.large.size()), 401);
  for (int handle = 0; handle < phase_->handles(); ++handle) {
    const bool in_cell = std::ranges::any_of(record.cells, [&](const BroadPhaseCell& cell) {
      return cell.members > 0 && overlaps(cell.box, phase_->box(handle));
    });
    EXPECT_TRUE(in_cell || std::ranges::binary_search(record.large, handle)) << handle;
  }
  if (GetParam() != "columns") EXPECT_THAT(record.large, ::testing::Contains(400)) << "without end";
}

TEST_P(RecordedBroadPhase, TestsOfCellsAddUpToWhatWasCompared) {
  BroadPhaseRecord record;
  const std::int64_t before = phase_->counts().comparisons;
  phase_->pairs(&record);
  const std::int64_t compared = phase_->counts().comparisons - before;
  std::int64_t tests = 0;
  for (const BroadPhaseCell& cell : record.cells) tests += cell.tests;
  const auto large = static_cast<std::int64_t>(record.large.size());
  const std::int64_t with_large = large * (400 - (large - 1)) + large * (large - 1) / 2;
  if (GetParam() == "columns") EXPECT_EQ(tests, compared);
  if (GetParam() == "octree" || GetParam() == "grid") EXPECT_EQ(tests + with_large, compared);
  // A test of two nodes counts for each of them; for two leaves a comparison follows.
  if (GetParam() == "tree") EXPECT_GE(tests, 2 * (compared - with_large));
}

TEST(ColumnsRecord, TheAxisOfLargestSpreadIsSwept) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto phase = make_broad_phase("columns");
    for (int i = 0; i < 10; ++i) {
      Vec3<float> at = Vec3<float>::Constant(0.1f * static_cast<float>(i));
      at[axis] = static_cast<float>(i);
      phase->add({at, at + Vec3<float>::Ones()});
    }
    BroadPhaseRecord record;
    phase->pairs(&record);
    EXPECT_EQ(record.swept, axis);
  }
}

TEST(SweepAndPruneRecord, SwapsThatCountAreThePairsThatBeginAndEnd) {
  const auto phase = make_broad_phase("sweep_and_prune");
  RandomBoxes random(Spread::Uniform, 6, 3);
  for (int i = 0; i < 100; ++i) phase->add(random.box());
  phase->pairs();
  std::vector<BoxPair> last = phase->pairs();
  int swaps = 0;
  for (int step = 0; step < 20; ++step) {
    for (int handle = 0; handle < 100; ++handle) {
      const Vec3<float> by = random.vector(-0.05f, 0.05f);
      phase->move(handle, {phase->box(handle).lower + by, phase->box(handle).upper + by});
    }
    BroadPhaseRecord record;
    const std::vector<BoxPair> now = phase->pairs(&record);
    // A pair may begin by one swap and end by another of the same step: only odd numbers count.
    std::vector<BoxPair> odd;
    for (const EndSwap& swap : record.swaps) {
      EXPECT_EQ(swap.meets,
                phase->box(swap.lower).lower[swap.axis] <= phase->box(swap.upper).upper[swap.axis]);
      if (!swap.counts) continue;
      const BoxPair pair{std::min(swap.lower, swap.upper), std::max(swap.lower, swap.upper)};
      const auto found = std::ranges::find(odd, pair);
      if (found == odd.end())
        odd.push_back(pair);
      else
        odd.erase(found);
    }
    std::ranges::sort(odd);
    std::vector<BoxPair> changed;
    std::ranges::set_symmetric_difference(last, now, std::back_inserter(changed));
    EXPECT_EQ(odd, changed);
    swaps += static_cast<int>(record.swaps.size());
    last = now;
  }
  EXPECT_GT(swaps, 100);
}

}  // namespace
}  // namespace contactscope
