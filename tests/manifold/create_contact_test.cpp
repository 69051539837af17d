#include "manifold/create_contact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "geometry/hull_builder.h"
#include "manifold/recorder.h"
#include "support/builders.h"

// The support vertex of the chosen face hangs over its side, so that clipping loses it.
namespace contactscope {
namespace {

using test::PairCase;

/// A cube tilted towards +x; its lowest edge is 1 cm outside the upper face of A and 2 cm below it.
PairCase<double> overhanging() {
  PairCase<double> pair = test::stacked_cubes(0, 0);
  pair.pose_b.rotation = test::about(Vec3d::UnitZ(), -20 * test::kDegree);
  pair.pose_b.position = Vec3d(0.51, 0.48, 0) - pair.pose_b.rotate({0.5, -0.5, 0});
  return pair;
}

struct Made {
  SatResult<double> axes;
  Contact<double> contact;
  trace::Pair record;
};

/// Creates the contact for the given chosen and deepest axes.
Made create(const PairCase<double>& pair, AxisKind chosen, AxisKind deepest) {
  Made made;
  const HullPair<double> placed(pair.a, pair.b, relative_pose(pair.pose_a, pair.pose_b));
  FaceSeparations<double> faces_a(placed.a), faces_b(placed.b);
  made.axes = sat(placed, 0.1, Preference::None, faces_a, faces_b);
  made.axes.status = SatStatus::Touching;
  made.axes.chosen = chosen;
  made.axes.deepest = deepest;
  Recorder<double> recorder(ToWorld<double>(pair.pose_a), {}, made.record);
  recorder.axes(placed, faces_a, made.axes, Preference::None);
  create_contact(placed, made.axes, {.preference = Preference::None}, made.contact, &recorder);
  return made;
}

TEST(CreateContact, ADeepestFaceWithItsSupportOutsideTouchesAtItsRim) {
  const Made made = create(overhanging(), AxisKind::FaceA, AxisKind::FaceA);
  ASSERT_NEAR(made.axes.face_a.separation, -0.02, 1e-12);
  ASSERT_FALSE(made.contact.points.empty());
  const ContactPoint<double>& last = made.contact.points.back();
  EXPECT_EQ(last.separation, made.axes.face_a.separation);
  EXPECT_NEAR(last.position.x(), 0.5, 1e-12);
  EXPECT_NEAR(last.position.y(), 0.5, 1e-12);
  EXPECT_LE(std::abs(last.position.z()), 0.5 + 1e-12);
  EXPECT_EQ(last.id.first, face_ref(Owner::A, made.axes.face_a.face));
  EXPECT_EQ(last.id.second.owner, Owner::B);
  ASSERT_TRUE(made.record.clip.has_value());
  bool recorded = false;
  for (const trace::DroppedPoint& dropped : made.record.clip->dropped) {
    recorded =
        recorded || dropped.reason == "cut off by the side planes; kept as the deepest point";
  }
  EXPECT_TRUE(recorded);
}

// A knife with its edge down, level, along x. Its ends lean outwards as they rise and face down
// more than its sides do. So the end at the support vertex is clipped, and all of it is outside A.
TEST(CreateContact, AKnifeWithItsEndOutsideTouchesWhereItsEdgeIsAbove) {
  const double width = 0.05, height = 1, lean = 1.5;
  std::vector<Vec3d> points;
  for (const double x : {1.0, -1.0}) {
    points.emplace_back(x, 0, 0);
    for (const double z : {-width, width}) points.emplace_back(lean * x, 0.3 * height, z);
    for (const double z : {-width, width}) points.emplace_back(lean * x, height, z);
  }
  for (const double offset : {0.8, -0.8}) {
    PairCase<double> pair{test::cube(0.5), test::at(0, -0.5, 0), build_hull(points),
                          test::at(offset, -0.01, 0)};
    for (const bool mirrored : {false, true}) {
      if (mirrored) pair = test::swapped(pair);
      const Manifold<double> manifold = test::collide(pair);
      ASSERT_FALSE(manifold.points.empty());
      EXPECT_NEAR(std::abs(manifold.normal.y()), 1, 1e-12);
      EXPECT_NEAR(test::deepest(manifold), -0.01, 1e-12);
      for (const ContactPoint<double>& point : manifold.points) {
        EXPECT_LE(std::abs(point.position.x()), 0.5 + 1e-12);
        EXPECT_NEAR(point.position.z(), 0, 1e-12);
      }
    }
  }
}

TEST(CreateContact, SlowShallowPreferredFaceYieldsToTheDeepestAxis) {
  // If the sides of the preferred face slope outwards below it, its deepest point may lie outside
  // it, and the clip may be shallower than the least overlap allows: a few pairs in a hundred.
  test::Random random(3);
  int replaced = 0;
  for (int i = 0; i < 3000; ++i) {
    const PairCase<double> pair = test::random_pair(random);
    const HullPair<double> placed(pair.a, pair.b, relative_pose(pair.pose_a, pair.pose_b));
    const SatResult<double> axes = sat(placed, 0.0, Preference::Relative);
    if (axes.status == SatStatus::Separated) continue;
    Contact<double> contact;
    create_contact<double>(placed, axes, {}, contact, nullptr);
    if (contact.axis == axes.chosen) continue;
    ++replaced;
    ASSERT_EQ(contact.axis, axes.deepest) << "pair " << i;
    ASSERT_FALSE(contact.points.empty()) << "pair " << i;
  }
  EXPECT_GT(replaced, 10);
}

}  // namespace
}  // namespace contactscope
