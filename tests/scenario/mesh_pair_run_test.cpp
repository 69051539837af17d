#include <gmock/gmock.h>

#include <algorithm>
#include <cstdint>

#include "query/mesh_query_cost.h"
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

TEST(MeshPairRun, NodePairsAreRecordedOnlyIfAViewShowsThem) {
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

TEST(MeshPairRun, ACoherentTraversalFindsTheSameAndRecordsItsPairs) {
  const std::string slow = "[[views]]\npanels = [\"node_pairs\"]\n";
  std::string text = wavy_pair(slow + "[pipeline]\ntraversal = \"coherent\"\n");
  text.replace(text.find("dt = 0.1"), 8, "dt = 0.002");
  std::string other = wavy_pair(slow);
  other.replace(other.find("dt = 0.1"), 8, "dt = 0.002");
  const Scenario coherent = parse_scenario(text, "a.toml");
  const Scenario from_roots = parse_scenario(other, "a.toml");
  EXPECT_THAT(coherent.warnings, testing::IsEmpty());
  Runner runner(coherent), reference(from_roots), last(coherent);
  for (int frame = 0; frame < 4; ++frame) {
    const trace::Pair pair = runner.frame(frame).pairs.at(0);
    const trace::Pair expected = reference.frame(frame).pairs.at(0);
    EXPECT_EQ(pair.intersections, expected.intersections);
    EXPECT_EQ(pair.query->trees->triangle_pairs, expected.query->trees->triangle_pairs);
    EXPECT_EQ(count_of(pair.query->node_pairs), pair.query->trees->node_pairs);
    const int most = expected.query->trees->node_pairs;
    EXPECT_LE(pair.query->trees->node_pairs, frame == 0 ? most : 9 * most / 10);
    // Skipped frames count: the set of compared nodes depends on them.
    if (frame < 3) continue;
    EXPECT_EQ(last.frame(3).pairs.at(0).query->node_pairs, pair.query->node_pairs);
  }
}

TEST(MeshPairRun, ATraversalWithoutTwoTreesHasNoEffect) {
  const Scenario scenario = parse_scenario(
      wavy_pair("[pipeline]\nquery = \"overlap\"\nbounds = \"aabb\"\ntraversal = \"coherent\"\n"),
      "a.toml");
  EXPECT_THAT(scenario.warnings,
              testing::ElementsAre(testing::HasSubstr("'traversal' has no effect: only a query "
                                                      "of two meshes, or of two convex shapes, "
                                                      "without bounds")));
}

/// A sheet that is wound up, and another one that moves by `speed` along y.
std::string wound_pair(const std::string& radians, const std::string& speed) {
  return R"(title = "A sheet that is wound up in a ball"
[shapes.sheet]
type = "mesh"
grid = { size = [1, 4], cells = [12, 48] }
motion.deform = { twist = { axis = [0, 0, 1], radians = )" +
         radians + R"( } }
[shapes.other]
type = "mesh"
grid = { size = [3, 3], cells = [30, 30], amplitude = 0.1 }
position = [0, 0.4, 0.5]
motion = { velocity = [0, )" +
         speed + R"(, 0] }
[[pairs]]
a = "sheet"
b = "other"
query = "overlap"
[time]
frames = 60
dt = 0.05
)";
}

TEST(MeshPairRun, AnAutomaticTreeIsRebuiltIfQueriesCostThirtyPerCentMore) {
  std::string refit_text = wound_pair("4", "0");
  refit_text.replace(refit_text.find("motion.deform"), 0, "tree = \"refit\"\n");
  const Scenario scenario = parse_scenario(wound_pair("4", "0"), "a.toml");
  const Scenario refit = parse_scenario(refit_text, "a.toml");
  Runner runner(scenario), refitted(refit);
  int rebuilt = 0;
  std::int64_t nodes = 0, nodes_refitted = 0;
  MeshQueryCost cost;
  bool due = false;
  for (int frame = 0; frame < 60; ++frame) {
    const trace::Frame one = runner.frame(frame);
    const trace::Frame other = refitted.frame(frame);
    const trace::TreeCounts counts = *one.pairs.at(0).query->trees;
    EXPECT_EQ(one.pairs.at(0).intersections, other.pairs.at(0).intersections);
    const bool is_new = one.deformed.at(0).tree == "rebuilt";
    EXPECT_TRUE(is_new || !due) << frame;
    if (is_new) {
      cost.restart();
      ++rebuilt;
    }
    due = cost.judge({counts.node_pairs, counts.leaf_pairs, counts.triangle_pairs}) ==
          MeshQueryCost::Verdict::Worse;
    nodes += counts.node_pairs;
    nodes_refitted += other.pairs.at(0).query->trees->node_pairs;
  }
  EXPECT_GE(rebuilt, 1);
  EXPECT_LT(rebuilt, 15);
  EXPECT_LT(nodes, nodes_refitted);
}

TEST(MeshPairRun, AnAutomaticTreeIsNotRebuiltIfMeshesComeCloser) {
  // Wound so little that the tree stays as good as new, while the other mesh moves down through it.
  const Scenario scenario = parse_scenario(wound_pair("0.001", "-0.3"), "a.toml");
  Runner runner(scenario);
  int most = 0, least = 1 << 30;
  for (int frame = 0; frame < 60; ++frame) {
    const trace::Frame one = runner.frame(frame);
    EXPECT_NE(one.deformed.at(0).tree, "rebuilt") << frame;
    most = std::max(most, one.pairs.at(0).query->trees->node_pairs);
    least = std::min(least, one.pairs.at(0).query->trees->node_pairs);
  }
  EXPECT_GT(most, 5 * least) << "no challenge";
}

}  // namespace
}  // namespace contactscope
