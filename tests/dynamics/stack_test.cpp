#include <cmath>
#include <optional>

#include <gtest/gtest.h>

#include "dynamics/scene.h"
#include "geometry/hull_builder.h"

namespace contactscope::test {
namespace {

/// Boxes on a plane, each overlapping the one below by `overlap`, and each 2 cm narrower: with
/// coincident edges, every rounding would change the names of their crossings.
template <class S>
Scene<S> stack(const std::vector<double>& masses, PositionCorrection correction,
               double overlap = 0.001) {
  Scene<S> scene;
  scene.settings.position_correction = correction;
  scene.settings.slop = overlap;
  // A similar number of sweeps for each method.
  const bool soft = correction == PositionCorrection::Soft;
  scene.settings.substeps = soft ? 4 : 1;
  scene.settings.iterations = soft ? 3 : 30;
  scene.add_plane();
  double height = 0.5, half = 0.5;
  for (const double mass : masses) {
    height -= overlap;
    scene.add_box({half, 0.5, half}, at(0, height, 0), mass);
    height += 1;
    half -= 0.01;
  }
  return scene;
}

struct Case {
  const char* name;
  PositionCorrection correction;
};
std::ostream& operator<<(std::ostream& out, const Case& one) { return out << one.name; }

class Stack : public ::testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Corrections, Stack,
                         ::testing::Values(Case{"Baumgarte", PositionCorrection::Baumgarte},
                                           Case{"Projection", PositionCorrection::Projection},
                                           Case{"Soft", PositionCorrection::Soft}),
                         [](const ::testing::TestParamInfo<Case>& test) {
                           return std::string(test.param.name);
                         });

template <class S>
void expect_loads_are_weights(const std::vector<double>& masses, PositionCorrection correction,
                              double tolerance) {
  Scene<S> scene = stack<S>(masses, correction);
  scene.advance(600);
  double above = 0;
  for (int box = static_cast<int>(masses.size()); box > 0; --box) {
    above += masses[static_cast<std::size_t>(box - 1)];
    const double weight = above * kGravity;
    EXPECT_NEAR(scene.load(box - 1, box) / double(scene.dt), weight, tolerance * weight)
        << "below box " << box;
  }
}

TEST_P(Stack, SlowEachBoxCarriesTheWeightOfAllAbove) {
  expect_loads_are_weights<double>({5, 4, 3, 2, 1}, GetParam().correction, 1e-6);
  expect_loads_are_weights<float>({5, 4, 3, 2, 1}, GetParam().correction, 1e-3);
}

// Light under heavy is the worst case of sequential impulses; sub-steps help more than sweeps.
TEST(MassRatio, AHundredKilogramsStandOnOne) {
  expect_loads_are_weights<double>({1, 100}, PositionCorrection::Soft, 1e-6);
  Scene<double> scene = stack<double>({1, 100}, PositionCorrection::Soft);
  scene.advance(600);
  EXPECT_GT(scene.deepest_overlap(), -0.04);
}

// Three boxes of 1 kg, overlapping by two slops or just touching. The correction may lift them
// until one slop is left; no other energy may appear. Afterwards nothing may shake itself loose.
TEST_P(Stack, SlowEnergyNeverGrowsInTenThousandSteps) {
  const double of_one_step = 0.5 * 3 * std::pow(kGravity / 60, 2);
  struct Start {
    double overlap;
    std::optional<double> slop;
    int thousands;
  };
  for (const Start start :
       {Start{0.002, 0.001, 4}, Start{0.01, std::nullopt, 3}, Start{0, std::nullopt, 3}}) {
    Scene<double> scene = stack<double>({1, 1, 1}, GetParam().correction, start.overlap);
    scene.settings.slop = start.slop;
    scene.settings.iterations = GetParam().correction == PositionCorrection::Soft ? 2 : 12;
    const double slop = start.slop.value_or(0.0049);  // of the box with 98 cm
    double most_energy = scene.energy();
    if (start.overlap > slop) most_energy += (1 + 2 + 3) * kGravity * (start.overlap - slop);
    // A box is lifted before the one above it, so it moves a few hundredths too far.
    most_energy += 0.05 * std::max(most_energy - scene.energy(), 0.0);
    for (int i = 0; i < 500; ++i) {
      scene.advance();
      ASSERT_LT(scene.energy(), most_energy + 1e-6 * of_one_step) << start.overlap;
    }
    const double settled_energy = scene.energy();
    double last = 1e-6 * of_one_step;
    for (int thousand = 0; thousand < start.thousands; ++thousand) {
      double most = 0;
      for (int i = 0; i < 1000; ++i) {
        scene.advance();
        most = std::max(most, scene.kinetic());
        ASSERT_LT(scene.energy(), settled_energy + 1e-6 * of_one_step) << thousand;
      }
      EXPECT_LE(most, std::max(last, 1e-20 * of_one_step)) << thousand;
      last = most;
    }
    for (int box = 1; box <= 3; ++box)
      EXPECT_LT(scene.body(box).center.cwiseProduct(Vec3d(1, 0, 1)).norm(), 2e-3);
  }
}

// With few sweeps, a stack that starts again in each step cannot carry itself.
TEST(WarmStarting, FewSweepsCarryAStackOfTenOnlyIfTheyGoOnFromTheLast) {
  double sunk[2];
  for (const bool warm : {false, true}) {
    Scene<double> scene =
        stack<double>(std::vector<double>(10, 1.0), PositionCorrection::Baumgarte);
    scene.settings.warm_start = warm;
    scene.settings.iterations = 4;
    scene.advance(100);
    sunk[warm] = -scene.deepest_overlap();
  }
  EXPECT_GT(sunk[false], 0.04);
  EXPECT_LT(sunk[true], 0.015);
}

/// Equal cubes of 1 kg, one exactly on another, with only the method set.
template <class S> Scene<S> plain_stack(PositionCorrection correction, int boxes, double size = 1) {
  Scene<S> scene;
  scene.settings.position_correction = correction;
  scene.add_plane();
  for (int i = 0; i < boxes; ++i)
    scene.add_box(Vec3d::Constant(0.5 * size), at(0, (i + 0.5) * size, 0), 1);
  return scene;
}

/// Largest distance of a body from its entry in `places`, metres.
template <class S>
double largest_distance(const Scene<S>& scene, const std::vector<Body<S>>& places) {
  double most = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Vec3<S> offset = scene.world.bodies[i].center - places[i].center;
    most = std::max(most, static_cast<double>(offset.norm()));
  }
  return most;
}

