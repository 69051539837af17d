// Every broad phase finds the same pairs as brute force, after any changes of its boxes.

#include "broadphase/broad_phase.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "broadphase/random_boxes.h"
#include "support/cases.h"

namespace contactscope {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using testing::kInfinity;
using testing::RandomBoxes;
using testing::Spread;

Aabb<float> cube(float x, float y, float z, float half = 0.5f) {
  const Vec3<float> center(x, y, z), reach = Vec3<float>::Constant(half);
  return {center - reach, center + reach};
}

class EveryBroadPhase : public ::testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<BroadPhase> phase_ = make_broad_phase(GetParam());
};

INSTANTIATE_TEST_SUITE_P(BroadPhases, EveryBroadPhase, ::testing::ValuesIn([] {
                           std::vector<std::string> names;
                           for (const BroadPhaseInfo& phase : broad_phases())
                             names.push_back(phase.name);
                           return names;
                         }()),
                         [](const auto& tested) { return tested.param; });

/// Compares every pair of boxes by the definition of overlap.
std::vector<BoxPair> pairs_by_definition(const BroadPhase& phase) {
  std::vector<BoxPair> pairs;
  for (int a = 0; a < phase.handles(); ++a) {
    for (int b = a + 1; b < phase.handles(); ++b) {
      const Aabb<float>&first = phase.box(a), &second = phase.box(b);
      bool meet = true;
      for (int axis = 0; axis < 3; ++axis) {
        meet = meet && std::max(first.lower[axis], second.lower[axis]) <=
                           std::min(first.upper[axis], second.upper[axis]);
      }
      if (meet) pairs.push_back({a, b});
    }
  }
  return pairs;
}

/// Random operations on one broad phase; all its results are compared every few operations.
void live(BroadPhase& phase, Spread spread, int rounds, std::uint32_t seed) {
  RandomBoxes random(spread, seed % 3 == 0 ? 3.0f : 12.0f, seed);
  for (int round = 0; round < rounds; ++round) {
    const int operations = round == 0 ? 150 : random.below(50);
    for (int k = 0; k < operations; ++k) {
      const int what = random.below(10);
      if (phase.handles() < 5 || what < 2) {
        phase.add(random.odd_box(phase.handles() == 0 ? random.box() : phase.box(0)));
        continue;
      }
      const int chosen = random.below(phase.handles());
      Aabb<float> box = phase.box(chosen);
      if (what < 6) {  // somewhere else
        box = random.odd_box(box);
      } else {  // a little, and sometimes enlarged
        const Vec3<float> by = random.vector(-0.1f, 0.1f);
        box.lower += by;
        box.upper += by;
        if (what == 9) box.upper += Vec3<float>::Constant(random.between(0, 3));
      }
      phase.move(chosen, box);
    }
    const std::vector<BoxPair> pairs = pairs_by_definition(phase);
    ASSERT_EQ(phase.pairs(), pairs) << "round " << round << ", seed " << seed;
  }
}

TEST_P(EveryBroadPhase, FindsThePairsOfBruteForceAfterAnyOperations) {
  for (std::uint32_t seed = 0; seed < 6; ++seed) {
    for (const Spread spread : {Spread::Uniform, Spread::Clustered, Spread::Lattice}) {
      live(*make_broad_phase(GetParam()), spread, 15, seed);
      if (HasFatalFailure()) return;
    }
  }
}

TEST_P(EveryBroadPhase, SlowFindsThePairsOfBruteForceAfterAMillionOperations) {
  for (std::uint32_t seed = 100; seed < 170; ++seed) {
    for (const Spread spread : {Spread::Uniform, Spread::Clustered, Spread::Lattice}) {
      live(*make_broad_phase(GetParam()), spread, 32, seed);
      if (HasFatalFailure()) return;
    }
  }
}

TEST_P(EveryBroadPhase, AgreesOnScenesOfThousands) {
  for (const Spread spread : {Spread::Uniform, Spread::Clustered, Spread::Lattice}) {
    RandomBoxes random(spread, 14, 5);
    for (int i = 0; i < test::cases(1500); ++i) phase_->add(random.box());
    EXPECT_EQ(phase_->pairs(), pairs_by_definition(*phase_));
    for (int i = 0; i < phase_->handles(); ++i) phase_->move(i, random.box());
    EXPECT_EQ(phase_->pairs(), pairs_by_definition(*phase_)) << "all teleported";
  }
}

TEST_P(EveryBroadPhase, IsEmptyAtFirst) {
  EXPECT_THAT(phase_->pairs(), IsEmpty());
  EXPECT_EQ(phase_->handles(), 0);
}

