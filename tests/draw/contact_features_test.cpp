#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "draw/crate_on_slab.h"
#include "draw/scene/palette.h"

/// Contact features, exit paths, and the three queries of the separating axis test.
namespace contactscope::draw {
namespace {

using crate_sample::CrateOnSlab;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<std::string> feature_labels(const Sketch& sketch) {
  std::vector<std::string> all;
  for (const Label& label : sketch.labels) all.push_back(label.text);
  return all;
}

struct TouchingCrate : CrateOnSlab {
  explicit TouchingCrate(const char* type) {
    view.layers = {Layer::Features};
    manifold().axis = "face_a";
    manifold().type = type;
  }
};

TEST(Features, AnEdgeOnAFaceIsTheLowestEdgeOfTheOtherShape) {
  TouchingCrate scene("edge-face");
  const Vec3d axis = Vec3d::UnitX();
  scene.frames[0].poses[1].second.rotation = Quatd(Eigen::AngleAxisd(0.1, axis));
  const Sketch sketch = scene.sketch();
  ASSERT_EQ(sketch.lines.size(), 1u);
  EXPECT_TRUE(crate_sample::same(sketch.lines[0].style.color, kIncidentFace));
  const double lowest = 0.498 - 0.5 * (std::cos(0.1) + std::sin(0.1));
  EXPECT_NEAR(sketch.lines[0].from.y(), lowest, 1e-9);
  EXPECT_NEAR(sketch.lines[0].to.y(), lowest, 1e-9);
}

TEST(Features, AFaceIsOutlinedAndACornerRinged) {
  EXPECT_EQ(TouchingCrate("face-face").sketch().surfaces.size(), 1u);
  const Sketch corner = TouchingCrate("point-face").sketch();
  ASSERT_EQ(corner.marks.size(), 2u);  // filled, where no contact point is drawn
  EXPECT_EQ(corner.marks[0].kind, MarkKind::WideRing);
  EXPECT_EQ(corner.marks[1].kind, MarkKind::Dot);
}

TEST(Features, ClosestPointsOfTwoEdgesShowBothAsCrossedOnesDo) {
  for (const char* axis : {"closest_points", "edge_edge"}) {
    TouchingCrate scene("edge-edge");
    scene.manifold().axis = axis;
    scene.manifold().points.front().id = "a:e0 b:e1";
    for (trace::Shape& shape : scene.header.shapes) shape.edges = {{0, 1}, {1, 2}};
    const Sketch sketch = scene.sketch();
    ASSERT_EQ(sketch.lines.size(), 2u) << axis;
    for (const Line& line : sketch.lines)
      EXPECT_TRUE(crate_sample::same(line.style.color, kAxis)) << axis;
  }
}

TEST(Features, AnUnlabelledPairIsNamedByItsFeatures) {
  TouchingCrate scene("edge-face");
  EXPECT_THAT(feature_labels(scene.sketch()), Contains("edge on face: 2 points"));
  scene.pair().label = "mine";
  EXPECT_THAT(feature_labels(scene.sketch()), ElementsAre("mine"));
  scene.pair().label.clear();
  scene.view.layers = {Layer::Shapes};
  EXPECT_THAT(feature_labels(scene.sketch()), Not(Contains(HasSubstr("edge on face"))));
}

struct DeepCrate : CrateOnSlab {
  DeepCrate() { view.layers = {Layer::Exits}; }
};

TEST(Exits, AreTheThreeShortestEachAsLongAsItsOverlap) {
  DeepCrate scene;
  scene.frames[0].poses[1].second.position = {0.9, 0.25, 0};  // 0.25 m up, 0.6 m to the side
  const Sketch sketch = scene.sketch();
  ASSERT_EQ(sketch.arrows.size(), 3u);
  std::vector<double> lengths;
  for (const Arrow& arrow : sketch.arrows) lengths.push_back((*arrow.to - arrow.from).norm());
  EXPECT_NEAR(lengths[0], 0.25, 1e-9);
  EXPECT_NEAR(lengths[1], 0.6, 1e-9);
  EXPECT_NEAR(lengths[2], 1.15, 1e-9);  // down: 0.4 + 0.75
  EXPECT_TRUE((*sketch.arrows[0].to - sketch.arrows[0].from).normalized().isApprox(Vec3d::UnitY()));
  EXPECT_GT(sketch.arrows[0].width, sketch.arrows[1].width);  // along the contact's normal
}

TEST(Exits, TheOneThatIsTakenLeadsToWhereTheShapesJustTouch) {
  DeepCrate scene;
  scene.frames[0].poses[1].second.position = {0.9, 0.25, 0};
  const Sketch sketch = scene.sketch();
  ASSERT_FALSE(sketch.lines.empty());
  double lowest = 1e300, highest = -1e300;
  for (const Line& line : sketch.lines) {
    EXPECT_TRUE(line.style.dashed);
    lowest = std::min({lowest, line.from.y(), line.to.y()});
    highest = std::max({highest, line.from.y(), line.to.y()});
  }
  EXPECT_NEAR(lowest, 0, 1e-9);  // on the slab's upper face, and as high as the crate is
  EXPECT_NEAR(highest, 1, 1e-9);
}

TEST(Exits, SeparatedShapesHaveNone) {
  DeepCrate scene;
  scene.frames[0].poses[1].second.position = {0, 0.51, 0};
  EXPECT_TRUE(scene.sketch().arrows.empty());
  EXPECT_TRUE(scene.sketch().lines.empty());
}

struct QueriedCrate : CrateOnSlab {
  QueriedCrate() {
    view.layers = {Layer::SatQueries};
    view.eye = Vec3d(0, 1, 5);
    view.target = Vec3d::Zero();
    view.orthographic_height = 3.0;
    trace::Sat& sat = pair().sat.emplace();
    sat.chosen = "face_a";
    sat.face_a = trace::FaceAxis{2, -0.002, Vec3d::UnitY(), {0.5, -0.002, 0.5}};
    sat.face_b = trace::FaceAxis{3, -0.003, Vec3d::UnitY(), {0.5, 0, 0.5}};
  }
};

TEST(SatQueries, StandInThreeColumnsThatShowTheSame) {
  QueriedCrate scene;
  const Staging staging = scene.staged();
  const Sketch sketch = sketch_frame(staging, scene.frames[0]);
  EXPECT_THAT(feature_labels(sketch),
              testing::IsSupersetOf({"faces of A", "faces of B", "pairs of edges",
                                     "overlap 2.00 mm: the least, chosen", "overlap 3.00 mm",
                                     "not tested"}));
  EXPECT_TRUE(std::ranges::any_of(sketch.legend.sorted(), [](const LegendEntry& entry) {
    return entry.text == "parallel plane through the support point";
  }));
  // The same corner of the slab in each column: a third of the view between them, at one height.
  std::vector<Point2> places;
  for (const Label& label : sketch.labels)
    if (label.text.find("of") != std::string::npos || label.text == "not tested")
      places.push_back(*staging.camera.project(label.at));
  const double third = staging.layout.view.width / 3;
  EXPECT_NEAR(places[1].x - places[0].x, third, 0.5);
  EXPECT_NEAR(places[1].y, places[0].y, 0.5);
}

TEST(Trail, ALongPathHasSkinsAllAlongIt) {
  CrateOnSlab scene;
  scene.frames.assign(40, scene.frames[0]);
  for (int f = 0; f < 40; ++f) {
    scene.frames[static_cast<std::size_t>(f)].frame = f;
    scene.frames[static_cast<std::size_t>(f)].poses[1].second.position.x() = 0.05 * f;
  }
  scene.view.layers = {Layer::Trail};
  const Staging staging = scene.staged();
  double first = 1e300;
  int paths = 0;
  for (const Line& line : sketch_frame(staging, scene.frames.back()).lines) {
    if (!line.style.dashed) continue;
    first = std::min(first, line.from.x());
    ++paths;
  }
  EXPECT_NEAR(first, 0, 1e-12) << "where the path begins";
  EXPECT_GE(paths, 1);
  EXPECT_LE(paths, 12);
}

TEST(SatQueries, AGapEndsTheTest) {
  QueriedCrate scene;
  scene.pair().state = "separated";
  scene.pair().sat->face_a->separation = 0.001;
  EXPECT_THAT(feature_labels(scene.sketch()), Contains("gap 1.00 mm: ends the test"));
}

}  // namespace
}  // namespace contactscope::draw