// Coincident edges, positions without overlap: a stack as most people would write it.
TEST_P(Stack, SlowEqualBoxesThatJustTouchStandStillByDefault) {
  // Soft contacts yield.
  const double sinks = GetParam().correction == PositionCorrection::Soft ? 0.01 : 0.005;
  for (const int boxes : {1, 2, 4}) {
    Scene<float> scene = plain_stack<float>(GetParam().correction, boxes);
    const std::vector<Body<float>> places = scene.world.bodies;
    scene.advance(600);
    // The slop is 5 mm: each box may sink into the one below by this much.
    EXPECT_LT(largest_distance(scene, places), sinks * boxes) << boxes;
    const std::vector<Body<float>> settled_down = scene.world.bodies;
    for (int i = 0; i < 60; ++i) {
      scene.advance();
      // A thousandth of gravity's share for one box in a step.
      ASSERT_LT(scene.kinetic(), 1e-6 * 0.5 * std::pow(kGravity / 60, 2)) << boxes;
    }
    EXPECT_LT(largest_distance(scene, settled_down), 1e-5) << boxes;
    for (int box = 1; box <= boxes; ++box) {
      const double weight = (boxes - box + 1) * kGravity;
      EXPECT_NEAR(scene.load(box - 1, box) * 60, weight, 0.01 * weight) << boxes;
    }
  }
}

