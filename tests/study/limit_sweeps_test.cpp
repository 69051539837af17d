#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "study/limits_study.h"

// Every pair of shapes, driven to the limits of its numbers.
namespace contactscope {
namespace {

constexpr int kCases = 12;
constexpr std::uint64_t kSeed = 7;

/// Results of a sweep in one scalar.
struct Outcome {
  int faults[7] = {};
  int drowned_convex = 0;      // without meshes
  double deepest_drowned = 0;  // overlap, in ulps of the pair's coordinates
  int lost = 0;
  double worst_ulps = 0;
  double worst_cells = 0;   // error of the unrounded geometry, in cells of the world's coordinates
  double deepest_lost = 0;  // the same for lost overlaps
  int of = 0;

  int count(ContactFault fault) const { return faults[static_cast<int>(fault)]; }
};

template <class S> Outcome run(const LimitSweep& sweep) {
  Outcome outcome;
  for (const double value : sweep.values()) {
    for (const PairKind& kind : sweep.kinds) {
      for (int i = 0; i < kCases; ++i) {
        const StackedPair pair = limit_case(sweep, value, kind, i, kSeed);
        const PairVerdict verdict = judge_pair<S>(pair);
        ++outcome.of;
        ++outcome.faults[static_cast<int>(verdict.fault)];
        if (verdict.fault == ContactFault::Drowned) {
          outcome.drowned_convex += kind.below != Stacked::Mesh ? 1 : 0;
          const double in_ulps = verdict.overlap / verdict.error * verdict.ulps;
          outcome.deepest_drowned = std::max(outcome.deepest_drowned, in_ulps);
        }
        if (verdict.fault == ContactFault::None) {
          outcome.worst_ulps = std::max(outcome.worst_ulps, verdict.ulps);
        }
        const double epsilon = std::numeric_limits<S>::epsilon();
        const double cell = epsilon * (pair.motion.position.norm() + verdict.scale);
        if (verdict.lost) {
          ++outcome.lost;
          outcome.deepest_lost = std::max(outcome.deepest_lost, verdict.depth / cell);
        }
        outcome.worst_cells = std::max(outcome.worst_cells, verdict.unrounded_error / cell);
      }
    }
  }
  return outcome;
}

class LimitSweeps : public testing::TestWithParam<LimitSweep> {};

std::string name_of(const testing::TestParamInfo<LimitSweep>& info) { return info.param.name; }

/// Except for overlaps that are no larger than rounding.
void expect_no_wrong_answer(const Outcome& outcome) {
  EXPECT_GT(outcome.of, 500);
  EXPECT_EQ(outcome.count(ContactFault::NotFinite), 0);
  EXPECT_EQ(outcome.count(ContactFault::Missing), 0);
  EXPECT_EQ(outcome.count(ContactFault::Phantom), 0);
  EXPECT_EQ(outcome.count(ContactFault::Drifting), 0);
  EXPECT_EQ(outcome.count(ContactFault::Imprecise), 0);
  EXPECT_LE(outcome.worst_ulps, kPrecisionBound);
  EXPECT_LE(outcome.deepest_drowned, 16);
}

TEST_P(LimitSweeps, FloatIsNeverWrongAboutWhatItIsGiven) {
  const Outcome outcome = run<float>(GetParam());
  expect_no_wrong_answer(outcome);
  const std::string& name = GetParam().name;
  if (name != "tilt" && name != "scale" && name != "aspect") return;  // others go down to nothing
  EXPECT_EQ(outcome.drowned_convex, 0);
  // On a triangle of thousands of kilometres, float rounds the surface below the crate by metres.
  EXPECT_EQ(outcome.count(ContactFault::Drowned) > 0, name == "aspect");
}

TEST_P(LimitSweeps, DoubleIsNeverWrongAboutWhatItIsGiven) {
  const Outcome outcome = run<double>(GetParam());
  expect_no_wrong_answer(outcome);
  EXPECT_EQ(outcome.count(ContactFault::Drowned), 0);
}

TEST_P(LimitSweeps, ContactsAreLostOnlyWhereTheyAreNoLargerThanTheCellsOfTheirCoordinates) {
  constexpr double kCells = 16;
  const Outcome in_float = run<float>(GetParam());
  EXPECT_LE(in_float.deepest_lost, 2 * kCells);
  const Outcome in_double = run<double>(GetParam());
  EXPECT_LE(in_double.deepest_lost, 2 * kCells);
  EXPECT_LE(in_float.worst_cells, kCells);
  EXPECT_LE(in_double.worst_cells, kCells);
}

INSTANTIATE_TEST_SUITE_P(Every, LimitSweeps, testing::ValuesIn(limit_sweeps()), name_of);

TEST(LimitSweep, FloatDoesRunOutSomewhere) {
  // A sweep that never reaches this limit would prove nothing.
  EXPECT_GT(run<float>(limit_sweeps()[2]).lost, 0);  // distance
  EXPECT_GT(run<float>(limit_sweeps()[5]).lost, 0);  // kiss
}

TEST(LimitSweep, AtTheOriginAndCoincident) {
  std::mt19937_64 engine(5);
  for (const PairKind& kind : limit_sweeps()[1].kinds) {
    for (const double overlap : {0.0, 0.01, 1.0}) {
      for (int i = 0; i < 8; ++i) {
        Stacking stacking;
        stacking.overlap = overlap;
        StackedPair pair = stacked_pair(kind, stacking, i, engine);
        pair.motion = {};
        const PairVerdict in_float = judge_pair<float>(pair);
        const PairVerdict in_double = judge_pair<double>(pair);
        for (const PairVerdict& verdict : {in_float, in_double}) {
          const bool rounded_kiss = overlap == 0 && verdict.fault == ContactFault::Drowned;
          EXPECT_TRUE(verdict.fault == ContactFault::None || rounded_kiss)
              << to_string(kind) << ", overlap " << overlap << ": "
              << static_cast<int>(verdict.fault);
        }
      }
    }
  }
}

TEST(StackedPair, OverlapsByTheGivenAmount) {
  std::mt19937_64 engine(6);
  for (const LimitSweep& sweep : limit_sweeps()) {
    for (const PairKind& kind : sweep.kinds) {
      Stacking stacking;
      stacking.size = 2;
      stacking.overlap = 0;
      for (int i = 0; i < 4; ++i) {
        const StackedPair pair = stacked_pair(kind, stacking, i, engine);
        EXPECT_NEAR(pair.separation, 0, 2e-15) << to_string(kind) << ' ' << i;
      }
    }
  }
  // Spheres of 2 m: the middle between touching and coincidence is one metre.
  Stacking half;
  half.size = 2;
  half.overlap = 0.5;
  const StackedPair spheres = stacked_pair({Stacked::Sphere, Stacked::Sphere}, half, 0, engine);
  EXPECT_NEAR(spheres.separation, -1, 1e-15);
}

TEST(PairVerdict, AContactThatIsNotTheOneExpectedIsLost) {
  std::mt19937_64 engine(8);
  StackedPair pair = stacked_pair({Stacked::Box, Stacked::Box}, {}, 0, engine);
  pair.motion = {};
  EXPECT_FALSE(judge_pair<float>(pair).lost);
  pair.separation *= 3;
  EXPECT_TRUE(judge_pair<float>(pair).lost);
  // The oracle judges the scalar's numbers and ignores the expectation.
  EXPECT_EQ(judge_pair<float>(pair).fault, ContactFault::None);
}

TEST(PairVerdict, AKissFarAwayInFloatIsLostButNotWrong) {
  std::mt19937_64 engine(9);
  Stacking stacking;
  stacking.overlap = 1e-4;
  stacking.distance = 586507;
  int lost = 0;
  for (int i = 0; i < 20; ++i) {
    const StackedPair pair = stacked_pair({Stacked::Box, Stacked::Box}, stacking, 0, engine);
    const PairVerdict verdict = judge_pair<float>(pair);
    EXPECT_EQ(verdict.fault, ContactFault::None) << static_cast<int>(verdict.fault);
    lost += verdict.lost;
  }
  EXPECT_GT(lost, 10);
}

}  // namespace
}  // namespace contactscope
