// Pictures of meshes against meshes and of meshes that deform, from facts by hand.

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "crate_on_slab.h"
#include "draw/panels/panel.h"
#include "draw/scene/palette.h"
#include "draw/staging.h"

namespace contactscope::draw {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::UnorderedElementsAre;

trace::Shape surface(const std::string& name, const std::vector<Vec3d>& vertices) {
  trace::Shape shape;
  shape.name = name;
  shape.type = "mesh";
  shape.vertices = vertices;
  shape.faces = {{0, 1, 2}, {0, 2, 3}};
  return shape;
}

/// A level square and an upright one that crosses it, of two triangles each.
struct TwoSurfaces {
  trace::Header header;
  std::vector<trace::Frame> frames;
  View view;

  TwoSurfaces() {
    header.scenario = "test/surfaces";
    header.title = "Two surfaces";
    header.source = "none";
    header.up = "y";
    header.shapes = {surface("level", {{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}}),
                     surface("wall", {{0, -1, 1}, {0, 1, 1}, {0, 1, -1}, {0, -1, -1}})};
    add_frame();
    view.layers = {Layer::Shapes, Layer::Intersections};
  }

  /// Makes the first frame's pair meet in the step after it.
  trace::Impact& hit() {
    trace::Impact& impact = frames[0].pairs[0].impact.emplace();
    impact.method = "time_of_impact";
    impact.status = "hit";
    return impact;
  }

  void add_frame() {
    trace::Frame& frame = frames.emplace_back();
    frame.frame = static_cast<int>(frames.size()) - 1;
    frame.time = 0.1 * frame.frame;
    frame.poses = {{"level", {}}, {"wall", {}}};
    trace::Pair& pair = frame.pairs.emplace_back();
    pair.a = "level";
    pair.b = "wall";
    pair.kind = "mesh-mesh";
    pair.state = "touching";
    pair.overlap = true;
    pair.query.emplace().requested = "overlap";
    header.frames = static_cast<int>(frames.size());
  }
  void meet(const char* kind, const Vec3d& from, const Vec3d& to) {
    frames[0].pairs[0].intersections.push_back({0, 1, kind, {{from, to}}});
  }

