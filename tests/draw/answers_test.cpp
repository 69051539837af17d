// Pictures of queries other than manifolds, from facts by hand.

#include "draw/scene/answers.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "crate_on_slab.h"
#include "draw/panels/panel.h"
#include "draw/scene/palette.h"
#include "inside.h"

namespace contactscope::draw {
namespace {

using crate_sample::CrateOnSlab;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

trace::TestedAxis axis(const char* kind, int a, int b, const Vec3d& direction, double gap) {
  trace::TestedAxis result;
  result.kind = kind;
  result.a = a;
  result.b = b;
  result.direction = direction;
  result.interval_a = {-1, -0.5 * gap};
  result.interval_b = {0.5 * gap, 1};
  result.gap = gap;
  result.separates = gap > 0;
  return result;
}

/// The crate on the slab, with a query of oriented boxes.
struct AskedCrate : CrateOnSlab {
  explicit AskedCrate(bool bounds_overlap, bool shapes_overlap) {
    trace::Pair& asked = pair();
    asked.manifolds.clear();
    asked.state = bounds_overlap ? "touching" : "separated";
    asked.overlap = bounds_overlap;
    trace::Query& query = asked.query.emplace();
    query.asked = "overlap";
    query.comparison = "inclusive";
    query.bounds = query.method = "obb";
    query.gap = bounds_overlap ? -0.002 : 0.12;
    query.bounds_a = {.center = {0, -0.2, 0}, .half_extents = Vec3d(1, 0.2, 1)};
    query.bounds_b = {.center = {0, 0.498, 0}, .radius = 0.9};
    query.axes = {axis("face_a", 1, -1, Vec3d::UnitY(), *query.gap),
                  axis("edges", 0, 2, Vec3d::UnitX(), -0.5)};
    query.axes[1].length = 1e-6;
    query.shapes = {shapes_overlap, 0.12};
  }
  trace::Query& query() { return *pair().query; }
};

TEST(Answers, AreSaidInWords) {
  AskedCrate asked(true, false);
  EXPECT_EQ(spell_question(asked.query()), "do the oriented boxes overlap, touching included?");
  EXPECT_EQ(spell_answer(asked.pair()),
            "yes, though the shapes are 0.120 m apart: a false positive");
  EXPECT_EQ(answer_kind(asked.pair()), AnswerKind::FalsePositive);
  asked.query().shapes->overlap = true;
  EXPECT_EQ(answer_kind(asked.pair()), AnswerKind::Yes);
  EXPECT_EQ(spell_answer(asked.pair()), "yes, overlap 2.00 mm");
  asked.pair().overlap = false;
  EXPECT_EQ(spell_answer(asked.pair()), "no, though the shapes overlap: a miss");
  asked.pair().overlap = true;
  asked.query().comparison = "exclusive";
  EXPECT_EQ(spell_question(asked.query()), "do the oriented boxes overlap, touching left out?");
  asked.query().tolerance = 0.02;
  EXPECT_THAT(spell_question(asked.query()), HasSubstr("within 20.0 mm"));
  asked.query().asked = "distance";
  EXPECT_EQ(spell_question(asked.query()), "how far apart are the oriented boxes?");
  EXPECT_EQ(spell_answer(asked.pair()), "0 m: they overlap");
  asked.query().gap = 0.12;
  EXPECT_EQ(spell_answer(asked.pair()), "gap 0.120 m");
  asked.query().gap = 0.0;
  EXPECT_EQ(spell_answer(asked.pair()), "0 m: they touch");
  EXPECT_EQ(spell_axis(asked.query(), asked.query().axes[1]), "A's x × B's z");
}

TEST(Answers, OfMeshesTellWhatWasFound) {
  AskedCrate asked(true, true);
  asked.query() = {};
  asked.query().asked = "overlap";
  asked.query().containment = {"outside", "inside"};
  EXPECT_EQ(spell_answer(asked.pair()), "yes: crate is inside slab");
  asked.pair().overlap = false;
  asked.query().containment = {"open", "unknown"};
  EXPECT_THAT(spell_answer(asked.pair()), HasSubstr("slab has holes"));
  asked.query().containment.reset();
  asked.pair().overlap = true;
  asked.pair().intersections.resize(3);
  EXPECT_EQ(spell_answer(asked.pair()), "yes: 3 pairs of triangles meet");
  asked.pair().overlap = false;
  EXPECT_EQ(spell_answer(asked.pair()), "no: 3 pairs of triangles touch, none cross");
  asked.pair().intersections.resize(1);
  EXPECT_EQ(spell_answer(asked.pair()), "no: 1 pair of triangles touches, none cross");
}

/// Number of lines and curves of this colour in the sketch.
int lines_in(const Sketch& sketch, const Color& color) {
  const auto same = [&](const auto& line) {
    return line.style.color.r == color.r && line.style.color.g == color.g &&
           line.style.color.b == color.b;
  };
  return static_cast<int>(std::ranges::count_if(sketch.lines, same) +
                          std::ranges::count_if(sketch.curves, same));
}

TEST(Answers, ColourTheBoundsThatWereAsked) {
  for (const auto& [bounds, shapes, kind] : {std::tuple{true, true, AnswerKind::Yes},
                                             {true, false, AnswerKind::FalsePositive},
                                             {false, false, AnswerKind::No},
                                             {false, true, AnswerKind::Missed}}) {
    AskedCrate asked(bounds, shapes);
    asked.view.layers = {Layer::Volumes};
    const Staging staging = asked.staged();
    const Sketch sketch = sketch_frame(staging, asked.frames[0]);
    EXPECT_EQ(lines_in(sketch, answer_color(kind)), 12 + 2) << "a box, and a ball with its horizon";
    EXPECT_EQ(legend_of(staging, asked.frames[0]).listed.size(), 1u);
    // The picture contains both completely.
    for (const auto& volume : {asked.query().bounds_a, asked.query().bounds_b})
      for (const Vec3d& corner : extent_points(*volume)) EXPECT_TRUE(staging.camera.sees(corner));
  }
}

TEST(Answers, OrientedBoxesBesideOthersAreDrawnBroaderInTheirPlace) {
  AskedCrate asked(false, false);
  asked.view.layers = {Layer::Volumes};
  // How far the lines extend, and the width of the widest line in the answer's colour.
  const auto drawn = [&] {
    std::pair<double, float> most{0, 0};
    for (const Line& line : sketch_frame(asked.staged(), asked.frames[0]).lines) {
      most.first = std::max(most.first, line.from.x());
      if (line.style.color.r == answer_color(AnswerKind::No).r)
        most.second = std::max(most.second, line.style.width);
    }
    return most;
  };
  EXPECT_EQ(drawn(), std::pair(1.0, 1.5f));
  trace::Pair boxes = asked.pair();
  boxes.label = "axis-aligned boxes";
  boxes.query->bounds = "aabb";
  asked.frames[0].pairs.push_back(boxes);
  EXPECT_EQ(drawn(), std::pair(1.0, 1.5f))
      << "a box that lies along the axes is both, and drawn once";
  asked.frames[0].pairs.back().query->bounds_a->half_extents = Vec3d(0.9, 0.3, 0.9);
  EXPECT_EQ(drawn(), std::pair(1.0, 2.5f));
}

TEST(Answers, WhatBoundsSayIsToldWhateverTheyWereAsked) {
  for (const auto& [bounds, shapes, words] :
       {std::tuple{true, true, "bounds say yes, as the shapes do"},
        {true, false, "bounds say yes, the shapes no"},
        {false, false, "bounds say no"},
        {false, true, "bounds say no, the shapes yes"}}) {
    AskedCrate asked(bounds, shapes);
    asked.view.layers = {Layer::Volumes};
    EXPECT_EQ(legend_of(asked.staged(), asked.frames[0]).listed[0].text, words);
  }
}

TEST(Answers, ShowAxesThatSeparateAndThoseOfNoise) {
  AskedCrate asked(false, false);
  asked.view.layers = {Layer::TestedAxes};
  Sketch sketch = sketch_frame(asked.staged(), asked.frames[0]);
  ASSERT_EQ(sketch.arrows.size(), 1u);
  EXPECT_EQ(sketch.arrows[0].direction, Vec3d::UnitY());
  EXPECT_EQ(sketch.arrows[0].color.r, kAxis.r);
  EXPECT_EQ(sketch.labels[0].text, "A's y");
  asked.query().axes[0].separates = false;
  sketch = sketch_frame(asked.staged(), asked.frames[0]);
  EXPECT_EQ(sketch.arrows[0].direction, Vec3d::UnitX()) << "noise is of more interest";
  EXPECT_EQ(sketch.labels[0].text, "A's x × B's z, length 1 × 10⁻⁶");
  asked.query().axes[1].length = 0.5;
  sketch = sketch_frame(asked.staged(), asked.frames[0]);
  EXPECT_EQ(sketch.arrows[0].direction, Vec3d::UnitY()) << "else the largest gap";
}

TEST(Answers, ShowTheClosestPoints) {
  AskedCrate asked(false, false);
  asked.query().point_a = Vec3d(0, 0, 0);
  asked.query().point_b = Vec3d(0, 0.12, 0);
  asked.view.layers = {Layer::Answer};
  const Sketch sketch = sketch_frame(asked.staged(), asked.frames[0]);
  EXPECT_EQ(sketch.marks.size(), 2u);
  ASSERT_EQ(sketch.labels.size(), 1u);
  EXPECT_EQ(sketch.labels[0].text, "gap 120 mm");
}

TEST(Answers, OfSeveralDistancesFromAShapeTheShortestIsStrongest) {
  AskedCrate asked(false, false);
  asked.query().point_a = Vec3d(0, 0, 0);
  asked.query().point_b = Vec3d(0, 0.12, 0);
  asked.view.layers = {Layer::Answer};
  trace::Pair farther = asked.pair();
  farther.b = "lamp";
  farther.query->gap = 0.5;
  farther.query->point_b = Vec3d(0, 0.5, 0);
  asked.frames[0].pairs.push_back(farther);
  Sketch sketch = sketch_frame(asked.staged(), asked.frames[0]);
  ASSERT_EQ(sketch.arrows.size(), 2u);
  EXPECT_GT(sketch.arrows[0].width, sketch.arrows[1].width);
  EXPECT_TRUE(sketch.labels[0].bold);
  EXPECT_FALSE(sketch.labels[1].bold);
  asked.frames[0].pairs[1].a = "table";  // of other shapes: no choice
  sketch = sketch_frame(asked.staged(), asked.frames[0]);
  EXPECT_EQ(sketch.arrows[0].width, sketch.arrows[1].width);
}

std::vector<std::string> panel_texts(AskedCrate& asked, Panel panel, std::size_t frame = 0) {
  asked.view.panels = {panel};
  const Staging staging = asked.staged();
  const std::vector<FilledPanel> panels = make_panels(staging, asked.frames);
  EXPECT_EQ(panels.size(), 1u);
  Drawing drawing;
  Sheet sheet({900, 80, 332, 500}, staging.layout.scale, drawing);
  panels.at(0).content->lay_out({.frame = frame}, sheet);
  return crate_sample::texts(drawing);
}

TEST(Answers, PanelsTellThemOverTime) {
  AskedCrate asked(true, false);
  trace::Frame later = asked.frames[0];
  later.frame = 1;
  later.pairs[0].query->shapes->overlap = true;
  asked.frames.push_back(later);
  asked.header.frames = 2;
  EXPECT_THAT(panel_texts(asked, Panel::Answers), Contains("falsely in 1 of 1 frame"));
  EXPECT_THAT(panel_texts(asked, Panel::Answers, 1), Contains("falsely in 1 of 2 frames"));
  const std::vector<std::string> axes = panel_texts(asked, Panel::AxisIntervals);
  EXPECT_THAT(axes, Contains("A's y"));
  EXPECT_THAT(axes, Contains("2.00 mm")) << "below the word overlap, without a sign";
  EXPECT_THAT(axes, Contains("overlap"));
  EXPECT_THAT(panel_texts(asked, Panel::Summary), Contains(HasSubstr("do the oriented boxes")));
}

TEST(Answers, IntervalsAreThoseOfPairsInView) {
  AskedCrate asked(true, false);
  asked.view.eye = Vec3d(0, 1, 5);
  asked.view.target = Vec3d(0, 0, 0);
  EXPECT_THAT(panel_texts(asked, Panel::AxisIntervals), Contains("A's y"));
  asked.view.target = Vec3d(0, 1, 10);
  EXPECT_THAT(panel_texts(asked, Panel::AxisIntervals), Contains(HasSubstr("does not apply")));
}

TEST(Answers, ThePipelineCountsWhatIsAskedBesideWhatIsCollided) {
  AskedCrate asked(true, true);
  trace::Pair apart = asked.pair();
  apart.overlap = false;
  asked.frames[0].pairs.push_back(apart);
  std::vector<std::string> told = panel_texts(asked, Panel::Pipeline);
  EXPECT_THAT(told, ::testing::IsSupersetOf(
                        {"pairs asked, no contacts made", "2", "of these overlap or touch", "1"}));
  EXPECT_THAT(told, Not(Contains("pairs in contact"))) << "nothing is collided";
  trace::Pair collided = CrateOnSlab().pair();
  asked.frames[0].pairs.push_back(collided);
  told = panel_texts(asked, Panel::Pipeline);
  EXPECT_THAT(told, Contains("of these overlap or touch"));
  EXPECT_THAT(told, Contains("pairs in contact"));
  asked.frames[0].pairs = {collided};
  EXPECT_THAT(panel_texts(asked, Panel::Pipeline), Not(Contains("of these overlap or touch")));
}

TEST(Answers, ASummaryShowsAllPairsThatItHasRoomFor) {
  AskedCrate asked(true, true);
  asked.query().asked = "distance";
  asked.query().gap = 0.12;
  for (const char* label : {"second", "third", "fourth"}) {
    asked.frames[0].pairs.push_back(asked.pair());
    asked.frames[0].pairs.back().label = label;
  }
  const std::vector<std::string> told = panel_texts(asked, Panel::Summary);
  EXPECT_THAT(told, Contains("fourth: slab, crate"));
  EXPECT_THAT(told, Not(Contains(HasSubstr("more pair"))));
}

TEST(Answers, PanelsSayWhereTheyDoNotApply) {
  AskedCrate asked(true, false);
  asked.pair().query.reset();
  EXPECT_THAT(panel_texts(asked, Panel::Answers), Contains(HasSubstr("does not apply")));
  EXPECT_THAT(panel_texts(asked, Panel::AxisIntervals), Contains(HasSubstr("does not apply")));
}

}  // namespace
}  // namespace contactscope::draw
