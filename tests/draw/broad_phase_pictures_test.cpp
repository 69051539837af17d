// Pictures of a broad phase, from facts by hand.

#include <algorithm>
#include <map>

#include <gmock/gmock.h>

#include "crate_on_slab.h"
#include "draw/panels/panel.h"

namespace contactscope::draw {
namespace {

using crate_sample::CrateOnSlab;

using ::testing::Contains;
using ::testing::IsSupersetOf;

class BroadPhasePicture : public ::testing::Test {
 protected:
  BroadPhasePicture() {
    trace::BroadPhase& phase = scene.frames[0].broad_phase.emplace();
    phase.method = "sweep_and_prune";
    phase.pairs = 1;
    phase.comparisons = 1234;
    phase.bounds = {{"slab", {{-1, -0.4, -1}, {1, 0, 1}}},
                    {"crate", {{-0.5, -0.002, -0.5}, {0.5, 0.998, 0.5}}}};
  }

  trace::BroadPhase& phase() { return *scene.frames[0].broad_phase; }

  Sketch sketch(Layer layer) {
    scene.view.layers = {layer};
    const Staging staging = scene.staged();
    return sketch_frame(staging, scene.frames[0]);
  }

  // Adds boxes until the tree is too large to be drawn completely.
  void crowd() {
    while (phase().bounds.size() <= 12) phase().bounds.push_back(phase().bounds[0]);
  }

  std::vector<std::string> panel(Panel which) {
    scene.view.panels = {which};
    const Staging staging = scene.staged();
    const std::vector<FilledPanel> panels = make_panels(staging, scene.frames);
    Drawing drawing;
    Sheet sheet({900, 80, 332, 500}, staging.layout.scale, drawing);
    EXPECT_EQ(panels.at(0).content->lay_out({}, sheet), "");
    return crate_sample::texts(drawing);
  }

  static std::vector<std::string> legend_of(const Sketch& sketch) {
    std::vector<std::string> words;
    for (const LegendEntry& entry : sketch.legend.sorted()) words.push_back(entry.text);
    return words;
  }