// Ten sweeps leave a sway in ten boxes, which would need hundreds. Soft contacts damp it.
TEST(TenEqualBoxes, SlowComeToRestOnSoftContactsInSubSteps) {
  Scene<float> scene = plain_stack<float>(PositionCorrection::Soft, 10);
  scene.settings.substeps = 4;
  scene.advance(600);
  EXPECT_LT(scene.kinetic(), 1e-5);
  for (int box = 1; box <= 10; ++box) {
    EXPECT_LT(std::hypot(scene.body(box).center.x(), scene.body(box).center.z()), 0.03);
    const double weight = (11 - box) * kGravity;
    EXPECT_NEAR(scene.load(box - 1, box) * 60, weight, 0.01 * weight);
  }
}

TEST_P(Stack, ALopsidedHullStaysWhereItWasPutByDefault) {
  const std::vector<Vec3d> points{{-0.5, 0, -0.5}, {0.5, 0, -0.5}, {0.5, 0, 0.5},
                                  {-0.5, 0, 0.5},  {0, 0.8, 0},    {0.2, 0.7, 0.3}};
  Scene<float> scene;
  scene.settings.position_correction = GetParam().correction;
  scene.add_plane();
  scene.add(build_hull(points), {}, 2);
  const std::vector<Body<float>> places = scene.world.bodies;
  scene.advance(1200);
  EXPECT_LT(largest_distance(scene, places), 0.005);
}

// A thousandth of the size and of gravity, in the same time: a thousandth of every displacement.
TEST_P(Stack, TheDefaultsAreOfTheSizeOfTheBodies) {
  Scene<double> large = plain_stack<double>(GetParam().correction, 3);
  Scene<double> small = plain_stack<double>(GetParam().correction, 3, 1e-3);
  small.world.gravity *= 1e-3;
  for (Scene<double>* scene : {&large, &small}) {
    const double size = scene == &large ? 1 : 1e-3;
    scene->body(3).center += Vec3d(0.1, 0.3, 0.2) * size;
    scene->advance(100);
  }
  for (int box = 1; box <= 3; ++box)
    EXPECT_LT((1000 * small.body(box).center - large.body(box).center).norm(), 1e-9) << box;
}

template <class S> void expect_equal(const World<S>& a, const World<S>& b) {
  ASSERT_EQ(a.bodies.size(), b.bodies.size());
  for (std::size_t i = 0; i < a.bodies.size(); ++i) {
    EXPECT_EQ(a.bodies[i].center, b.bodies[i].center);
    EXPECT_EQ(a.bodies[i].rotation.coeffs(), b.bodies[i].rotation.coeffs());
    EXPECT_EQ(a.bodies[i].velocity, b.bodies[i].velocity);
    EXPECT_EQ(a.bodies[i].angular_velocity, b.bodies[i].angular_velocity);
  }
}

// A fall that ends in a heap would reveal any state that a copy does not carry.
TEST_P(Stack, ACopyGoesOnAsTheOriginal) {
  Scene<float> scene = stack<float>({1, 2, 3}, GetParam().correction);
  scene.body(3).center.x() += 0.4f;
  scene.body(3).angular_velocity = {1, 2, 3};
  scene.advance(20);
  Scene<float> copy = scene;
  scene.advance(100);
  copy.advance(60);
  Scene<float> of_copy = copy;
  of_copy.advance(40);
  expect_equal(of_copy.world, scene.world);
  EXPECT_NE(of_copy.body(3).center, copy.body(3).center);
}

TEST_P(Stack, FarFromTheOriginTheSameHappens) {
  // 1024 m: double has enough precision, so the manifold is as good as at the origin.
  Scene<double> home = stack<double>({3, 2, 1}, GetParam().correction);
  Scene<double> away = home;
  for (int box = 1; box <= 3; ++box) away.body(box).center += Vec3d(1024, 0, -2048);
  home.advance(200);
  away.advance(200);
  for (int box = 1; box <= 3; ++box) {
    const Vec3d moved = away.body(box).center - Vec3d(1024, 0, -2048);
    EXPECT_LT((moved - home.body(box).center).norm(), 1e-8);
  }
}

}  // namespace
}  // namespace contactscope::test
