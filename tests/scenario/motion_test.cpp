#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "scenario/scenario.h"

namespace contactscope {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// Rotation by an angle from its definition: Rodrigues' formula applied to a vector.
Vec3d rotated(const Vec3d& v, const Vec3d& unit_axis, double angle) {
  return std::cos(angle) * v + std::sin(angle) * unit_axis.cross(v) +
         (1 - std::cos(angle)) * unit_axis.dot(v) * unit_axis;
}

ScenarioShape shape_from(const std::string& keys) {
  const Scenario scenario = parse_scenario(
      "title = \"a\"\n[shapes.s]\ntype = \"box\"\nhalf_extents = [1, 1, 1]\n" + keys, "a.toml");
  return scenario.shapes.at(0);
}

/// Both poses map three points that span the space to the same places.
void expect_same(const Pose<double>& actual, const Vec3d& position, const Vec3d& axis,
                 double angle) {
  const Vec3d off = actual.position - position;
  EXPECT_NEAR(off.norm(), 0, 1e-14);
  EXPECT_NEAR(actual.rotation.norm(), 1, 1e-15);
  for (int i = 0; i < 3; ++i) {
    const Vec3d difference = actual.rotate(Vec3d::Unit(i)) - rotated(Vec3d::Unit(i), axis, angle);
    EXPECT_NEAR(difference.norm(), 0, 1e-14);
  }
}

TEST(Motion, WithoutAnyTheShapeRests) {
  const ScenarioShape shape =
      shape_from("position = [1, 2, 3]\nrotation = { axis = [0, 0, 2], degrees = 90 }");
  for (const double time : {-1.0, 0.0, 7.5})
    expect_same(pose_at(shape, time), {1, 2, 3}, Vec3d::UnitZ(), 90 * kDegree);
}

TEST(Motion, PositionsAreLinearBetweenKeyframes) {
  const ScenarioShape shape = shape_from(R"(
[shapes.s.motion]
keyframes = [ { time = 1, position = [0, 0, 0] },
              { time = 3, position = [4, -8, 2] },
              { time = 4, position = [4, 0, 2] } ]
)");
  expect_same(pose_at(shape, 1.5), {1, -2, 0.5}, Vec3d::UnitX(), 0);
  expect_same(pose_at(shape, 2.0), {2, -4, 1}, Vec3d::UnitX(), 0);
  expect_same(pose_at(shape, 3.25), {4, -6, 2}, Vec3d::UnitX(), 0);
}

TEST(Motion, TheEndsAreHeld) {
  const ScenarioShape shape = shape_from(R"(
[shapes.s.motion]
keyframes = [ { time = 1, position = [1, 0, 0] }, { time = 2, position = [2, 0, 0] } ]
)");
  EXPECT_EQ(pose_at(shape, -5).position, Vec3d(1, 0, 0));
  EXPECT_EQ(pose_at(shape, 0.999).position, Vec3d(1, 0, 0));
  EXPECT_EQ(pose_at(shape, 2).position, Vec3d(2, 0, 0));
  EXPECT_EQ(pose_at(shape, 1e9).position, Vec3d(2, 0, 0));
}

TEST(Motion, AKeyframesOwnTimeGivesItsOwnNumbers) {
  const ScenarioShape shape = shape_from(R"(
[shapes.s.motion]
[[shapes.s.motion.keyframes]]
time = 0.1
position = [0.1, 0.2, 0.3]
[[shapes.s.motion.keyframes]]
time = 0.3
position = [0.7, 0.1, 0.9]
rotation = { quat_wxyz = [0.6, 0.8, 0, 0] }
[[shapes.s.motion.keyframes]]
time = 0.7
position = [1, 1, 1]
)");
  EXPECT_EQ(pose_at(shape, 0.3).position, Vec3d(0.7, 0.1, 0.9));
  EXPECT_EQ(pose_at(shape, 0.3).rotation.coeffs(),
            shape.motion.keyframes[1].pose.rotation.coeffs());
}

TEST(Motion, SlerpTurnsAtConstantSpeed) {
  const ScenarioShape shape = shape_from(R"(
[shapes.s.motion]
keyframes = [ { time = 0, rotation = { axis = [1, 2, 2], degrees = 10 } },
              { time = 1, rotation = { axis = [1, 2, 2], degrees = 130 } } ]
)");
  const Vec3d axis = Vec3d(1, 2, 2) / 3;
  for (const double t : {0.0, 0.125, 0.25, 0.5, 0.75, 1.0})
    expect_same(pose_at(shape, t), {0, 0, 0}, axis, (10 + 120 * t) * kDegree);
}

TEST(Motion, SlerpTakesTheShortestArc) {
  // From 10 to 350 degrees: 20 degrees backwards, not 340 forwards.
  const ScenarioShape shape = shape_from(R"(
[shapes.s.motion]
keyframes = [ { time = 0, rotation = { axis = [0, 1, 0], degrees = 10 } },
              { time = 1, rotation = { axis = [0, 1, 0], degrees = 350 } } ]
)");
  expect_same(pose_at(shape, 0.25), {0, 0, 0}, Vec3d::UnitY(), 5 * kDegree);
  expect_same(pose_at(shape, 0.5), {0, 0, 0}, Vec3d::UnitY(), 0);
  expect_same(pose_at(shape, 0.75), {0, 0, 0}, Vec3d::UnitY(), -5 * kDegree);
}

TEST(Motion, TheSignOfAKeyframesQuaternionDoesNotMatter) {
  const std::string keyframes = R"(
[shapes.s.motion]
keyframes = [ { time = 0, rotation = { quat_wxyz = [1, 0, 0, 0] } },
              { time = 1, rotation = { quat_wxyz = [SIGN0.6, SIGN0.8, 0, 0] } } ]
)";
  for (const char* sign : {"", "-"}) {
    std::string text = keyframes;
    for (auto at = text.find("SIGN"); at != std::string::npos; at = text.find("SIGN"))
      text.replace(at, 4, sign);
    const double angle = 2 * std::atan2(0.8, 0.6);
    expect_same(pose_at(shape_from(text), 0.5), {0, 0, 0}, Vec3d::UnitX(), angle / 2);
  }
}

