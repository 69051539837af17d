// Forces, margins and unusual normals in pictures, from facts by hand.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "draw/crate_on_slab.h"
#include "draw/scene/pairs.h"
#include "draw/scene/palette.h"

namespace contactscope::draw {
namespace {

using crate_sample::CrateOnSlab;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

std::vector<std::string> words_of(const Sketch& sketch) {
  std::vector<std::string> all;
  for (const Label& label : sketch.labels) all.push_back(label.text);
  return all;
}

std::vector<std::string> legend_words(const Sketch& sketch) {
  std::vector<std::string> all;
  for (const LegendEntry& entry : sketch.legend.sorted()) all.push_back(entry.text);
  return all;
}

/// Two frames a tenth of a second after each other, with an impulse at each of the crate's points.
struct PushedCrate : CrateOnSlab {
  explicit PushedCrate(double newton_seconds) {
    solve(newton_seconds);
    frames.push_back(frames[0]);
    frames[1].frame = 1;
    frames[1].time = 0.1;
    view.layers = {Layer::Shapes, Layer::Impulses, Layer::Loads, Layer::Friction};
  }
  Sketch drawn() const { return sketch_frame(staged(), frames[0]); }
};

std::vector<Line> brackets(const Sketch& sketch) {
  std::vector<Line> found;
  std::ranges::copy_if(sketch.lines, std::back_inserter(found), [](const Line& line) {
    return line.keep_clear && line.style.width == 1.8f &&
           crate_sample::same(line.style.color, kImpulse);
  });
  return found;
}

TEST(Loads, TheSumOfSeveralPointsStandsAtABracketOverAllOfThem) {
  const PushedCrate scene(1);
  const Sketch sketch = scene.drawn();
  EXPECT_THAT(words_of(sketch), Contains("Σ 20.0 N"));
  EXPECT_THAT(words_of(sketch), Contains("friction Σ 5.00 N"));
  EXPECT_THAT(words_of(sketch), Not(Contains("20.0 N")));
  const std::vector<Line> bracket = brackets(sketch);
  ASSERT_EQ(bracket.size(), 4u) << "an arm, the back, an arm, and the tip";
  // The back spans both points, 1 m from each other, seen at an angle, and a little more.
  const double back = (bracket[1].to - bracket[1].from).norm();
  EXPECT_GT(back, 0.9);
  EXPECT_LT(back, 1.3);
  EXPECT_GT((bracket[1].to - bracket[1].from).normalized().dot(Vec3d::UnitX()), 0.8);
}

TEST(Loads, TheArrowOfASinglePointHasTheValue) {
  PushedCrate scene(1);
  for (trace::Frame& frame : scene.frames) frame.pairs[0].manifolds[0].points.resize(1);
  const Sketch sketch = scene.drawn();
  EXPECT_THAT(words_of(sketch), Contains("10.0 N"));
  EXPECT_THAT(words_of(sketch), Not(Contains(HasSubstr("Σ"))));
  EXPECT_THAT(brackets(sketch), IsEmpty());
}

TEST(Loads, PointsThatCoincideInViewShareOneArrowOfTheSum) {
  PushedCrate scene(1);
  scene.view.eye = Vec3d(5, 0, 0.5);
  scene.view.target = Vec3d(0, 0, 0.5);
  scene.view.orthographic_height = 3;
  const auto arrows = [&] {
    const Sketch sketch = scene.drawn();
    return std::ranges::count_if(sketch.arrows, [](const Arrow& arrow) {
      return crate_sample::same(arrow.color, kImpulse);
    });
  };
  EXPECT_THAT(words_of(scene.drawn()), Contains("20.0 N"));
  EXPECT_THAT(brackets(scene.drawn()), IsEmpty());
  EXPECT_EQ(arrows(), 1);
  scene.view.impulse_scale = 1e-5;
  EXPECT_THAT(words_of(scene.drawn()), Not(Contains("20.0 N"))) << "a number of no arrow";
}

TEST(Impulses, ASeparatedPointWithoutImpulseHasNoMark) {
  PushedCrate scene(0);
  scene.view.layers = {Layer::Shapes, Layer::Impulses};
  scene.view.impulse_scale = 0.1;
  const auto nodes = [&] {
    const Sketch sketch = scene.drawn();
    return std::ranges::count(sketch.marks, MarkKind::Node, &Mark::kind);
  };
  scene.manifold().points[0].impulse->normal = 1;
  EXPECT_EQ(nodes(), 2) << "what touches is a contact point all the same";
  scene.manifold().points[1].separation = 0.1;
  EXPECT_EQ(nodes(), 1);
}

TEST(Friction, APointWithFarLessThanAnotherHasNoArrow) {
  PushedCrate scene(1);
  scene.view.layers = {Layer::Shapes, Layer::Impulses, Layer::Friction};
  const auto arrows = [&] {
    const Sketch sketch = scene.drawn();
    return std::ranges::count_if(sketch.arrows, [](const Arrow& arrow) { return arrow.open; });
  };
  EXPECT_EQ(arrows(), 2);
  scene.frames[0].pairs[0].manifolds[0].points[0].impulse->friction *= 0.3;
  EXPECT_EQ(arrows(), 1);
}

TEST(Loads, NothingThatPushesHasNoBracket) {
  const PushedCrate scene(0);
  EXPECT_THAT(brackets(scene.drawn()), IsEmpty());
}

/// A mesh's manifolds, one point each; the last ones lie down.
struct OnManyTriangles : CrateOnSlab {
  explicit OnManyTriangles(std::size_t lying, std::size_t count = 8) {
    pair().manifolds.assign(count, manifold());
    for (std::size_t i = 0; i < count; ++i) {
      trace::Manifold& one = pair().manifolds[i];
      one.points.resize(1);
      one.points[0].position = {-0.4 + 0.1 * static_cast<double>(i), 0, 0.3};
      if (i + lying >= count) one.normal = Vec3d::UnitX();
    }
    view.layers = {Layer::Shapes, Layer::Contacts, Layer::Normals};
  }
};

TEST(UsualNormal, IsThatOfMostWhereSomeHaveAnother) {
  EXPECT_EQ(usual_normal(OnManyTriangles(0).frames[0]), std::nullopt) << "all agree";
  EXPECT_EQ(usual_normal(OnManyTriangles(4).frames[0]), std::nullopt) << "half and half";
  EXPECT_EQ(usual_normal(OnManyTriangles(2).frames[0]), Vec3d(Vec3d::UnitY()));
  EXPECT_EQ(usual_normal(OnManyTriangles(1, 2).frames[0]), std::nullopt) << "two are no crowd";
}

TEST(UsualNormal, StepsBackAndTheOthersStandOut) {
  const OnManyTriangles scene(2);
  const Sketch sketch = scene.sketch();
  float grey = 0, black = 0;
  std::size_t greys = 0, blacks = 0;
  for (const Arrow& arrow : sketch.arrows) {
    if (crate_sample::same(arrow.color, kDropped)) ++greys, grey = arrow.pixels;
    if (crate_sample::same(arrow.color, kNormal)) ++blacks, black = arrow.pixels;
  }
  EXPECT_EQ(greys, 6u);
  EXPECT_EQ(blacks, 2u);
  EXPECT_GT(black, 2 * grey);
  const auto dots = std::ranges::count_if(
      sketch.marks, [](const Mark& mark) { return mark.kind == MarkKind::Dot; });
  EXPECT_EQ(dots, 2) << "points of the usual ones are specks";
  EXPECT_THAT(legend_words(sketch), Contains("normal and points as most have them"));
  EXPECT_THAT(legend_words(OnManyTriangles(0).sketch()), Contains("normal, from A to B"));
}

TEST(SharedCorners, ShowTheNumberOfPointsAtADot) {
  OnManyTriangles scene(0);
  scene.pair().manifolds[1].points[0].position = scene.pair().manifolds[0].points[0].position;
  EXPECT_THAT(words_of(scene.sketch()), Contains("×2"));
  EXPECT_THAT(words_of(OnManyTriangles(0).sketch()), Not(Contains("×2")));
}

TEST(Gaps, AreNotDrawnAsManyTimesAsLongAsOverlapsWhereTheyWouldLeaveTheirShapes) {
  CrateOnSlab scene;
  scene.manifold().points[0].separation = -0.01;
  scene.manifold().points[1].separation = 0.3;
  const SequenceScales scales = scene.staged().scales;
  EXPECT_GT(scales.overlap, 1) << "1 cm of a crate of 1 m";
  EXPECT_EQ(scales.gap, 1);
  scene.manifold().points[1].separation = 0.001;
  EXPECT_EQ(scene.staged().scales.gap, scene.staged().scales.overlap)
      << "narrower than the overlap";
  for (trace::Point& point : scene.manifold().points) point.separation = -1e-6;
  EXPECT_GT(scene.staged().scales.overlap, 20);
  scene.manifold().points[1].separation = 0.3;
  EXPECT_EQ(scene.staged().scales.overlap, 1) << "beside that gap a touch";
}

TEST(Gaps, HaveAWhiskerAtTheirOwnScale) {
  CrateOnSlab scene;
  scene.manifold().points[1].separation = 0.3;
  const Staging staging = scene.staged();
  const Scene drawn = scene_of(staging, scene.frames[0]);
  const trace::Pair& pair = scene.frames[0].pairs[0];
  const auto [from, to] =
      whisker_at(drawn, pair, {&pair.manifolds[0], &pair.manifolds[0].points[1]});
  EXPECT_NEAR((to - from).norm(), 0.3, 1e-12);
}

TEST(Ahead, ShowsTheMarginThatContactsAreKeptWithin) {
  PushedCrate scene(1);
  scene.view.layers = {Layer::Shapes, Layer::Ahead};
  scene.view.focus = Focus::Shapes;
  for (trace::Frame& frame : scene.frames) {
    frame.solver->speculative_margin = 0.2;
    frame.pairs[0].manifolds[0].points.resize(1);
    frame.pairs[0].manifolds[0].points[0].separation = 0.1;
  }
  EXPECT_THAT(words_of(scene.drawn()), Contains("speculative margin 0.200 m"));
  for (trace::Frame& frame : scene.frames) frame.solver->speculative_margin = 0;
  EXPECT_THAT(words_of(scene.drawn()), Not(Contains(HasSubstr("margin"))));
}

}  // namespace
}  // namespace contactscope::draw
