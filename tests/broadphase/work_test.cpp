// Work grows as each broad phase claims; it is counted, not timed.

#include <gtest/gtest.h>

#include <cmath>

#include "broadphase/broad_phase.h"
#include "broadphase/random_boxes.h"

namespace contactscope {
namespace {

using testing::RandomBoxes;
using testing::Spread;

/// Boxes of about unit size; each meets seven others, whatever their number.
std::vector<Aabb<float>> scene(int count) {
  RandomBoxes random(Spread::Uniform, std::cbrt(0.48f * static_cast<float>(count)), 3);
  std::vector<Aabb<float>> boxes;
  for (int i = 0; i < count; ++i) boxes.push_back(random.box());
  return boxes;
}

std::int64_t work_of(const BroadPhase& phase) {
  return phase.counts().comparisons + phase.counts().visits + phase.counts().swaps;
}

/// Exponent of the number of boxes in the growth of the work to find all pairs.
double growth(const std::string& name, bool moving) {
  std::int64_t work[2];
  const int counts[2] = {2000, 16000};
  for (int i = 0; i < 2; ++i) {
    const auto phase = make_broad_phase(name);
    for (const Aabb<float>& box : scene(counts[i])) phase->add(box);
    phase->pairs();
    if (moving) {
      const std::int64_t before = work_of(*phase);
      RandomBoxes random(Spread::Uniform, 1, 9);
      for (int handle = 0; handle < phase->handles(); ++handle) {
        const Vec3<float> by = random.vector(-1e-4f, 1e-4f);
        phase->move(handle, {phase->box(handle).lower + by, phase->box(handle).upper + by});
      }
      phase->pairs();
      work[i] = work_of(*phase) - before;
    } else {
      work[i] = work_of(*phase);
    }
  }
  return std::log(static_cast<double>(work[1]) / static_cast<double>(work[0])) / std::log(8.0);
}

TEST(BroadPhaseWork, SlowGrowsWithTheSquareByBruteForceOnly) {
  EXPECT_NEAR(growth("brute_force", false), 2, 0.01);
  EXPECT_LT(growth("grid", false), 1.1);
  EXPECT_LT(growth("octree", false), 1.25) << "n log n, and nodes that reach over each other";
  EXPECT_LT(growth("tree", false), 1.25);
  EXPECT_LT(growth("columns", false), 1.5) << "a column is as long as the scene";
}

TEST(BroadPhaseWork, SweepAndPruneDoesLittleIfLittleMoves) {
  // Ends in a cube of n boxes are n^(2/3) times as dense: as many more pass in the same movement.
  EXPECT_LT(growth("sweep_and_prune", true), 5.0 / 3 + 0.1);
  const auto phase = make_broad_phase("sweep_and_prune");
  for (const Aabb<float>& box : scene(2000)) phase->add(box);
  phase->pairs();
  const std::int64_t first = work_of(*phase);
  phase->pairs();
  EXPECT_EQ(work_of(*phase), first) << "nothing moved";
  for (int handle = 0; handle < phase->handles(); ++handle) {
    const Vec3<float> by = Vec3<float>::Constant(handle % 2 == 0 ? 1e-4f : -1e-4f);
    phase->move(handle, {phase->box(handle).lower + by, phase->box(handle).upper + by});
  }
  phase->pairs();
  EXPECT_LT(work_of(*phase) - first, first / 20);
}

TEST(BroadPhaseWork, ATreeDoesNoneIfBoxesStayInTheirMargins) {
  const auto phase = make_broad_phase("tree");
  for (const Aabb<float>& box : scene(1000)) phase->add(box);
  const std::int64_t before = phase->counts().visits;
  for (int handle = 0; handle < phase->handles(); ++handle) {
    const Vec3<float> by = Vec3<float>::Constant(0.01f);
    phase->move(handle, {phase->box(handle).lower + by, phase->box(handle).upper + by});
  }
  EXPECT_EQ(phase->counts().visits, before);
}

}  // namespace
}  // namespace contactscope