  Staging staged() const { return stage(header, frames, view, 1280, 720); }
  Sketch sketch() const { return sketch_frame(staged(), frames[0]); }
};

std::vector<std::string> legend_texts(const Sketch& sketch) {
  return mapped(sketch.legend.sorted(), &LegendEntry::text);
}

int surfaces_of(const Sketch& sketch, const Color& color) {
  return static_cast<int>(std::ranges::count_if(
      sketch.surfaces, [&](const Surface& one) { return crate_sample::same(one.color, color); }));
}

int curve_lines(const Sketch& sketch) {
  return static_cast<int>(std::ranges::count_if(sketch.lines, [](const Line& line) {
    return crate_sample::same(line.style.color, kContact) && line.style.width > 3;
  }));
}

TEST(MeshPictures, CrossingTrianglesOfBothMeshesAreTintedAndTheirSegmentsAreALine) {
  TwoSurfaces scene;
  scene.meet("proper", {0, 0, 1}, {0, 0, 0});
  scene.meet("proper", {0, 0, 0}, {0, 0, -1});
  const Sketch sketch = scene.sketch();
  EXPECT_EQ(surfaces_of(sketch, kContact), 2);  // triangle 0 of one and 1 of the other, once each
  EXPECT_EQ(curve_lines(sketch), 2);
  EXPECT_THAT(legend_texts(sketch), AllOf(Contains("where the surfaces meet"),
                                          Contains("triangle that crosses the other mesh")));
}

TEST(MeshPictures, ALonePointIsADotAndTheEndOfALineIsNot) {
  TwoSurfaces scene;
  scene.meet("touching", {0, 0, 1}, {0, 0, 0});
  scene.meet("touching", {0, 0, 0}, {0, 0, 0});
  scene.meet("touching", {0, 0, -0.5}, {0, 0, -0.5});
  const Sketch sketch = scene.sketch();
  EXPECT_EQ(surfaces_of(sketch, kContact), 0);
  EXPECT_EQ(curve_lines(sketch), 1);
  ASSERT_EQ(sketch.marks.size(), 1u);
  EXPECT_EQ(sketch.marks[0].at, Vec3d(0, 0, -0.5));
}

TEST(MeshPictures, ATouchThatDoesNotCountIsDashedAndDrawnOnceForAllTriangles) {
  TwoSurfaces scene;
  scene.frames[0].pairs[0].overlap = false;
  scene.meet("touching", {0, 0, 1}, {0, 0, 0});
  scene.meet("touching", {0, 0, 0}, {0, 0, 1});
  const Sketch sketch = scene.sketch();
  const auto dashed = std::ranges::count_if(sketch.lines, [](const Line& line) {
    return crate_sample::same(line.style.color, kContact) && line.style.dashed &&
           line.style.hidden == LineStyle::Hidden::Same;  // faint lines are drawn solid
  });
  EXPECT_EQ(dashed, 1);
}

TEST(MeshPictures, CoplanarAndDegenerateTrianglesHaveSignsOfTheirOwn) {
  TwoSurfaces scene;
  scene.frames[0].pairs[0].intersections = {{0, 1, "coplanar", {}},
                                            {1, 0, "touching", {}, false, true}};
  const Sketch sketch = scene.sketch();
  EXPECT_EQ(surfaces_of(sketch, kAxis), 2);
  EXPECT_TRUE(std::ranges::any_of(sketch.lines, [](const Line& line) {
    return crate_sample::same(line.style.color, kAxisText) &&
           line.style.hidden == LineStyle::Hidden::Faint;
  })) << "behind a wall it is seen to be behind it";
  EXPECT_EQ(sketch.marks.size(), 3u) << "its corners: it is no line";
  EXPECT_THAT(legend_texts(sketch), AllOf(Contains("triangles that overlap in one plane"),
                                          Contains("triangle without an area")));
}

TEST(MeshPictures, CornersOfTheTriangleThatMeetsFirstGoStraightOn) {
  TwoSurfaces scene;
  scene.view.layers = {Layer::Shapes, Layer::Sweep};
  trace::Impact& impact = scene.hit();
  impact.triangle_a = 0;
  impact.corners_a = {{-1, -1, 1}, {1, -1, 1}, {1, -1, -1}};
  const auto paths = [&] {
    return std::ranges::count_if(scene.sketch().arrows, [&](const Arrow& arrow) {
      // The heads end a little before the corners, so as not to hide them.
      const auto ends_at = [&](const Vec3d& corner) { return (corner - *arrow.to).norm() < 0.2; };
      return crate_sample::same(arrow.color, kContact) &&
             std::ranges::any_of(impact.corners_a, ends_at) &&
             (*arrow.to - arrow.from).normalized().isApprox(Vec3d(0, -1, 0), 1e-9);
    });
  };
  EXPECT_EQ(paths(), 3);
  EXPECT_THAT(legend_texts(scene.sketch()), Contains("way of a corner"));
  impact.triangle_a = -1;
  EXPECT_EQ(paths(), 0) << "of which nobody says where it is now";
}

TEST(MeshPictures, TrianglesThatMeetFirstBearTheLettersOfTheirMeshes) {
  TwoSurfaces scene;
  scene.view.layers = {Layer::Shapes, Layer::Sweep};
  trace::Impact& impact = scene.hit();
  impact.corners_a = {{-1, 0, 0}, {0, 0, 0}, {0, 1, 0}};
  const auto letter = [&](std::string_view text) {
    const std::vector<Label> labels = scene.sketch().labels;
    const auto found = std::ranges::find(labels, text, &Label::text);
    return found == labels.end() ? std::nullopt : std::optional(found->at);
  };
  EXPECT_FALSE(letter("A")) << "of one alone there is nothing to tell apart";
  impact.corners_b = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_EQ(letter("A"), Vec3d(-1, 0, 0)) << "away from the other one";
  EXPECT_EQ(letter("B"), Vec3d(1, 0, 0));
}

// Its contact point is a dot, but its centre is not.
TEST(MeshPictures, ABallThatTouchesHasACrossForItsCentre) {
  TwoSurfaces scene;
  trace::Shape& ball = scene.header.shapes.emplace_back();
  ball.name = "ball";
  ball.type = "sphere";
  ball.radius = 0.3;
  ball.vertices = {Vec3d::Zero()};
  Pose<double> above;
  above.position = {0.2, 0.8, 0};
  scene.frames[0].poses.emplace_back("ball", above);
  scene.frames[0].pairs[0].b = "ball";
  trace::Impact& impact = scene.hit();
  impact.time = 0.5;
  impact.travel_b.displacement = {0, -1, 0};
  scene.view.layers = {Layer::Shapes, Layer::Prism};
  const Sketch sketch = scene.sketch();
  const auto cross = std::ranges::find(sketch.marks, MarkKind::Cross, &Mark::kind);
  ASSERT_NE(cross, sketch.marks.end());
  EXPECT_LT((cross->at - Vec3d(0.2, 0.3, 0)).norm(), 1e-9);
  EXPECT_THAT(legend_texts(sketch), AllOf(Contains("centre of the ball as it touches"),
                                          Contains("prism about face, edges and vertices")));
}

TEST(MeshPictures, AMeshWithoutAnInsideShowsWhereItIsOpen) {
  TwoSurfaces scene;
  const auto edges = [&] {
    return std::ranges::count_if(scene.sketch().lines, [](const Line& line) {
      return crate_sample::same(line.style.color, kAxisText);
    });
  };
  EXPECT_EQ(edges(), 0);
  scene.frames[0].pairs[0].query->containment = {.a = "inside", .b = "open"};
  EXPECT_EQ(edges(), 4) << "the border of the wall, and not the edge between its triangles";
  EXPECT_THAT(legend_texts(scene.sketch()), Contains("edge at which the surface ends"));
}

TEST(MeshPictures, AMeshInsideTheOtherIsDashedThroughIt) {
  TwoSurfaces scene;
  const auto record = [&](const char* containment) {
    scene.frames[0].pairs[0].query->containment = {.a = containment, .b = "outside"};
    return legend_texts(scene.sketch());
  };
  EXPECT_THAT(record("outside"), testing::Not(Contains("inside the other")));
  EXPECT_THAT(record("inside"), Contains("inside the other"));
}

TEST(MeshPictures, ATriangleThatIsNotThereIsLeftOut) {
  TwoSurfaces scene;
  scene.frames[0].pairs[0].intersections = {{7, -1, "proper", {}, true, true}};
  EXPECT_EQ(surfaces_of(scene.sketch(), kContact), 0);
}

TEST(MeshPictures, AMeshThatDeformsIsDrawnAsItIsInTheFrame) {
  TwoSurfaces scene;
  scene.add_frame();
  // Upright across the other one: its former top side faces -z.
  const std::vector<Vec3d> raised = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  scene.frames[1].deformed = {{"level", raised, "refitted", 3, 2, {}}};
  const Staging staging = scene.staged();
  const auto placed = [&](std::size_t frame) {
    return place_shapes(staging.meshes, scene.frames[frame]);
  };
  EXPECT_EQ(placed(0)[0].vertices, scene.header.shapes[0].vertices);
  EXPECT_EQ(placed(1)[0].vertices, raised);
  EXPECT_NEAR((placed(0)[0].normal(0) - Vec3d::UnitY()).norm(), 0, 1e-12);
  EXPECT_NEAR((placed(1)[0].normal(0) - Vec3d::UnitZ()).norm(), 0, 1e-12);
  EXPECT_EQ(placed(1)[1].vertices, scene.header.shapes[1].vertices);
  // The picture has its faces there.
  const auto faces = sketch_frame(staging, scene.frames[1]).surfaces;
  EXPECT_TRUE(std::ranges::any_of(faces, [](const Surface& one) {
    return std::ranges::any_of(
        one.polygon, [](const Vec3d& corner) { return (corner - Vec3d(-1, 1, 0)).norm() < 1e-9; });
  }));
}

TEST(MeshPictures, BoxesOfADeformedMeshesTreeStandInItsPose) {
  TwoSurfaces scene;
  scene.view.layers = {Layer::Tree};
  scene.frames[0].poses[0].second.position = {0, 5, 0};
  scene.frames[0].deformed = {
      {"level", scene.header.shapes[0].vertices, "refitted", 3, 2, {{{-1, 0, -1}, {1, 0.5, 1}}}}};
  const Sketch sketch = scene.sketch();
  EXPECT_EQ(sketch.lines.size(), 12u);
  for (const Line& line : sketch.lines) EXPECT_GE(line.from.y(), 5);
  EXPECT_THAT(legend_texts(sketch), Contains("boxes of the tree, four levels down"));
  // The largest of several boxes is highlighted, with its volume.
  scene.frames[0].deformed[0].boxes.push_back({{-1, 0, -1}, {1, 1, 1}});
  const Sketch several = scene.sketch();
  EXPECT_EQ(several.lines.size(), 3u * 12);
  EXPECT_THAT(legend_texts(several), Contains("largest of them"));
  EXPECT_TRUE(std::ranges::any_of(several.labels, [](const Label& label) {
    return label.text == "4.00 m³" || label.text == "4 m³";
  }));
}

TEST(MeshPictures, CandidatesAreShownWithoutTheBoxesThatLedToThem) {
  TwoSurfaces scene;
  scene.view.layers = {Layer::Candidates};
  trace::Tree& tree = scene.frames[0].pairs[0].tree.emplace();
  tree.shape = "level";
  tree.box = {{0, -1, -1}, {0.1, 1, 1}};
  tree.visits = {{{{-1, 0, -1}, {1, 0, 1}}, 0, true, true}};
  tree.candidates = {1, 7};  // the mesh has two
  const Sketch sketch = scene.sketch();
  EXPECT_EQ(surfaces_of(sketch, kClipPolygon), 1);
  EXPECT_EQ(sketch.surfaces.size(), 1u);
  EXPECT_EQ(sketch.lines.size(), 3u + 12u) << "its sides, and the box that asked";
  EXPECT_THAT(legend_texts(sketch),
              UnorderedElementsAre("candidate triangle", "box of the shape that asks"));
  scene.view.layers = {Layer::Candidates, Layer::Bounds};
  EXPECT_THAT(legend_texts(scene.sketch()), Not(Contains("box of the shape that asks")));
}

TEST(MeshPictures, ATreeShowsCulledAndTestedBoxesAndNoTwoShareASide) {
  TwoSurfaces scene;
  scene.view.layers = {Layer::Tree};
  trace::Tree& tree = scene.frames[0].pairs[0].tree.emplace();
  tree.shape = "level";
  tree.box = {{0, -1, -1}, {0.1, 1, 1}};
  const trace::Box left{{-1, 0, -1}, {0, 0, 1}}, right{{0, 0, -1}, {1, 0, 1}};
  tree.visits = {
      {{left.lower, right.upper}, 0, false, true}, {left, 1, true, false}, {right, 1, true, true}};
  const Sketch sketch = scene.sketch();
  EXPECT_THAT(legend_texts(sketch),
              UnorderedElementsAre("box of triangles that are tested",
                                   "box left out, with all below", "box of the shape that asks"));
  double before = -1, behind = 1;  // the sides that the two would share
  for (const Line& line : sketch.lines) {
    if (crate_sample::same(line.style.color, kDropped)) before = std::max(before, line.from.x());
    if (crate_sample::same(line.style.color, kBox)) behind = std::min(behind, line.from.x());
  }
  EXPECT_LT(before, 0);
  EXPECT_GT(behind, 0);
}

class MeshPanels : public ::testing::Test {
 protected:
  TwoSurfaces scene;

