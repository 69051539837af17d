#include <gmock/gmock.h>

#include "scenario/broken.h"
#include "scenario/run.h"
#include "trace/json.h"

/// Shapes that a file models far from their origin: collided about their middle, recorded as given.
namespace contactscope {
namespace {

std::string list_of(const std::vector<Vec3d>& points) {
  std::string text = "[";
  for (const Vec3d& point : points) {
    char line[128];
    std::snprintf(line, sizeof(line), "[%.17g, %.17g, %.17g], ", point.x(), point.y(), point.z());
    text += line;
  }
  return text + "]";
}

std::string position_of(const Vec3d& place) {
  return "position = " + list_of({place}).substr(1, list_of({place}).size() - 4) + "\n";
}

const std::vector<Vec3d> kWedge = {{-0.5, 0, -0.5}, {0.5, 0, -0.5}, {0.5, 0, 0.5},
                                   {-0.5, 0, 0.5},  {0, 0.7, -0.5}, {0, 0.7, 0.5}};

/// A wedge on a crate and a ball on a triangle, each modelled about `origin`, at the same places.
Scenario scene(const Vec3d& origin, const std::string& motion = "", const std::string& rest = "") {
  std::vector<Vec3d> wedge = kWedge, triangle = {{4, 0, -1}, {6, 0, -1}, {5, 0, 1}};
  for (Vec3d& point : wedge) point -= origin;
  for (Vec3d& point : triangle) point -= origin;
  return parse_scenario(
      "title = \"Far\"\n[time]\nframes = 30\n"
      "[shapes.crate]\ntype = \"box\"\nhalf_extents = [1, 0.5, 1]\nposition = [0, -0.49, 0]\n"
      "[shapes.wedge]\ntype = \"hull\"\nvertices = " +
          list_of(wedge) + "\n" + position_of(origin) + motion +
          "[shapes.ball]\ntype = \"sphere\"\nradius = 0.5\nposition = [5, 0.49, 0]\n"
          "[shapes.floor]\ntype = \"mesh\"\nvertices = " +
          list_of(triangle) + "\ntriangles = [[0, 2, 1]]\n" + position_of(origin) + rest,
      "g/far.toml");
}

const trace::Pair& pair_of(const trace::Frame& frame, const std::string& a, const std::string& b) {
  const auto found = std::ranges::find_if(
      frame.pairs, [&](const trace::Pair& pair) { return pair.a == a && pair.b == b; });
  return *found;
}

const Vec3d kFar(123456.7, -98765.4, 5e4);

TEST(FarShapes, MakeTheSameContactsAsNearTheirOrigin) {
  const Scenario near_scene = scene(Vec3d::Zero());
  const Scenario far_scene = scene(kFar);
  const trace::Frame near = Runner(near_scene).frame(0);
  const trace::Frame far = Runner(far_scene).frame(0);
  for (const auto& [a, b] : {std::pair("crate", "wedge"), std::pair("ball", "floor")}) {
    const trace::Pair& expected = pair_of(near, a, b);
    const trace::Pair& found = pair_of(far, a, b);
    ASSERT_EQ(expected.state, "touching");
    ASSERT_EQ(found.state, "touching") << a;
    EXPECT_NEAR(found.separation, expected.separation, 1e-6);
    ASSERT_EQ(found.manifolds.size(), 1u);
    ASSERT_EQ(found.manifolds[0].points.size(), expected.manifolds[0].points.size());
    EXPECT_LT((found.manifolds[0].normal - expected.manifolds[0].normal).norm(), 1e-6);
    for (const trace::Point& point : expected.manifolds[0].points) {
      double nearest = 1;
      for (const trace::Point& other : found.manifolds[0].points)
        nearest = std::min(nearest, (other.position - point.position).norm());
      EXPECT_LT(nearest, 1e-6);
    }
  }
}

TEST(FarShapes, AreRecordedAsInTheFile) {
  const Scenario scenario = scene(kFar);
  Runner runner(scenario);
  const trace::Header header = runner.header();
  ASSERT_EQ(header.shapes[1].vertices.size(), kWedge.size());
  for (std::size_t i = 0; i < kWedge.size(); ++i)
    EXPECT_EQ(header.shapes[1].vertices[i], Vec3d(kWedge[i] - kFar));
  EXPECT_LT((header.shapes[1].center_of_mass + kFar - Vec3d(0, 0.7 / 3, 0)).norm(), 1e-9);
  EXPECT_EQ(header.shapes[3].vertices[1], Vec3d(Vec3d(6, 0, -1) - kFar));
  const trace::Frame frame = runner.frame(0);
  EXPECT_EQ(frame.poses[1].second.position, kFar);
  EXPECT_EQ(frame.poses[3].second.position, kFar);

  const trace::Stage<trace::Tree>& tree = pair_of(frame, "ball", "floor").tree;
  ASSERT_TRUE(tree);
  EXPECT_LT((tree->visits.at(0).box.lower + kFar - Vec3d(4, 0, -1)).norm(), 1e-6);
  EXPECT_LT((tree->visits.at(0).box.upper + kFar - Vec3d(6, 0, 1)).norm(), 1e-6);
  EXPECT_LT((tree->box.lower + kFar - Vec3d(4.5, -0.01, -0.5)).norm(), 2e-6);
}

TEST(FarShapes, TurnAboutTheOriginThatTheFileGives) {
  const std::string turning = "motion = { angular_velocity = [0, 1, 0] }\n";
  const Scenario scenario = scene(Vec3d(100, 0, 0), turning);
  const trace::Frame frame = Runner(scenario).frame(20);
  const Vec3d record = frame.poses[1].second.transform(Vec3d(-100, 0, 0));
  const double angle = 20 / 60.0;
  EXPECT_LT((record - Vec3d(100 - 100 * std::cos(angle), 0, 100 * std::sin(angle))).norm(), 1e-12);
}

TEST(FarShapes, FallAndComeToRestAsNearTheirOrigin) {
  const std::string falling = "motion = { dynamic = true, mass = 2, velocity = [0.1, -1, 0] }\n";
  const std::string pairs = "[[pairs]]\na = \"crate\"\nb = \"wedge\"\n";
  const Scenario near_scenario = scene(Vec3d::Zero(), falling, pairs);
  const Scenario far_scenario = scene(kFar, falling, pairs);
  Runner near(near_scenario), far(far_scenario);
  for (const int frame : {0, 1, 5, 29}) {
    const trace::Frame expected = near.frame(frame), found = far.frame(frame);
    for (const Vec3d& corner : kWedge) {
      const Vec3d there = expected.poses[1].second.transform(corner);
      const Vec3d record = found.poses[1].second.transform(Vec3d(corner - kFar));
      EXPECT_LT((there - record).norm(), 2e-4) << frame;
    }
    ASSERT_EQ(found.solver->bodies.size(), 1u);
    EXPECT_LT(
        (found.solver->bodies[0].center_of_mass - expected.solver->bodies[0].center_of_mass).norm(),
        2e-4);
  }
  EXPECT_GT(pair_of(Runner(far_scenario).frame(29), "crate", "wedge")
                .manifolds.at(0)
                .points.at(0)
                .impulse->normal,
            0);
}

TEST(FarShapes, NearerThanFourRadiiAreCollidedAsTheFileHasThem) {
  const Scenario scenario = scene(Vec3d(2, 0, 0));
  for (const ScenarioShape& shape : scenario.shapes) EXPECT_FALSE(shape.is_moved()) << shape.name;
  EXPECT_EQ(scenario.shapes[1].collider, scenario.shapes[1].geometry);
}

}  // namespace
}  // namespace contactscope