  CrateOnSlab scene;
};

TEST_F(BroadPhasePicture, CellsAreTilesOnOneFloorThoseOfMoreTestsDarkerAndAbove) {
  phase().cells = {{{{0, 1, 2}, {3, 4, 5}}, 0, 2, 100000},
                   {{{0, 1, 2}, {3, 4, 5}}, 0, 2, 9},
                   {{{0, 2, 2}, {3, 4, 5}}, 0, 2, 10},
                   {{{-9, 1, -9}, {9, 9, 9}}, 0, 0, 50}};
  const Sketch drawn = sketch(Layer::Cells);
  ASSERT_EQ(drawn.surfaces.size(), 3u) << "a node without boxes of its own is an outline";
  EXPECT_EQ(drawn.lines.size(), 16u);
  float last = 1;
  for (const Surface& tile : drawn.surfaces) {
    for (const Vec3d& corner : tile.polygon) EXPECT_EQ(corner.y(), 1);
    EXPECT_EQ(tile.color.a, 1) << "so that tiles that lie over each other are no darker";
    EXPECT_LT(tile.color.r, last);
    last = tile.color.r;
  }
  const Vec3d normal = (drawn.surfaces[0].polygon[1] - drawn.surfaces[0].polygon[0])
                           .cross(drawn.surfaces[0].polygon[2] - drawn.surfaces[0].polygon[1]);
  EXPECT_GT(normal.y(), 0) << "seen from above";
}

TEST_F(BroadPhasePicture, TilesOfAGridShowTheSumOfTheirCells) {
  phase().method = "grid";
  phase().cells = {{{{0, 0, 0}, {1, 1, 1}}, 0, 2, 3},
                   {{{0, 1, 0}, {1, 2, 1}}, 0, 2, 9},
                   {{{1, 0, 0}, {2, 1, 1}}, 0, 2, 1},
                   {{{2, 0, 0}, {3, 1, 1}}, 0, 1, 0}};
  const auto numbers = [](const Sketch& drawn) {
    std::vector<std::string> all;
    for (const Label& label : drawn.labels) all.push_back(label.text);
    return all;
  };
  Sketch drawn = sketch(Layer::Cells);
  EXPECT_EQ(drawn.surfaces.size(), 3u);
  EXPECT_THAT(numbers(drawn), testing::UnorderedElementsAre("12", "1"));
  EXPECT_THAT(legend_of(drawn), testing::ElementsAre("number: tests in a cell"));
  phase().cells[2].box.upper.x() = 1.001;
  drawn = sketch(Layer::Cells);
  EXPECT_THAT(numbers(drawn), testing::IsEmpty()) << "one had no room, and a sum needs all";
  EXPECT_THAT(legend_of(drawn), testing::ElementsAre("tests in a cell: up to 9, more"));
}

TEST_F(BroadPhasePicture, NodesOfAnOctreeBearTheirTestsWhereNoOtherNodeCoversThem) {
  crowd();
  phase().method = "octree";
  phase().cells = {{{{0, 0, 0}, {4, 1, 4}}, 0, 2, 3}, {{{0, 0, 0}, {4, 1, 2}}, 1, 4, 8}};
  const auto numbers = [](const Sketch& drawn) {
    std::map<std::string, Vec3d> all;
    for (const Label& label : drawn.labels) all[label.text] = label.at;
    return all;
  };
  Sketch drawn = sketch(Layer::Cells);
  std::map<std::string, Vec3d> found = numbers(drawn);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NE(found.at("3"), found.at("8"));
  EXPECT_THAT(legend_of(drawn), testing::ElementsAre("number: tests at a node"));
  phase().cells[1].box.upper.z() = 4;
  drawn = sketch(Layer::Cells);
  EXPECT_THAT(numbers(drawn), testing::IsEmpty())
      << "the one below is not seen, and a sum needs all";
  EXPECT_THAT(legend_of(drawn), testing::ElementsAre("tests at a node: up to 9"));
}

TEST_F(BroadPhasePicture, TreeNodesHaveNoCountsAsTheyDoNotAddUp) {
  crowd();
  phase().method = "tree";
  phase().cells = {{{{0, 0, 0}, {2, 1, 2}}, 0, 1, 3}, {{{2, 0, 0}, {4, 1, 2}}, 0, 1, 8}};
  const Sketch drawn = sketch(Layer::Cells);
  EXPECT_THAT(drawn.labels, testing::IsEmpty());
  EXPECT_THAT(legend_of(drawn), testing::ElementsAre("tests at a node: up to 9"));
}

TEST_F(BroadPhasePicture, PairsThatATreeOfFewBoxesTestedAreLinked) {
  phase().method = "tree";
  phase().bounds = {{"large", {{0, 0, 0}, {4, 1, 4}}},
                    {"within", {{1, 0, 1}, {2, 1, 2}}},
                    {"beside", {{4.2, 0, 1}, {5, 1, 2}}},
                    {"far", {{8, 0, 1}, {9, 1, 2}}}};
  phase().cells = {{{{-0.4, 0, -0.4}, {9.1, 1, 4.4}}, 0, 0, 0},
                   {{{-0.4, 0, -0.4}, {4.4, 1, 4.4}}, 1, 1, 2},
                   {{{0.9, 0, 0.9}, {2.1, 1, 2.1}}, 1, 1, 1},
                   {{{4.1, 0, 0.9}, {5.1, 1, 2.1}}, 1, 1, 1},
                   {{{7.9, 0, 0.9}, {9.1, 1, 2.1}}, 1, 1, 0}};
  phase().comparisons = 2;
  const auto ends = [](const Sketch& drawn) {
    return std::ranges::count(drawn.marks, MarkKind::Node, &Mark::kind);
  };
  const Sketch drawn = sketch(Layer::Cells);
  EXPECT_EQ(ends(drawn), 4);
  EXPECT_THAT(
      legend_of(drawn),
      testing::ElementsAre("leaf: a box and a margin around it", "larger nodes, deeper ones darker",
                           "pair that is tested", "tested in vain: boxes do not overlap"));
  phase().comparisons = 3;
  EXPECT_EQ(ends(sketch(Layer::Cells)), 0) << "these two are not all";
}

TEST_F(BroadPhasePicture, ABoxIsTestedAtNodesOfAnOctreeThatItReaches) {
  phase().method = "octree";
  phase().bounds = {{"large", {{0, 0, 0}, {4, 1, 2}}},
                    {"within", {{1, 0, 1}, {2, 1, 2}}},
                    {"beside", {{1, 0, 3}, {2, 1, 4}}}};
  phase().cells = {{{{0, 0, 0}, {4, 1, 4}}, 0, 1, 0},
                   {{{1, 0, 1}, {2, 1, 2}}, 1, 1, 1},
                   {{{1, 0, 3}, {2, 1, 4}}, 1, 1, 0}};
  phase().comparisons = 1;
  const Sketch drawn = sketch(Layer::Cells);
  EXPECT_THAT(legend_of(drawn),
              testing::ElementsAre("node, as far as its boxes reach", "pair that is tested"));
  ASSERT_EQ(drawn.surfaces.size(), 3u);
  EXPECT_LT(drawn.surfaces[1].color.b, drawn.surfaces[0].color.b) << "a node within another";
}

TEST_F(BroadPhasePicture, PairsThatAGridOfFewBoxesTestedAreLinked) {
  phase().method = "grid";
  phase().bounds = {{"large", {{0, 0, 0}, {9, 1, 9}}, true},
                    {"one", {{1, 0.1, 1}, {2, 0.9, 2}}},
                    {"beside", {{2.5, 0.1, 1}, {3.5, 0.9, 2}}},
                    {"far", {{20, 0.1, 1}, {21, 0.9, 2}}}};
  phase().cells = {{{{0, 0, 0}, {4, 1, 4}}, 0, 2, 1}, {{{20, 0, 0}, {24, 1, 4}}, 0, 1, 0}};
  phase().comparisons = 4;
  const auto ends = [](const Sketch& drawn) {
    return std::ranges::count(drawn.marks, MarkKind::Node, &Mark::kind);
  };
  EXPECT_EQ(ends(sketch(Layer::Cells)), 2 * (3 + 1));
  phase().comparisons = 5;
  EXPECT_EQ(ends(sketch(Layer::Cells)), 0) << "these four are not all";
}

TEST_F(BroadPhasePicture, AGridIsDrawnAlsoWhereNoBoxIs) {
  phase().bounds = {{"one", {{0.2, 0.1, 0.2}, {0.8, 0.9, 0.8}}},
                    {"other", {{4.2, 0.1, 2.2}, {4.8, 0.9, 2.8}}}};
  phase().cells = {{{{0, 0, 0}, {1, 1, 1}}, 0, 1, 0}, {{{4, 0, 2}, {5, 1, 3}}, 0, 1, 0}};
  const std::size_t of_tiles = sketch(Layer::Cells).lines.size();
  phase().method = "grid";
  const Sketch drawn = sketch(Layer::Cells);
  EXPECT_EQ(drawn.lines.size(), of_tiles + 6 + 4) << "5 cells by 3";
  for (const Line& line : drawn.lines) EXPECT_EQ(line.from.y(), 0) << "on the floor";
  phase().bounds[1].box.upper.x() = 900;
  EXPECT_EQ(sketch(Layer::Cells).lines.size(), of_tiles) << "too many to be told apart";
}

TEST_F(BroadPhasePicture, AHeapOfMoreThanAHundredShapesIsDrawnWithoutHiddenEdges) {
  const auto faint = [](const Line& line) { return line.style.hidden != LineStyle::Hidden::Gone; };
  EXPECT_TRUE(std::ranges::any_of(sketch(Layer::Shapes).lines, faint));
  for (int i = 0; i < 100; ++i) {
    const std::string name = "crate_" + std::to_string(i);
    scene.header.shapes.push_back(crate_sample::cuboid(name, {0.5, 0.5, 0.5}));
    Pose<double> pose;
    pose.position = {2.0 * i, 0.5, 3};
    scene.frames[0].poses.push_back({name, pose});
  }
  const Sketch heap = sketch(Layer::Shapes);
  ASSERT_FALSE(heap.lines.empty());
  EXPECT_FALSE(std::ranges::any_of(heap.lines, faint));
}

TEST_F(BroadPhasePicture, BoxesTooLargeForCellsAreExplained) {
  phase().cells = {{{{0, 1, 2}, {3, 4, 5}}, 0, 2, 10}, {{{3, 1, 2}, {6, 4, 5}}, 0, 2, 10}};
  EXPECT_THAT(legend_of(sketch(Layer::Cells)),
              testing::Not(Contains(testing::HasSubstr("too large for cells"))));
  phase().bounds[0].large = true;
  const Sketch drawn = sketch(Layer::Cells);
  EXPECT_EQ(drawn.surfaces.size(), 3u);
  EXPECT_THAT(legend_of(drawn), Contains("too large for cells, tested with all: 1214 tests"))
      << "what the cells did not cost";
}

TEST_F(BroadPhasePicture, TheOnlyCellHasNoToneForThereIsNoneToCompareItWith) {
  phase().cells = {{{{0, 1, 2}, {3, 4, 5}}, 0, 2, 1000}};
  const Sketch drawn = sketch(Layer::Cells);
  EXPECT_TRUE(drawn.surfaces.empty());
  EXPECT_EQ(drawn.lines.size(), 4u);
  EXPECT_THAT(legend_of(drawn), testing::ElementsAre("the only cell, of all boxes"));
}

TEST_F(BroadPhasePicture, ASweepComparesABoxWithThoseThatBeginInItsSpan) {
  phase().method = "columns";
  phase().cells = {{{{-1, -0.4, -1}, {1, 0.998, 1}}, 0, 2, 1}};
  phase().swept = "x";
  const Sketch drawn = sketch(Layer::Cells);
  EXPECT_THAT(legend_of(drawn),
              testing::ElementsAre("a box and its span", "begins in the span, so tested: 1"));
  ASSERT_EQ(drawn.surfaces.size(), 2u) << "the span over all of the column, and the box";
  for (const Vec3d& corner : drawn.surfaces[0].polygon) EXPECT_EQ(std::abs(corner.x()), 1);
  ASSERT_EQ(drawn.labels.size(), 1u);
  EXPECT_EQ(drawn.labels[0].text, "swept along x");
}

TEST_F(BroadPhasePicture, PairsThatASweepOfFewBoxesTestedAreLinked) {
  phase().method = "columns";
  phase().swept = "x";
  phase().bounds = {{"one", {{0, 0, 0}, {2, 1, 2}}},
                    {"beside", {{1, 0, 4}, {3, 1, 6}}},
                    {"far", {{8, 0, 0}, {9, 1, 2}}}};
  phase().cells = {{{{0, 0, 0}, {9, 1, 6}}, 0, 3, 1}};
  phase().comparisons = 1;
  const Sketch drawn = sketch(Layer::Cells);
  EXPECT_EQ(std::ranges::count(drawn.marks, MarkKind::Node, &Mark::kind), 2);
  EXPECT_THAT(legend_of(drawn),
              testing::ElementsAre("a box and its span", "tested in vain: boxes do not overlap"));
  phase().comparisons = 2;
  EXPECT_THAT(legend_of(sketch(Layer::Cells)),
              testing::ElementsAre("a box and its span", "begins in the span, so tested: 1"))
      << "this one is not all";
}

TEST_F(BroadPhasePicture, ASweepAlongTheViewIsNotDrawn) {
  phase().method = "columns";
  phase().cells = {{{{-1, -0.4, -1}, {1, 0.998, 1}}, 0, 2, 1}};
  phase().swept = "y";
  EXPECT_TRUE(sketch(Layer::Cells).surfaces.empty());
}

TEST_F(BroadPhasePicture, WithoutCellsNothingIsDrawnAndNothingExplained) {
  const Sketch drawn = sketch(Layer::Cells);
  EXPECT_TRUE(drawn.surfaces.empty());
  EXPECT_TRUE(legend_of(drawn).empty());
}

TEST_F(BroadPhasePicture, TheEndpointsPanelListsSwapsByAxis) {
  phase().end_swaps = {{"x", 0.5, "crate", "slab", true, false},
                       {"x", -0.5, "slab", "crate", true, false},
                       {"y", 0, "crate", "slab", true, true}};
  EXPECT_THAT(panel(Panel::Endpoints), IsSupersetOf({"along x: 2 ends pass, no pair begins",
                                                     "along y: crate passes slab, 1 pair begins",
                                                     "along z: nothing passes", "crate", "slab"}));
}

TEST_F(BroadPhasePicture, AnAxisWithoutSwapsTakesNoRoomIfAnotherHasSome) {
  const auto rows = [&] {
    const std::vector<std::string> record = panel(Panel::Endpoints);
    return std::ranges::count(record, "crate");
  };
  EXPECT_EQ(rows(), 3) << "all where nothing passes anywhere";
  phase().end_swaps = {{"y", 0, "crate", "slab", true, true}};
  EXPECT_EQ(rows(), 1);
}

TEST_F(BroadPhasePicture, ThePanelListsTheOtherAxesAndDrawsTheSeparatingOneForTheOnlySwap) {
  phase().bounds[1].box = {{2, -0.002, -0.5}, {3, 0.998, 0.5}};
  phase().end_swaps = {{"y", 0, "crate", "slab", true, false}};
  const std::vector<std::string> record = panel(Panel::Endpoints);
  EXPECT_THAT(record,
              IsSupersetOf({"along x: crate is apart from slab", "along z: crate overlaps slab"}));
  EXPECT_EQ(std::ranges::count(record, "crate"), 2) << "along x and along y";
}

TEST_F(BroadPhasePicture, WhereEndsPassIsALineAcrossBothBoxes) {
  const auto passing = [&] {
    std::vector<Label> found = sketch(Layer::Bounds).labels;
    std::erase_if(found, [](const Label& label) { return !label.text.starts_with("ends pass"); });
    return found;
  };
  EXPECT_TRUE(passing().empty());
  phase().end_swaps = {{"x", -0.5, "crate", "slab", true, false}};
  const std::vector<Label> found = passing();
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].text, "ends pass along x");
  EXPECT_EQ(found[0].at.x(), -0.5);
}

