#include "dynamics/integrate.h"

#include <cmath>

#include <gtest/gtest.h>

#include "dynamics/solver.h"
#include "geometry/primitives.h"
#include "support/random_geometry.h"

namespace contactscope::test {
namespace {

/// A step in which nothing touches.
template <class S>
void fly(std::vector<Body<S>>& bodies, const Vec3<S>& gravity, S dt,
         const SolverSettings& settings = {}) {
  std::vector<PairImpulses<S>> impulses;
  solve_step<S>(bodies, {}, impulses, gravity, settings, dt);
}

template <class S>
Body<S> box_body(const Vec3d& half_extents, double mass, const Pose<double>& pose = {}) {
  const Shape<double> box = make_box(half_extents);
  return dynamic_body<S>(pose.cast<S>(), with_mass(*mass_properties(box), mass));
}

// Semi-implicit Euler has v = v0 - g t, and y = y0 + v0 t - g t^2 / 2 - g dt t / 2: its own
// parabola, which differs from the true one by exactly the last term.
TEST(Integrate, FreeFallIsTheParabolaOfSemiImplicitEuler) {
  for (const double dt : {1.0 / 30, 1.0 / 60, 1.0 / 240}) {
    for (const int substeps : {1, 4}) {
      std::vector<Body<double>> bodies = {box_body<double>({0.5, 0.5, 0.5}, 3)};
      bodies[0].velocity = {1, 5, 0};
      const int steps = static_cast<int>(std::lround(2 / dt));
      SolverSettings settings;
      settings.substeps = substeps;
      for (int i = 0; i < steps; ++i) fly<double>(bodies, {0, -9.81, 0}, dt, settings);
      const double t = 2, h = dt / substeps;
      EXPECT_NEAR(bodies[0].velocity.y(), 5 - 9.81 * t, 1e-12);
      EXPECT_NEAR(bodies[0].center.y(), 5 * t - 9.81 * t * t / 2 - 9.81 * h * t / 2, 1e-11);
      EXPECT_NEAR(bodies[0].center.x(), t, 1e-12);
      EXPECT_EQ(bodies[0].rotation.coeffs(), Quatd::Identity().coeffs());
    }
  }
}

template <class S> class Tumbling : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(Tumbling, Scalars);

// Spun about its middle axis with a nudge, a box keeps turning over (Dzhanibekov). This tests the
// whole gyroscopic term, and that it adds no energy, for ten thousand steps.
TYPED_TEST(Tumbling, SlowABoxKeepsMomentumAndEnergyOverTenThousandSteps) {
  using S = TypeParam;
  Random random(21);
  const Pose<double> pose = random.pose(2);
  std::vector<Body<S>> bodies = {box_body<S>({0.1, 0.3, 0.6}, 2, pose)};
  const Vec3d spin = pose.rotation * Vec3d(0.01, 6, 0.01);
  bodies[0].angular_velocity = spin.cast<S>();
  bodies[0].velocity = Vec3<S>(S(0.1), 0, 0);
  const Vec3d momentum = angular_momentum(bodies[0]);
  const double energy = kinetic_energy(bodies[0]);
  // A few units in the last place for each of 1e4 steps, if all round in the same direction.
  const double tolerance = 4e4 * double(std::numeric_limits<S>::epsilon());
  int turned_over = 0;
  double side = 1;
  for (int i = 0; i < 10000; ++i) {
    fly<S>(bodies, Vec3<S>::Zero(), S(1) / S(60));
    ASSERT_LT((angular_momentum(bodies[0]) - momentum).norm(), tolerance * momentum.norm()) << i;
    ASSERT_NEAR(kinetic_energy(bodies[0]), energy, tolerance * energy) << i;
    const Quatd to_body = bodies[0].rotation.template cast<double>().conjugate();
    const Vec3d local = to_body * Vec3d(bodies[0].angular_velocity.template cast<double>());
    if (local.y() * side < -3) {
      side = -side;
      ++turned_over;
    }
  }
  EXPECT_GT(turned_over, 20);
  EXPECT_EQ(bodies[0].velocity, (Vec3<S>(S(0.1), 0, 0)));
}

// The oracle: tiny steps of Euler's equations by Runge-Kutta, in the body's axes.
TEST(Integrate, ATumblingBoxFollowsEulersEquations) {
  std::vector<Body<double>> bodies = {box_body<double>({0.1, 0.3, 0.6}, 2)};
  bodies[0].angular_velocity = {1, 2, 0.5};
  const Vec3d inertia = bodies[0].inertia.diagonal();
  const auto slope = [&](const Vec3d& w) {
    const Vec3d momentum = inertia.cwiseProduct(w);
    return Vec3d(momentum.cross(w).cwiseQuotient(inertia));
  };
  Vec3d exact(1, 2, 0.5);
  double error[2];
  for (int k = 0; k < 2; ++k) {
    const int steps = 200 << k;
    bodies[0].rotation = Quatd::Identity();
    bodies[0].angular_velocity = {1, 2, 0.5};
    for (int i = 0; i < steps; ++i) fly<double>(bodies, {0, 0, 0}, 1.0 / steps);
    if (k == 0) {
      const double h = 1e-4;
      for (int i = 0; i < 10000; ++i) {
        const Vec3d k1 = slope(exact), k2 = slope(exact + h / 2 * k1);
        const Vec3d k3 = slope(exact + h / 2 * k2), k4 = slope(exact + h * k3);
        exact += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
      }
    }
    const Vec3d local = bodies[0].rotation.conjugate() * bodies[0].angular_velocity;
    error[k] = (local - exact).norm();
  }
  EXPECT_LT(error[0], 1e-3);
  EXPECT_NEAR(error[0] / error[1], 4, 0.1);  // second order
}

TEST(Integrate, NoSpinGainsEnergyAtAnySpeed) {
  Random random(22);
  for (int i = 0; i < 300; ++i) {
    std::vector<Body<double>> bodies = {
        box_body<double>({0.01, random.uniform(0.02, 1), random.uniform(0.02, 1)}, 1)};
    bodies[0].angular_velocity = random.decade(0, 6) * random.unit_vector();
    double energy = kinetic_energy(bodies[0]);
    for (int step = 0; step < 20; ++step) {
      fly<double>(bodies, {0, 0, 0}, 1.0 / 60);
      const double now = kinetic_energy(bodies[0]);
      ASSERT_LE(now, energy * (1 + 1e-10));
      ASSERT_GT(now, 0);
      energy = now;
    }
  }
}

TEST(Integrate, AScriptedBodyFollowsItsScript) {
  const Pose<double> from{Quatd(Eigen::AngleAxisd(3, Vec3d::UnitZ())), Vec3d(1, 2, 3)};
  const Pose<double> to{Quatd(Eigen::AngleAxisd(3.5, Vec3d::UnitZ())), Vec3d(1, 4, 3)};
  Body<double> body = static_body(from);
  set_scripted_velocity(body, from, to, 0.25);
  EXPECT_LT((body.velocity - Vec3d(0, 8, 0)).norm(), 1e-14);
  EXPECT_LT((body.angular_velocity - Vec3d(0, 0, 2)).norm(), 1e-13);
  std::vector<Body<double>> bodies = {body};
  fly<double>(bodies, {0, -9.81, 0}, 0.25);  // infinite masses do not fall
  EXPECT_LT((bodies[0].center - to.position).norm(), 1e-14);
  // Cayley's rotation by 0.5 rad is short by 0.5^3 / 12.
  EXPECT_NEAR(bodies[0].rotation.angularDistance(to.rotation), 0.5 * 0.5 * 0.5 / 12, 1e-3);
}

}  // namespace
}  // namespace contactscope::test