TEST_P(EveryBroadPhase, BoxesThatTouchOverlap) {
  phase_->add(cube(0, 0, 0));
  phase_->add(cube(1, 0, 0));               // a face
  phase_->add(cube(1, 1, 1));               // a corner of the first
  phase_->add(cube(2.0f + 2.4e-7f, 0, 0));  // an ulp away from the second
  EXPECT_THAT(phase_->pairs(), ElementsAre(BoxPair{0, 1}, BoxPair{0, 2}, BoxPair{1, 2}));
}

TEST_P(EveryBroadPhase, FindsTheSamePairsAtEveryScale) {
  for (const float scale : {1e-4f, 1.0f, 1e4f}) {
    const auto phase = make_broad_phase(GetParam());
    RandomBoxes random(Spread::Uniform, 8, 11);
    for (int i = 0; i < 300; ++i) {
      const Aabb<float> box = random.box();
      phase->add({scale * box.lower, scale * box.upper});
    }
    EXPECT_EQ(phase->pairs(), pairs_by_definition(*phase)) << scale;
  }
}

TEST_P(EveryBroadPhase, AllBoxesEqualAreAllPairs) {
  for (int i = 0; i < 100; ++i) phase_->add(cube(3, 3, 3));
  EXPECT_EQ(phase_->pairs().size(), 100u * 99u / 2u);
  const Vec3<float> point(1, 2, 3);
  for (int i = 0; i < 100; ++i) phase_->move(i, {point, point});
  EXPECT_EQ(phase_->pairs().size(), 100u * 99u / 2u) << "points at one place";
}

TEST_P(EveryBroadPhase, APlaneMeetsWhatReachesIntoIt) {
  const int floor = phase_->add({Vec3<float>::Constant(-kInfinity), {kInfinity, 0, kInfinity}});
  const int on = phase_->add(cube(1e6f, 0.5f, -1e6f));
  const int above = phase_->add(cube(0, 0.6f, 0));
  const int wall = phase_->add({{5, -kInfinity, -kInfinity}, Vec3<float>::Constant(kInfinity)});
  EXPECT_THAT(phase_->pairs(),
              ElementsAre(BoxPair{floor, on}, BoxPair{floor, wall}, BoxPair{on, wall}));
  phase_->move(above, cube(0, 0.4f, 0));
  EXPECT_THAT(phase_->pairs(), ::testing::Contains(BoxPair{floor, above}));
  phase_->move(floor, cube(0, -1e5f, 0));
  EXPECT_THAT(phase_->pairs(), ElementsAre(BoxPair{on, wall}));
}

TEST_P(EveryBroadPhase, RefusesNanAndEmptyBoxesAndStaysAsItWas) {
  const int only = phase_->add(cube(0, 0, 0));
  Aabb<float> broken = cube(0, 0, 0);
  broken.upper.y() = std::numeric_limits<float>::quiet_NaN();
  const Aabb<float> inverted{{1, 1, 1}, {0, 2, 2}};
  for (const Aabb<float>& bad : {broken, inverted, Aabb<float>()}) {
    EXPECT_THROW(phase_->add(bad), std::invalid_argument);
    EXPECT_THROW(phase_->move(only, bad), std::invalid_argument);
  }
  EXPECT_EQ(phase_->box(only), cube(0, 0, 0));
  EXPECT_EQ(phase_->handles(), 1);
}

TEST_P(EveryBroadPhase, ReportsItsMemory) {
  const std::size_t empty = phase_->memory();
  RandomBoxes random(Spread::Uniform, 10, 1);
  for (int i = 0; i < 1000; ++i) phase_->add(random.box());
  phase_->pairs();
  EXPECT_GE(phase_->memory(), empty + 1000 * sizeof(Aabb<float>));
}

TEST(BroadPhases, HaveDifferentNamesAndNoneIsUnknown) {
  std::set<std::string> names;
  for (const BroadPhaseInfo& info : broad_phases()) {
    EXPECT_TRUE(names.insert(info.name).second);
    EXPECT_FALSE(info.summary.empty());
    EXPECT_NE(make_broad_phase(info.name), nullptr);
  }
  EXPECT_EQ(make_broad_phase("bruteforce"), nullptr);
}

TEST(OutwardBox, HoldsTheBoxAndIsTheSmallestThatDoes) {
  const Aabb<double> exact{{0.1, -0.1, 1e4 + 1e-5}, {0.3, 0.25, 2e4 + 1e-5}};
  const Aabb<float> rounded = outward_box(exact);
  EXPECT_TRUE(rounded.cast<double>().contains(exact));
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_GT(static_cast<double>(std::nextafter(rounded.lower[axis], kInfinity)),
              exact.lower[axis]);
    EXPECT_LT(static_cast<double>(std::nextafter(rounded.upper[axis], -kInfinity)),
              exact.upper[axis]);
  }
  EXPECT_EQ(rounded.upper.y(), 0.25f) << "a number that float has stays";
}

}  // namespace
}  // namespace contactscope