TEST_F(BroadPhasePicture, WithoutABroadPhaseTheEndpointsPanelHasANote) {
  scene.frames[0].broad_phase.reset();
  EXPECT_THAT(panel(Panel::Endpoints),
              Contains(testing::HasSubstr("does not apply: no broad phase")));
}

TEST_F(BroadPhasePicture, ThePipelineCountsWhatEachStagePasses) {
  EXPECT_THAT(panel(Panel::Pipeline), IsSupersetOf({"pairs of 2 shapes", "1", "1,234",
                                                    "pairs in contact", "contact points", "2"}));
}

TEST_F(BroadPhasePicture, WithCellsOnlyThePipelineEndsWithTheBroadPhase) {
  scene.view.layers = {Layer::Shapes, Layer::Bounds, Layer::Cells};
  const std::vector<std::string> record = panel(Panel::Pipeline);
  EXPECT_THAT(record, Contains("whose boxes overlap"));
  EXPECT_THAT(record, testing::Not(Contains("pairs in contact")));
}

TEST_F(BroadPhasePicture, ASingleColumnIsCalledTheSweepThatItIs) {
  phase().method = "columns";
  phase().swept = "x";
  phase().cells = {{{{-1, -0.4, -1}, {1, 0.998, 1}}, 0, 2, 1}};
  EXPECT_THAT(panel(Panel::Pipeline), Contains("broad phase: sweep along x"));
  phase().cells.push_back(phase().cells[0]);
  EXPECT_THAT(panel(Panel::Pipeline), Contains("broad phase: columns"));
}