TEST(Motion, AKeyframeInheritsOmittedKeysFromTheOneBefore) {
  const ScenarioShape shape = shape_from(R"(
position = [1, 1, 1]
rotation = { axis = [0, 0, 1], degrees = 20 }
[shapes.s.motion]
keyframes = [ { time = 0 },
              { time = 1, rotation = { axis = [0, 0, 1], degrees = 40 } },
              { time = 2, position = [3, 1, 1] } ]
)");
  expect_same(pose_at(shape, 0), {1, 1, 1}, Vec3d::UnitZ(), 20 * kDegree);
  expect_same(pose_at(shape, 0.5), {1, 1, 1}, Vec3d::UnitZ(), 30 * kDegree);
  expect_same(pose_at(shape, 1.5), {2, 1, 1}, Vec3d::UnitZ(), 40 * kDegree);
  expect_same(pose_at(shape, 2), {3, 1, 1}, Vec3d::UnitZ(), 40 * kDegree);
}

TEST(Motion, ConstantVelocityCarriesTheShape) {
  const ScenarioShape shape =
      shape_from("position = [1, 2, 3]\n[shapes.s.motion]\nvelocity = [0.5, -1, 0]\n");
  expect_same(pose_at(shape, 0), {1, 2, 3}, Vec3d::UnitX(), 0);
  expect_same(pose_at(shape, 4), {3, -2, 3}, Vec3d::UnitX(), 0);
}

// The angular velocity is in world space and turns about the shape's origin. It acts on the shape
// after the start rotation, and never moves the origin.
TEST(Motion, AngularVelocityTurnsInWorldSpace) {
  const ScenarioShape shape = shape_from(R"(
position = [5, 0, 0]
rotation = { axis = [1, 0, 0], degrees = 90 }
[shapes.s.motion]
angular_velocity = [0, 0.75, 0]
)");
  for (const double time : {0.0, 0.3, 2.0, 100.0}) {
    const Pose<double> pose = pose_at(shape, time);
    EXPECT_EQ(pose.position, Vec3d(5, 0, 0));
    for (int i = 0; i < 3; ++i) {
      const Vec3d start = rotated(Vec3d::Unit(i), Vec3d::UnitX(), 90 * kDegree);
      const Vec3d difference =
          pose.rotate(Vec3d::Unit(i)) - rotated(start, Vec3d::UnitY(), 0.75 * time);
      EXPECT_NEAR(difference.norm(), 0, 1e-13);
    }
  }
}

TEST(Motion, TinyAngularVelocityIsNotLost) {
  const ScenarioShape shape = shape_from("[shapes.s.motion]\nangular_velocity = [0, 0, 1e-200]\n");
  expect_same(pose_at(shape, 1e200), {0, 0, 0}, Vec3d::UnitZ(), 1);
}

