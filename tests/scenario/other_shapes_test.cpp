#include <gmock/gmock.h>

#include "scenario/run.h"
#include "scenario/scenario.h"

namespace contactscope {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string kShapes =
    "title = \"Shapes\"\n"
    "[shapes.ball]\ntype = \"sphere\"\nradius = 0.5\nposition = [0, 0.25, 0]\n"
    "[shapes.other]\ntype = \"sphere\"\nradius = 0.25\nposition = [0.5, 0.25, 0]\n"
    "[shapes.pill]\ntype = \"capsule\"\nradius = 0.1\npoints = [[1, 2, 3], [4, 5, 6]]\n"
    "[shapes.rod]\ntype = \"capsule\"\nradius = 0.1\nhalf_height = 0.75\n"
    "[shapes.ground]\ntype = \"plane\"\nnormal = [0, 3, 4]\noffset = -0.5\n";

TEST(OtherShapes, AreReadWithTheirSizes) {
  const Scenario scenario = parse_scenario(kShapes, "hull/a.toml");
  ASSERT_EQ(scenario.shapes.size(), 5u);
  EXPECT_EQ(std::get<Sphere<double>>(*scenario.shapes[0].geometry).radius, 0.5);
  const auto& pill = std::get<Capsule<double>>(*scenario.shapes[2].geometry);
  EXPECT_THAT(pill.points, ElementsAre(Vec3d(1, 2, 3), Vec3d(4, 5, 6)));
  const auto& rod = std::get<Capsule<double>>(*scenario.shapes[3].geometry);
  EXPECT_THAT(rod.points, ElementsAre(Vec3d(0, -0.75, 0), Vec3d(0, 0.75, 0)));
  const auto& ground = std::get<HalfSpace<double>>(*scenario.shapes[4].geometry);
  EXPECT_LT((ground.plane.normal - Vec3d(0, 0.6, 0.8)).norm(), 1e-15);
  EXPECT_EQ(ground.plane.offset, -0.5);
  EXPECT_EQ(scenario.shapes[0].hull(), nullptr);
}

TEST(OtherShapes, StandInTheTraceWithWhatTheyAreMadeOf) {
  const Scenario scenario = parse_scenario(kShapes, "hull/a.toml");
  const trace::Header header = trace_header(scenario);
  EXPECT_EQ(header.shapes[0].radius, 0.5);
  EXPECT_THAT(header.shapes[0].vertices, ElementsAre(Vec3d(0, 0, 0)));
  EXPECT_EQ(header.shapes[2].radius, double(0.1f));
  EXPECT_EQ(header.shapes[2].edges.size(), 1u);
  EXPECT_EQ(header.shapes[2].center_of_mass, Vec3d(2.5, 3.5, 4.5));
  EXPECT_EQ(header.shapes[4].half_space->offset, -0.5);
}

// The issue is with what the user writes as a and b, not with the order in the file.
TEST(OtherShapes, TradingAAndBMirrorsTheManifold) {
  const auto pair_of = [](const std::string& a, const std::string& b) {
    const Scenario scenario = parse_scenario(
        kShapes + "[[pairs]]\na = \"" + a + "\"\nb = \"" + b + "\"\n", "hull/a.toml");
    return run_frame(scenario, 0).pairs.at(0);
  };
  const trace::Pair there = pair_of("ball", "other");
  const trace::Pair back = pair_of("other", "ball");
  ASSERT_EQ(there.state, "touching");
  EXPECT_EQ(back.kind, "sphere-sphere");
  EXPECT_EQ(back.manifolds.at(0).normal, Vec3d(-there.manifolds.at(0).normal));
  EXPECT_EQ(back.manifolds[0].points.at(0).position, there.manifolds[0].points.at(0).position);
  EXPECT_EQ(there.separation, -0.25);
  EXPECT_EQ(back.separation, -0.25);
  EXPECT_EQ(there.manifolds[0].type, "point-point");
}

TEST(OtherShapes, PairsThatMakeNoContactAreWarnedOfOnce) {
  const std::string planes = kShapes +
                             "[shapes.wall]\ntype = \"plane\"\nnormal = [1, 0, 0]\noffset = 0\n"
                             "[shapes.roof]\ntype = \"plane\"\nnormal = [0, -1, 0]\noffset = -3\n"
                             "[[pairs]]\na = \"ground\"\nb = \"wall\"\n"
                             "[[pairs]]\na = \"roof\"\nb = \"wall\"\n";
  const Scenario scenario = parse_scenario(planes, "hull/a.toml");
  ASSERT_EQ(scenario.warnings.size(), 1u);
  EXPECT_THAT(scenario.warnings[0], HasSubstr("'ground' and 'wall' make no contacts: plane-plane"));
  const trace::Frame frame = run_frame(scenario, 0);
  EXPECT_EQ(frame.pairs.back().state, "separated");
  EXPECT_THAT(frame.pairs.back().manifolds, IsEmpty());
}

}  // namespace
}  // namespace contactscope
