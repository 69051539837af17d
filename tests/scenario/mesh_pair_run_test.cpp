#include <gmock/gmock.h>

#include <cstdint>

#include "core/at.h"
#include "scenario/run.h"

namespace contactscope {
namespace {

std::string wavy_pair(const std::string& rest) {
  return R"(title = "Two wavy sheets"
[shapes.a]
type = "mesh"
grid = { size = 4, cells = 20, amplitude = 0.3 }
[shapes.b]
type = "mesh"
grid = { size = 3, cells = 14, amplitude = 0.2 }
position = [0.1, 0.05, 0.2]
rotation = { axis = [0, 1, 0], degrees = 20 }
motion.deform = { wave = { axis = [1, 0, 0], direction = [0, 1, 0], amplitude = 0.2, wavelength = 1, speed = 1 } }
[[pairs]]
a = "a"
b = "b"
query = "overlap"
[time]
frames = 4
dt = 0.1
)" + rest;
}

TEST(MeshPairRun, BlocksThatWereLeftOutAndPairsOfLeavesAreAllPairsOfTriangles) {
  const Scenario scenario =
      parse_scenario(wavy_pair("[[views]]\npanels = [\"node_pairs\"]\n"), "a.toml");
  Runner runner(scenario);
  for (int frame = 0; frame < 4; ++frame) {
    const trace::Pair pair = runner.frame(frame).pairs.at(0);
    const std::vector<trace::NodePair>& visits = pair.query->node_pairs;
    EXPECT_EQ(count_of(visits), pair.query->trees->node_pairs);
    EXPECT_EQ(visits.at(0).count_a, 800);
    EXPECT_EQ(visits.at(0).count_b, 392);
    // Each pair of triangles is in one block.
    std::vector<int> covered(800 * 392, 0);
    int leaves = 0;
    for (const trace::NodePair& visit : visits) {
      if (visit.overlaps && !visit.leaves) continue;
      leaves += visit.overlaps ? 1 : 0;
      for (int i = 0; i < visit.count_a; ++i)
        for (int k = 0; k < visit.count_b; ++k)
          ++at(covered, (visit.before_a + i) * 392 + visit.before_b + k);
    }
    EXPECT_EQ(leaves, pair.query->trees->leaf_pairs);
    EXPECT_THAT(covered, testing::Each(1));
    EXPECT_FALSE(pair.intersections.empty());
  }
}

TEST(MeshPairRun, NobodyIsToldNodePairsUnlessAViewShowsThem) {
  const Scenario scenario = parse_scenario(wavy_pair(""), "a.toml");
  Runner runner(scenario);
  EXPECT_TRUE(runner.frame(0).pairs.at(0).query->node_pairs.empty());
}

TEST(MeshPairRun, HowATreeIsKeptChangesNoAnswer) {
  const Scenario one =
      parse_scenario(wavy_pair("[shapes.unused]\ntype = \"sphere\"\nradius = 1\n"), "a.toml");
  std::string rebuilt = wavy_pair("");
  rebuilt.replace(rebuilt.find("motion.deform"), 0, "tree = \"rebuild\"\n");
  std::string refitted = wavy_pair("");
  refitted.replace(refitted.find("motion.deform"), 0, "tree = \"refit\"\n");
  const Scenario other = parse_scenario(rebuilt, "a.toml");
  const Scenario third = parse_scenario(refitted, "a.toml");
  Runner by_auto(one), by_rebuild(other), by_refit(third);
  for (int frame = 0; frame < 4; ++frame) {
    const auto found = by_auto.frame(frame).pairs.at(0).intersections;
    EXPECT_EQ(found, by_rebuild.frame(frame).pairs.at(0).intersections);
    EXPECT_EQ(found, by_refit.frame(frame).pairs.at(0).intersections);
  }
}

}  // namespace
}  // namespace contactscope