  Drawing laid_out(Panel panel, std::size_t frame = 0) {
    scene.view.panels = {panel};
    const Staging staging = scene.staged();
    Drawing drawing;
    Sheet sheet({900, 80, 332, 500}, staging.layout.scale, drawing);
    make_panels(staging, scene.frames).at(0).content->lay_out({frame}, sheet);
    return drawing;
  }
};

TEST_F(MeshPanels, TheMatrixHasABlockForEachPairOfNodesThatDecidedSomething) {
  // Two triangles against two: the roots overlap, and so does one of four pairs of leaves.
  scene.frames[0].pairs[0].query->node_pairs = {
      {0, 2, 0, 2, true, false}, {0, 1, 0, 1, true, true},  {0, 1, 1, 1, false, true},
      {1, 1, 0, 1, false, true}, {1, 1, 1, 1, false, true},
  };
  const Drawing drawing = laid_out(Panel::NodePairs);
  int green = 0, grey = 0;
  float right = 0, bottom = 0;
  for (const Primitive& primitive : drawing.primitives) {
    const Fill* fill = std::get_if<Fill>(&primitive);
    if (fill == nullptr) continue;
    green += crate_sample::same(fill->color, kClipPolygon);
    grey += crate_sample::same(fill->color, kDropped);
    for (const Point2& corner : fill->polygon) {
      right = std::max(right, corner.x);
      bottom = std::max(bottom, corner.y);
    }
  }
  EXPECT_EQ(green, 1);
  EXPECT_EQ(grey, 3);
  EXPECT_LE(right, 1232.5);
  EXPECT_LE(bottom, 580);
  EXPECT_THAT(crate_sample::texts(drawing),
              AllOf(Contains("5 pairs of boxes"), Contains("75 % of 4 pairs, grey"),
                    Contains("1 pairs of triangles, green")));
}

TEST_F(MeshPanels, WithoutTwoMeshesTheMatrixHasANote) {
  EXPECT_THAT(crate_sample::texts(laid_out(Panel::NodePairs)),
              Contains(HasSubstr("does not apply")));
}

TEST_F(MeshPanels, TreeCostIsCountedForAQueriedPairAndEstimatedOtherwise) {
  for (int k = 0; k < 3; ++k) {
    if (k > 0) scene.add_frame();
    trace::Frame& frame = scene.frames.back();
    frame.deformed = {{"level", scene.header.shapes[0].vertices, "refitted", 30.0 + k, 30, {}},
                      {"wall", scene.header.shapes[1].vertices, "rebuilt", 20.0, 20, {}}};
    frame.pairs[0].query->trees = trace::TreeCounts{100 + k, 10, 4};
  }
  const std::vector<std::string> all = crate_sample::texts(laid_out(Panel::TreeCost, 2));
  EXPECT_THAT(all,
              AllOf(Contains("102"), Contains("pairs of boxes compared"), Not(Contains("32"))));
  for (trace::Frame& frame : scene.frames) frame.pairs[0].query->trees.reset();
  EXPECT_THAT(crate_sample::texts(laid_out(Panel::TreeCost, 2)),
              AllOf(Contains("level"), Contains("wall"), Contains("32"), Contains("20"),
                    Contains("boxes a query is expected to test")));
}

TEST(MeshPictures, DisplacementsAreArrowsOfOneScale) {
  TwoSurfaces scene;
  scene.view.layers = {Layer::Shapes, Layer::Velocities};
  EXPECT_THAT(scene.sketch().arrows, testing::IsEmpty()) << "nobody asked what they meet";
  trace::Impact& impact = scene.hit();
  impact.travel_a.displacement = {2, 0, 0};
  impact.travel_b.displacement = {0, -1, 0};
  const Sketch sketch = scene.sketch();
  ASSERT_EQ(sketch.arrows.size(), 2u);
  EXPECT_NEAR(sketch.arrows[0].pixels, 2 * sketch.arrows[1].pixels, 1e-3);
  EXPECT_EQ(sketch.arrows[1].direction, Vec3d(0, -1, 0));
  EXPECT_THAT(mapped(sketch.labels, &Label::text), AllOf(Contains("2.00 m"), Contains("1.00 m")));
  EXPECT_THAT(legend_texts(sketch), Contains("way through the step, not to scale"));
}

TEST(MeshPictures, ANormalThatLeansFromItsFlatSurfaceIsMarkedWithItsAngle) {
  TwoSurfaces scene;
  scene.view.layers = {Layer::Shapes, Layer::Normals};
  trace::Pair& pair = scene.frames[0].pairs[0];
  const Vec3d leaning(0.5, std::sqrt(0.75), 0);
  pair.manifolds = {{Vec3d::UnitY(), "", 0, {{{0.2, 0, 0.1}, -0.01, ""}}},
                    {leaning, "", 1, {{{0, 0, 0}, -0.01, ""}}}};
  const auto labels = [&] { return mapped(scene.sketch().labels, &Label::text); };
  EXPECT_THAT(labels(), Contains("leans 30°"));
  pair.manifolds.erase(pair.manifolds.begin());
  EXPECT_THAT(labels(), Not(Contains("leans 30°"))) << "alone it may be that of an edge";
}

TEST(MeshPictures, OnlyTheMatrixNeedsNodePairs) {
  View view;
  view.layers = {};
  EXPECT_FALSE(stages_shown({view}).node_pairs);
  view.panels = {Panel::NodePairs};
  EXPECT_TRUE(stages_shown({view}).node_pairs);
}

}  // namespace
}  // namespace contactscope::draw