// Fifteen frames that each add a step would differ from this in the last digits.
TEST(Motion, FramesDoNotAccumulateRounding) {
  const ScenarioShape shape =
      shape_from("[shapes.s.motion]\nvelocity = [0.1, 0, 0]\nangular_velocity = [0, 0.1, 0]\n");
  EXPECT_EQ(pose_at(shape, 15.0).position.x(), 15.0 * 0.1);
  expect_same(pose_at(shape, 20 * std::numbers::pi), {2 * std::numbers::pi, 0, 0}, Vec3d::UnitY(),
              2 * std::numbers::pi);
}

struct Spelling {
  const char* name;
  const char* rotation;
};

class RotationSpelling : public ::testing::TestWithParam<Spelling> {};

// One rotation, 120 degrees about the diagonal, which maps x to y, y to z and z to x.
TEST_P(RotationSpelling, EverySpellingMeansTheSame) {
  const ScenarioShape shape = shape_from(std::string("rotation = ") + GetParam().rotation);
  EXPECT_NEAR((shape.pose.rotate(Vec3d::UnitX()) - Vec3d::UnitY()).norm(), 0, 1e-14);
  EXPECT_NEAR((shape.pose.rotate(Vec3d::UnitY()) - Vec3d::UnitZ()).norm(), 0, 1e-14);
  EXPECT_NEAR((shape.pose.rotate(Vec3d::UnitZ()) - Vec3d::UnitX()).norm(), 0, 1e-14);
  EXPECT_NEAR(shape.pose.rotation.norm(), 1, 1e-15);
}

INSTANTIATE_TEST_SUITE_P(
    Spellings, RotationSpelling,
    ::testing::Values(Spelling{"Degrees", "{ axis = [1, 1, 1], degrees = 120 }"},
                      Spelling{"Radians", "{ axis = [1, 1, 1], radians = 2.0943951023931953 }"},
                      Spelling{"OtherWayRound", "{ axis = [-1, -1, -1], degrees = -120 }"},
                      Spelling{"TinyAxis", "{ axis = [1e-200, 1e-200, 1e-200], degrees = 120 }"},
                      Spelling{"HugeAxis", "{ axis = [1e200, 1e200, 1e200], degrees = 120 }"},
                      Spelling{"ScalarFirst", "{ quat_wxyz = [0.5, 0.5, 0.5, 0.5] }"},
                      Spelling{"ScalarLast", "{ quat_xyzw = [0.5, 0.5, 0.5, 0.5] }"},
                      Spelling{"NotQuiteUnit", "{ quat_wxyz = [0.5003, 0.5003, 0.5003, 0.5003] }"},
                      Spelling{"MatrixRows", "{ matrix = [[0, 0, 1], [1, 0, 0], [0, 1, 0]] }"}),
    [](const ::testing::TestParamInfo<Spelling>& test) { return test.param.name; });

TEST(RotationOrder, TheTwoOrdersOfAQuaternionDiffer) {
  const ScenarioShape wxyz = shape_from("rotation = { quat_wxyz = [0.6, 0.8, 0, 0] }");
  const ScenarioShape xyzw = shape_from("rotation = { quat_xyzw = [0.6, 0.8, 0, 0] }");
  EXPECT_EQ(wxyz.pose.rotation.w(), 0.6);
  EXPECT_EQ(wxyz.pose.rotation.x(), 0.8);
  EXPECT_EQ(xyzw.pose.rotation.w(), 0.0);
  EXPECT_EQ(xyzw.pose.rotation.x(), 0.6);
  EXPECT_EQ(xyzw.pose.rotation.y(), 0.8);
}

// Rows of a published report (flexible-collision-library/fcl#495), eight digits each.
TEST(RotationOrder, APrintedMatrixIsReadByRows) {
  const ScenarioShape shape = shape_from(
      "rotation = { matrix = [[0.94096063, 0.29296840, 0.16959542], [-0.23569837, 0.92661524, "
      "-0.29296840], [-0.24297995, 0.23569837, 0.94096063]] }");
  const Vec3d first_column = shape.pose.rotate(Vec3d::UnitX());
  EXPECT_NEAR((first_column - Vec3d(0.94096063, -0.23569837, -0.24297995)).norm(), 0, 1e-6);
}

}  // namespace
}  // namespace contactscope
