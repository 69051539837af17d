#include <cmath>

#include <gtest/gtest.h>

#include "dynamics/body.h"
#include "geometry/hull_builder.h"
#include "geometry/primitives.h"
#include "support/random_geometry.h"

namespace contactscope::test {
namespace {

constexpr double kPi = std::numbers::pi;

Mat3<double> diagonal(double x, double y, double z) { return Vec3d(x, y, z).asDiagonal(); }

/// The largest difference of two tensors, relative to the largest entry.
double difference(const Mat3<double>& a, const Mat3<double>& b) {
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

/// Textbook values of `local` with uniform density.
struct Textbook {
  const char* name;
  Hull<double> local;
  double volume;
  Vec3d center;
  Mat3<double> inertia_over_mass;
};

std::vector<Textbook> textbook_hulls() {
  std::vector<Textbook> all;
  // A box of sides a, b, c: (b^2 + c^2) / 12 and so on.
  all.push_back({"box", make_box({0.5, 1, 1.5}), 6, Vec3d::Zero(),
                 diagonal((4.0 + 9) / 12, (1.0 + 9) / 12, (1.0 + 4) / 12)});
  // A square pyramid of base side a and height h: a^2 / 10 about its axis, a^2 / 20 + 3 h^2 / 80
  // across it; the centre is a quarter of the height above the base.
  const double side2 = 2 * 0.7 * 0.7;
  const double across = side2 / 20 + 3 * 1.2 * 1.2 / 80;
  all.push_back({"pyramid", make_cone(0.7, 0.6, 4), side2 * 1.2 / 3, Vec3d(0, -0.3, 0),
                 diagonal(across, side2 / 10, across)});
  // A prism over a regular n-gon of circumradius R: R^2/2 (1 - 2/3 sin^2(pi/n)) about its axis.
  const int n = 7;
  const double axial = 0.5 * 0.4 * 0.4 * (1 - 2.0 / 3 * std::pow(std::sin(kPi / n), 2));
  all.push_back({"prism", make_cylinder(0.4, 0.9, n),
                 0.5 * n * 0.4 * 0.4 * std::sin(2 * kPi / n) * 1.8, Vec3d::Zero(),
                 diagonal(axial / 2 + 1.8 * 1.8 / 12, axial, axial / 2 + 1.8 * 1.8 / 12)});
  return all;
}

TEST(MassProperties, HullsHaveThoseOfTheTextbookInAnyPose) {
  Random random(11);
  for (const Textbook& textbook : textbook_hulls()) {
    for (int i = 0; i < 20; ++i) {
      const Pose<double> pose = random.pose(20);
      std::vector<Vec3d> points;
      for (const Vec3d& vertex : textbook.local.vertices) points.push_back(pose.transform(vertex));
      const double density = random.decade(-2, 4);
      const auto even = mass_properties(Shape<double>(build_hull(points)));
      ASSERT_TRUE(even);
      EXPECT_NEAR(even->mass, textbook.volume, 1e-11 * textbook.volume) << textbook.name;
      const std::optional<MassProperties> found = with_mass(*even, density * even->mass);
      EXPECT_NEAR(found->mass, density * textbook.volume, 1e-11 * density * textbook.volume);
      EXPECT_LT((found->center - pose.transform(textbook.center)).norm(), 1e-11) << textbook.name;
      const Mat3<double> axes = pose.rotation.toRotationMatrix();
      const Mat3<double> expected =
          found->mass * axes * textbook.inertia_over_mass * axes.transpose();
      EXPECT_LT(difference(found->inertia, expected), 1e-9) << textbook.name;
    }
  }
}

TEST(MassProperties, ASphereHasTwoFifths) {
  const auto found = mass_properties(Shape<double>(Sphere<double>{0.3}));
  ASSERT_TRUE(found);
  const double mass = 4.0 / 3 * kPi * 0.027;
  EXPECT_NEAR(found->mass, mass, 1e-13);
  EXPECT_EQ(found->center, Vec3d(0, 0, 0));
  EXPECT_LT(difference(found->inertia, diagonal(1, 1, 1) * (0.4 * mass * 0.09)), 1e-14);
}

/// The oracle cuts the capsule into thin discs: mass r^2/2 about the axis, r^2/4 across it.
TEST(MassProperties, ACapsuleHasThoseOfItsDiscs) {
  Random random(12);
  for (int i = 0; i < 20; ++i) {
    const double radius = random.uniform(0.1, 2), half = i == 0 ? 0 : random.uniform(0.01, 2);
    constexpr int kDiscs = 4000;
    double volume = 0, along = 0, across = 0;
    const double thickness = 2 * (half + radius) / kDiscs;
    for (int k = 0; k < kDiscs; ++k) {
      const double y = -(half + radius) + (k + 0.5) * thickness;
      const double beyond = std::max(std::abs(y) - half, 0.0);
      const double r2 = radius * radius - beyond * beyond;
      const double mass = kPi * r2 * thickness;
      volume += mass;
      along += mass * r2 / 2;
      across += mass * (r2 / 4 + y * y);
    }
    const Pose<double> pose = random.pose(3);
    Capsule<double> capsule;
    capsule.points = {pose.transform({0, -half, 0}), pose.transform({0, half, 0})};
    capsule.radius = radius;
    const auto found = mass_properties(Shape<double>(capsule));
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->mass, volume, 1e-5 * volume);
    EXPECT_LT((found->center - pose.position).norm(), 1e-14);
    const Mat3<double> axes = pose.rotation.toRotationMatrix();
    const Mat3<double> expected = axes * diagonal(across, along, across) * axes.transpose();
    EXPECT_LT(difference(found->inertia, expected), 1e-5);
  }
}

TEST(MassProperties, AnotherMassScalesTheInertiaAlone) {
  const auto found = mass_properties(Shape<float>(hull_cast<float>(make_box({1, 1, 1}))));
  ASSERT_TRUE(found);
  const MassProperties heavy = with_mass(*found, 24);
  EXPECT_NEAR(found->mass, 8, 1e-14);
  EXPECT_EQ(heavy.mass, 24);
  EXPECT_LT(difference(heavy.inertia, diagonal(16, 16, 16)), 1e-14);  // m (4 + 4) / 12
}

TEST(MassProperties, TheShortestEdgeIsThatOfABoxInAnyPose) {
  Random random(12);
  for (int i = 0; i < 50; ++i) {
    const Vec3d half(random.decade(-4, 3), random.decade(-4, 3), random.decade(-4, 3));
    const Mat3<double> axes = random.rotation().toRotationMatrix();
    const Vec3d square = half.cwiseProduct(half);
    const double mass = random.decade(-9, 9);
    const Mat3<double> inertia =
        mass / 3 * axes *
        diagonal(square.y() + square.z(), square.x() + square.z(), square.x() + square.y()) *
        axes.transpose();
    const double found = shortest_edge(mass, inertia);
    const double expected = 2 * half.minCoeff();
    // The square of an edge is a difference of terms that the longest ones dominate.
    EXPECT_NEAR(found * found, expected * expected, 1e-14 * half.squaredNorm());
  }
  const MassProperties ball = *mass_properties(Shape<double>(Sphere<double>{2}));
  EXPECT_NEAR(shortest_edge(ball.mass, ball.inertia), 2 * std::sqrt(2.4), 1e-12);
}

TEST(MassProperties, PlanesAndMeshesHaveNone) {
  EXPECT_FALSE(mass_properties(Shape<double>(HalfSpace<double>{{Vec3d::UnitY(), 0}})));
  EXPECT_FALSE(mass_properties(Shape<double>(Mesh<double>{})));
}

TEST(MassProperties, ABodyStandsWhereItsShapeStands) {
  Random random(13);
  for (int i = 0; i < 20; ++i) {
    const Shape<double> cone = make_cone(0.5, 1, 5);
    const Pose<double> pose = random.pose(5);
    const Body<double> body = dynamic_body(pose, with_mass(*mass_properties(cone), 7));
    EXPECT_LT((body.pose().position - pose.position).norm(), 1e-14);
    EXPECT_EQ(body.pose().rotation.coeffs(), pose.rotation.coeffs());
    EXPECT_LT((body.center - pose.transform({0, -0.5, 0})).norm(), 1e-14);
    EXPECT_LT(difference(body.inertia * body.inverse_inertia, diagonal(1, 1, 1)), 1e-14);
  }
}

}  // namespace
}  // namespace contactscope::test