TEST_F(BroadPhasePicture, AFewBoxesBearTheirNames) {
  const auto names = [&] {
    const Sketch drawn = sketch(Layer::Bounds);
    std::vector<std::string> all;
    for (const Label& label : drawn.labels)
      if (label.text.size() > 1) all.push_back(label.text);  // not the axes
    return all;
  };
  EXPECT_THAT(names(), testing::UnorderedElementsAre("slab", "crate"));
  for (int i = 0; i < 11; ++i) phase().bounds.push_back(phase().bounds[0]);
  EXPECT_THAT(names(), testing::IsEmpty()) << "many do not";
}

TEST_F(BroadPhasePicture, WithCellsOnlyBoxesUniqueOfTheirKindAreNamed) {
  phase().bounds = {{"crate_1", {{0, 0, 0}, {1, 1, 1}}},
                    {"crate_2", {{2, 0, 0}, {3, 1, 1}}},
                    {"slab", {{4, 0, 0}, {9, 1, 3}}}};
  scene.view.layers = {Layer::Bounds, Layer::Cells};
  std::vector<std::string> names;
  for (const Label& label : sketch_frame(scene.staged(), scene.frames[0]).labels)
    if (label.text.size() > 1) names.push_back(label.text);
  EXPECT_THAT(names, testing::ElementsAre("slab"));
}

