#include <algorithm>
#include <set>

#include <gmock/gmock.h>

#include "scenario/broken.h"

namespace contactscope {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string scattered_box(const std::string& scatter, const std::string& more = "") {
  return "title = \"a\"\nworld.broad_phase = \"tree\"\n[shapes.crate]\ntype = \"box\"\n"
         "half_extents = [0.1, 0.2, 0.3]\nscatter = " +
         scatter + "\n" + more;
}

TEST(Scatter, SlowCopiesLieInTheRegionEachWithItsOwnRotation) {
  const Scenario scenario = parse_scenario(
      scattered_box("{ count = 300, lower = [-1, 5, 2], upper = [3, 6, 2] }"), "a.toml");
  ASSERT_EQ(scenario.shapes.size(), 300u);
  EXPECT_EQ(scenario.shapes.front().name, "crate_1");
  EXPECT_EQ(scenario.shapes.back().name, "crate_300");
  Vec3d least = Vec3d::Constant(100), most = -least, sum_of_axes = Vec3d::Zero();
  for (const ScenarioShape& shape : scenario.shapes) {
    least = least.cwiseMin(shape.pose.position);
    most = most.cwiseMax(shape.pose.position);
    sum_of_axes += shape.pose.rotate(Vec3d::UnitX());
    EXPECT_NEAR(shape.pose.rotation.norm(), 1, 1e-15);
    EXPECT_EQ(shape.geometry, scenario.shapes.front().geometry) << "one size, one shape";
  }
  EXPECT_TRUE(((least - Vec3d(-1, 5, 2)).array() >= 0).all());
  EXPECT_TRUE(((Vec3d(3, 6, 2) - most).array() >= 0).all());
  EXPECT_LT((most - least - Vec3d(4, 1, 0)).norm(), 0.2) << "they fill it";
  // Uniformly random axes add up to about the square root of their number, here 17.
  EXPECT_LT(sum_of_axes.norm(), 52);
}

TEST(Scatter, EveryCellHasOneInItsMiddleHalf) {
  const Scenario scenario = parse_scenario(
      scattered_box("{ cells = [3, 2, 4], lower = [0, 0, 0], upper = [3, 2, 4], turned = false }",
                    "rotation = { quat_wxyz = [0, 1, 0, 0] }"),
      "a.toml");
  ASSERT_EQ(scenario.shapes.size(), 24u);
  std::set<std::array<int, 3>> cells;
  for (const ScenarioShape& shape : scenario.shapes) {
    const Vec3d& position = shape.pose.position;
    cells.insert({static_cast<int>(position.x()), static_cast<int>(position.y()),
                  static_cast<int>(position.z())});
    for (const double coordinate : position)
      EXPECT_NEAR(coordinate - std::floor(coordinate), 0.5, 0.25);
    EXPECT_EQ(shape.pose.rotation.x(), 1);
  }
  EXPECT_EQ(cells.size(), 24u);
}

TEST(Scatter, SizesFillTheirRangeAndSmallOnesAreMany) {
  const Scenario scenario = parse_scenario(
      scattered_box("{ count = 1000, lower = [0, 0, 0], upper = [1, 1, 1], scale = [0.1, 10] }",
                    "motion = { dynamic = true, density = 500 }"),
      "a.toml");
  int small = 0;
  double least = 100, most = 0;
  for (const ScenarioShape& shape : scenario.shapes) {
    const Hull<double>& hull = *shape.hull();
    const double factor = hull.vertices[0].cwiseAbs().maxCoeff() / 0.3;
    small += factor < 0.2;
    least = std::min(least, factor);
    most = std::max(most, factor);
    EXPECT_NEAR(hull.radius, factor * Vec3d(0.1, 0.2, 0.3).norm(), 1e-12 * factor);
    ASSERT_TRUE(shape.body);
    EXPECT_NEAR(shape.body->mass / (500 * 8 * 0.1 * 0.2 * 0.3 * factor * factor * factor), 1, 1e-9);
    for (const Plane<double>& plane : hull.planes) EXPECT_GT(plane.offset, 0.09 * factor);
  }
  EXPECT_GE(least, 0.1);
  EXPECT_LT(least, 0.11);
  EXPECT_LE(most, 10);
  EXPECT_GT(most, 4);
  EXPECT_NEAR(small, 505, 60) << "half of them below twice the smallest";
}

TEST(Scatter, TheSeedAloneDeterminesTheCopies) {
  const auto first = [](const std::string& seed) {
    return parse_scenario(
               scattered_box("{ count = 5, lower = [0, 0, 0], upper = [1, 1, 1]" + seed + " }"),
               "a.toml")
        .shapes.front()
        .pose.position;
  };
  EXPECT_EQ(first(""), first(", seed = 1"));
  EXPECT_NE(first(""), first(", seed = 2"));
}

class BrokenScatter : public ::testing::TestWithParam<Broken> {};

TEST_P(BrokenScatter, IsNamedByPlaceAndRemedy) {
  const std::string message = complaint(GetParam().text);
  EXPECT_THAT(message, StartsWith(std::string("group/idea.toml:") + GetParam().location + ": "));
  EXPECT_THAT(message, HasSubstr(GetParam().remedy));
}

const std::string kSomewhere = "lower = [0, 0, 0], upper = [1, 1, 1]";

INSTANTIATE_TEST_SUITE_P(
    Scatter, BrokenScatter,
    ::testing::Values(
        Broken{"NoTable", scattered_box("3"), "6:11", "a table"},
        Broken{"NoNumber", scattered_box("{ " + kSomewhere + " }"), "6:11",
               "add count = 100, or cells = [10, 1, 10]"},
        Broken{"TwoNumbers", scattered_box("{ count = 2, cells = [1, 1, 1], " + kSomewhere + " }"),
               "6:32", "give 'count' or 'cells', not both"},
        Broken{"None", scattered_box("{ count = 0, " + kSomewhere + " }"), "6:21",
               "it may be 1 to 20000"},
        Broken{"TwoCells", scattered_box("{ cells = [2, 2], " + kSomewhere + " }"), "6:21",
               "write cells = [4, 1, 4]"},
        Broken{"CellsOfZero", scattered_box("{ cells = [2, 0, 2], " + kSomewhere + " }"), "6:25",
               "it may be 1 to 20000"},
        Broken{"TooManyCells", scattered_box("{ cells = [200, 200, 200], " + kSomewhere + " }"),
               "6:21", "more than 20000 copies; lower them"},
        Broken{"NoRegion", scattered_box("{ count = 2, lower = [0, 0, 0] }"), "6:11",
               "missing key 'upper'"},
        Broken{"RegionInsideOut",
               scattered_box("{ count = 2, lower = [0, 0, 0], upper = [1, -1, 1] }"), "6:51",
               "'upper' is below 'lower'"},
        Broken{"RegionTooFar",
               scattered_box("{ count = 2, lower = [0, 0, 0], upper = [1, 2e9, 1] }"), "6:55",
               "it may be -1e9 to 1e9 m"},
        Broken{"ScaleOfNothing", scattered_box("{ count = 2, scale = [0, 1], " + kSomewhere + " }"),
               "6:33", "'scale[0]' is 0; it may be 0.001 to 1000"},
        Broken{"Place", scattered_box("{ count = 2, " + kSomewhere + " }", "position = [1, 2, 3]"),
               "7:12", "'scatter' places the copies; remove 'position'"},
        Broken{"Turn",
               scattered_box("{ count = 2, " + kSomewhere + " }",
                             "rotation = { axis = [1, 0, 0], degrees = 3 }"),
               "7:12", "add turned = false to 'scatter'"},
        Broken{"Keyframes",
               scattered_box("{ count = 2, " + kSomewhere + " }",
                             "motion = { keyframes = [ { time = 0, position = [0, 0, 0] } ] }"),
               "7:10", "give a velocity, or dynamic = true"},
        Broken{"Plane",
               "title = \"a\"\n[shapes.floor]\ntype = \"plane\"\nnormal = [0, 1, 0]\noffset = 0\n"
               "scatter = { count = 2, " +
                   kSomewhere + " }",
               "6:11", "'floor' is a plane; write each copy as its own shape"},
        Broken{"SameName",
               scattered_box("{ count = 2, " + kSomewhere + " }",
                             "[shapes.crate_2]\ntype = \"sphere\"\nradius = 1"),
               "3:1", "two shapes are named 'crate_2'"}),
    name_of_test);

}  // namespace
}  // namespace contactscope