TEST_F(BroadPhasePicture, ANameIsNextToItsBoxAndInsideNoOther) {
  phase().bounds = {{"left", {{0, 0, 0}, {2, 1, 2}}}, {"right", {{1, 0, 1}, {3, 1, 3}}}};
  const Eigen::AlignedBox3d left(Vec3d(0, 0, 0), Vec3d(2, 1, 2)),
      right(Vec3d(1, 0, 1), Vec3d(3, 1, 3));
  const Sketch drawn = sketch(Layer::Bounds);
  int names = 0;
  for (const Label& label : drawn.labels) {
    if (label.text.size() == 1) continue;  // of an axis
    ++names;
    const auto& [own, other] =
        label.text == "left" ? std::pair(left, right) : std::pair(right, left);
    EXPECT_GT(own.exteriorDistance(label.at), 0) << label.text;
    EXPECT_GT(other.exteriorDistance(label.at), own.exteriorDistance(label.at)) << label.text;
  }
  EXPECT_EQ(names, 2);
}

TEST_F(BroadPhasePicture, AmongManyShapesAPointIsASpeckWithoutALength) {
  const Sketch few = sketch(Layer::Contacts);
  const auto specks = [](const Sketch& drawn) {
    return std::ranges::count(drawn.marks, MarkKind::Speck, &Mark::kind);
  };
  EXPECT_EQ(specks(few), 0);
  EXPECT_FALSE(few.lines.empty()) << "whiskers";
  while (scene.header.shapes.size() <= kCrowd) {
    const std::string name = "more" + std::to_string(scene.header.shapes.size());
    scene.header.shapes.push_back(crate_sample::cuboid(name, {0.1, 0.1, 0.1}));
    scene.frames[0].poses.emplace_back(name, Pose<double>{});
  }
  const Sketch many = sketch(Layer::Contacts);
  EXPECT_EQ(specks(many), 2);
  EXPECT_EQ(many.marks.size(), 2u);
  EXPECT_TRUE(many.lines.empty());
  EXPECT_TRUE(many.labels.empty());
}

TEST_F(BroadPhasePicture, AmongManyShapesAPointBehindABodyIsPale) {
  while (scene.header.shapes.size() <= kCrowd) {
    const std::string name = "more" + std::to_string(scene.header.shapes.size());
    scene.header.shapes.push_back(crate_sample::cuboid(name, {0.1, 0.1, 0.1}));
    scene.frames[0].poses.emplace_back(name, Pose<double>{});
  }
  scene.view.eye = Vec3d(0, 0.5, 9);
  scene.view.target = Vec3d(0, 0.5, 0);
  std::vector<trace::Point>& points = scene.pair().manifolds[0].points;
  points[0].position = Vec3d(0, 0.5, -0.5);  // on the back of the crate
  points[1].position = Vec3d(0, 0.5, 0.5);   // on its front
  scene.view.layers = {Layer::Shapes, Layer::Contacts};
  const Staging staging = scene.staged();
  const Sketch drawn = sketch_frame(staging, scene.frames[0]);
  const auto at_point = [&](std::size_t i) {
    return std::ranges::find(drawn.marks, points[i].position, &Mark::at)->kind;
  };
  EXPECT_EQ(at_point(0), MarkKind::Core);
  EXPECT_EQ(at_point(1), MarkKind::Speck);
  EXPECT_THAT(legend_of(drawn), Contains("contact point, pale behind a body"));
}

}  // namespace
}  // namespace contactscope::draw
