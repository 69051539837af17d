// Pictures of queries other than manifolds, from facts by hand.

#include "draw/scene/pairs.h"

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
struct CrateWithQuery : CrateOnSlab {
  explicit CrateWithQuery(bool bounds_overlap, bool shapes_overlap) {
    trace::Pair& requested = pair();
    requested.manifolds.clear();
    requested.state = bounds_overlap ? "touching" : "separated";
    requested.overlap = bounds_overlap;
    trace::Query& query = requested.query.emplace();
    query.requested = "overlap";
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

TEST(Answers, AreSpelledInWords) {
  CrateWithQuery requested(true, false);
  EXPECT_EQ(spell_question(requested.query()), "do the oriented boxes overlap, touching included?");
  EXPECT_EQ(spell_answer(requested.pair()),
            "yes, though the shapes are 0.120 m apart: a false positive");
  EXPECT_EQ(answer_kind(requested.pair()), AnswerKind::FalsePositive);
  requested.query().shapes->overlap = true;
  EXPECT_EQ(answer_kind(requested.pair()), AnswerKind::Yes);
  EXPECT_EQ(spell_answer(requested.pair()), "yes, overlap 2.00 mm");
  requested.pair().overlap = false;
  EXPECT_EQ(spell_answer(requested.pair()), "no, though the shapes overlap: a miss");
  requested.pair().overlap = true;
  requested.query().comparison = "exclusive";
  EXPECT_EQ(spell_question(requested.query()), "do the oriented boxes overlap, touching left out?");
  requested.query().comparison = "proper";
  EXPECT_EQ(spell_question(requested.query()), "do the oriented boxes overlap, properly?");
  requested.query().tolerance = 0.02;
  EXPECT_THAT(spell_question(requested.query()), HasSubstr("within 20.0 mm"));
  requested.query().requested = "distance";
  EXPECT_EQ(spell_question(requested.query()), "how far apart are the oriented boxes?");
  EXPECT_EQ(spell_answer(requested.pair()), "0 m: they overlap");
  requested.query().gap = 0.12;
  EXPECT_EQ(spell_answer(requested.pair()), "gap 0.120 m");
  requested.query().gap = 0.0;
  EXPECT_EQ(spell_answer(requested.pair()), "0 m: they touch");
  EXPECT_EQ(spell_axis(requested.query(), requested.query().axes[1]), "A's x × B's z");
}

TEST(Answers, MeshAnswersStateTheResult) {
  CrateWithQuery requested(true, true);
  requested.query() = {};
  requested.query().requested = "overlap";
  requested.query().containment = {"outside", "inside"};
  EXPECT_EQ(spell_answer(requested.pair()), "yes: crate is inside slab");
  requested.pair().overlap = false;
  requested.query().containment = {"open", "unknown"};
  EXPECT_THAT(spell_answer(requested.pair()), HasSubstr("slab has holes"));
  requested.query().containment.reset();
  requested.pair().overlap = true;
  requested.pair().intersections.resize(3);
  EXPECT_EQ(spell_answer(requested.pair()), "yes: 3 pairs of triangles meet");
  requested.pair().overlap = false;
  EXPECT_EQ(spell_answer(requested.pair()), "no: 3 pairs of triangles touch, none cross");
  requested.pair().intersections.resize(1);
  EXPECT_EQ(spell_answer(requested.pair()), "no: 1 pair of triangles touches, none cross");
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

TEST(Answers, ColourTheQueriedBounds) {
  for (const auto& [bounds, shapes, kind] : {std::tuple{true, true, AnswerKind::Yes},
                                             {true, false, AnswerKind::FalsePositive},
                                             {false, false, AnswerKind::No},
                                             {false, true, AnswerKind::Missed}}) {
    CrateWithQuery requested(bounds, shapes);
    requested.view.layers = {Layer::Volumes};
    const Staging staging = requested.staged();
    const Sketch sketch = sketch_frame(staging, requested.frames[0]);
    EXPECT_EQ(lines_in(sketch, answer_color(kind)), 12 + 2) << "a box, and a ball with its horizon";
    EXPECT_EQ(legend_of(staging, requested.frames[0]).listed.size(), 1u);
    // The picture contains both completely.
    for (const auto& volume : {requested.query().bounds_a, requested.query().bounds_b})
      for (const Vec3d& corner : extent_points(*volume)) EXPECT_TRUE(staging.camera.sees(corner));
  }
}

TEST(Answers, AToleranceWidensBoundsByHalfOfIt) {
  CrateWithQuery requested(true, true);
  requested.view.layers = {Layer::Volumes};
  EXPECT_EQ(lines_in(sketch_frame(requested.staged(), requested.frames[0]), kMargin), 0);
  requested.pair().query->tolerance = 0.5;
  const Sketch sketch = sketch_frame(requested.staged(), requested.frames[0]);
  EXPECT_EQ(lines_in(sketch, kMargin), 12 + 2);
  Eigen::AlignedBox3d box, wide;
  for (const Line& line : sketch.lines)
    for (const Vec3d& end : {line.from, line.to})
      (line.style.color == kMargin ? wide : box).extend(end);
  EXPECT_LT((wide.max() - box.max() - Vec3d::Constant(0.25)).norm(), 1e-9);
  EXPECT_LT((wide.min() - box.min() + Vec3d::Constant(0.25)).norm(), 1e-9);
}

TEST(Answers, OrientedBoxesAmongOthersAreDrawnBroaderInPlace) {
  CrateWithQuery requested(false, false);
  requested.view.layers = {Layer::Volumes};
  // How far the lines extend, and the width of the widest line in the answer's colour.
  const auto drawn = [&] {
    std::pair<double, float> most{0, 0};
    for (const Line& line : sketch_frame(requested.staged(), requested.frames[0]).lines) {
      most.first = std::max(most.first, line.from.x());
      if (line.style.color.r == answer_color(AnswerKind::No).r)
        most.second = std::max(most.second, line.style.width);
    }
    return most;
  };
  EXPECT_EQ(drawn(), std::pair(1.0, 1.5f));
  trace::Pair boxes = requested.pair();
  boxes.label = "axis-aligned boxes";
  boxes.query->bounds = "aabb";
  requested.frames[0].pairs.push_back(boxes);
  EXPECT_EQ(drawn(), std::pair(1.0, 1.5f))
      << "a box that lies along the axes is both, and drawn once";
  requested.frames[0].pairs.back().query->bounds_a->half_extents = Vec3d(0.9, 0.3, 0.9);
  EXPECT_EQ(drawn(), std::pair(1.0, 2.5f));
}

TEST(Answers, TheResultOfBoundsIsStatedForEveryQuery) {
  for (const auto& [bounds, shapes, words] :
       {std::tuple{true, true, "bounds say yes, as the shapes do"},
        {true, false, "bounds say yes, the shapes no"},
        {false, false, "bounds say no"},
        {false, true, "bounds say no, the shapes yes"}}) {
    CrateWithQuery requested(bounds, shapes);
    requested.view.layers = {Layer::Volumes};
    EXPECT_EQ(legend_of(requested.staged(), requested.frames[0]).listed[0].text, words);
  }
}

TEST(Answers, ShowAxesThatSeparateAndThoseOfNoise) {
  CrateWithQuery requested(false, false);
  requested.view.layers = {Layer::TestedAxes};
  Sketch sketch = sketch_frame(requested.staged(), requested.frames[0]);
  ASSERT_EQ(sketch.arrows.size(), 1u);
  EXPECT_EQ(sketch.arrows[0].direction, Vec3d::UnitY());
  EXPECT_EQ(sketch.arrows[0].color.r, kAxis.r);
  EXPECT_EQ(sketch.labels[0].text, "A's y");
  requested.query().axes[0].separates = false;
  sketch = sketch_frame(requested.staged(), requested.frames[0]);
  EXPECT_EQ(sketch.arrows[0].direction, Vec3d::UnitX()) << "noise is of more interest";
  EXPECT_EQ(sketch.labels[0].text, "A's x × B's z, length 1 × 10⁻⁶");
  requested.query().axes[1].length = 0.5;
  sketch = sketch_frame(requested.staged(), requested.frames[0]);
  EXPECT_EQ(sketch.arrows[0].direction, Vec3d::UnitY()) << "else the largest gap";
}

TEST(Answers, AFaceWinsATieOfAxesWithEdges) {
  CrateWithQuery requested(false, false);
  requested.view.layers = {Layer::TestedAxes};
  const Vec3d leaning = Vec3d(1e-8, 1, 0).normalized();
  requested.query().axes[1] = axis("edges", 0, 2, leaning, *requested.query().gap + 1.5e-8);
  Sketch sketch = sketch_frame(requested.staged(), requested.frames[0]);
  ASSERT_EQ(sketch.arrows.size(), 1u);
  EXPECT_EQ(sketch.labels[0].text, "A's y");
  requested.query().axes[1] = axis("edges", 0, 2, leaning, *requested.query().gap + 1e-3);
  sketch = sketch_frame(requested.staged(), requested.frames[0]);
  EXPECT_EQ(sketch.labels[0].text, "A's x × B's z");
}

TEST(Answers, ShowTheClosestPoints) {
  CrateWithQuery requested(false, false);
  requested.query().point_a = Vec3d(0, 0, 0);
  requested.query().point_b = Vec3d(0, 0.12, 0);
  requested.view.layers = {Layer::Answer};
  const Sketch sketch = sketch_frame(requested.staged(), requested.frames[0]);
  EXPECT_EQ(sketch.marks.size(), 2u);
  ASSERT_EQ(sketch.labels.size(), 1u);
  EXPECT_EQ(sketch.labels[0].text, "gap 120 mm");
}

TEST(Answers, TheShortestOfSeveralDistancesIsStrongest) {
  CrateWithQuery requested(false, false);
  requested.query().point_a = Vec3d(0, 0, 0);
  requested.query().point_b = Vec3d(0, 0.12, 0);
  requested.view.layers = {Layer::Answer};
  trace::Pair farther = requested.pair();
  farther.b = "lamp";
  farther.query->gap = 0.5;
  farther.query->point_b = Vec3d(0, 0.5, 0);
  requested.frames[0].pairs.push_back(farther);
  Sketch sketch = sketch_frame(requested.staged(), requested.frames[0]);
  ASSERT_EQ(sketch.arrows.size(), 2u);
  EXPECT_GT(sketch.arrows[0].width, sketch.arrows[1].width);
  EXPECT_TRUE(sketch.labels[0].bold);
  EXPECT_FALSE(sketch.labels[1].bold);
  requested.frames[0].pairs[1].a = "table";  // of other shapes: no choice
  sketch = sketch_frame(requested.staged(), requested.frames[0]);
  EXPECT_EQ(sketch.arrows[0].width, sketch.arrows[1].width);
}

std::vector<std::string> panel_texts(CrateWithQuery& requested, Panel panel,
                                     std::size_t frame = 0) {
  requested.view.panels = {panel};
  const Staging staging = requested.staged();
  const std::vector<FilledPanel> panels = make_panels(staging, requested.frames);
  EXPECT_EQ(panels.size(), 1u);
  Drawing drawing;
  Sheet sheet({900, 80, 332, 500}, staging.layout.scale, drawing);
  panels.at(0).content->lay_out({.frame = frame}, sheet);
  return crate_sample::texts(drawing);
}

TEST(Answers, PanelsShowThemOverTime) {
  CrateWithQuery requested(true, false);
  trace::Frame later = requested.frames[0];
  later.frame = 1;
  later.pairs[0].query->shapes->overlap = true;
  requested.frames.push_back(later);
  requested.header.frames = 2;
  EXPECT_THAT(panel_texts(requested, Panel::Answers), Contains("falsely in 1 of 1 frame"));
  EXPECT_THAT(panel_texts(requested, Panel::Answers, 1), Contains("falsely in 1 of 2 frames"));
  const std::vector<std::string> axes = panel_texts(requested, Panel::AxisIntervals);
  EXPECT_THAT(axes, Contains("A's y"));
  EXPECT_THAT(axes, Contains("2.00 mm")) << "below the word overlap, without a sign";
  EXPECT_THAT(axes, Contains("overlap"));
  EXPECT_THAT(panel_texts(requested, Panel::Summary), Contains(HasSubstr("do the oriented boxes")));
}

TEST(Answers, IntervalsAreThoseOfPairsInView) {
  CrateWithQuery requested(true, false);
  requested.view.eye = Vec3d(0, 1, 5);
  requested.view.target = Vec3d(0, 0, 0);
  EXPECT_THAT(panel_texts(requested, Panel::AxisIntervals), Contains("A's y"));
  requested.view.target = Vec3d(0, 1, 10);
  EXPECT_THAT(panel_texts(requested, Panel::AxisIntervals), Contains(HasSubstr("does not apply")));
}

TEST(Answers, ThePipelineCountsQueriesNextToCollisions) {
  CrateWithQuery requested(true, true);
  trace::Pair separation = requested.pair();
  separation.overlap = false;
  requested.frames[0].pairs.push_back(separation);
  std::vector<std::string> record = panel_texts(requested, Panel::Pipeline);
  EXPECT_THAT(record, ::testing::IsSupersetOf({"pairs asked, no contacts made", "2",
                                               "of these overlap or touch", "1"}));
  EXPECT_THAT(record, Not(Contains("pairs in contact"))) << "nothing is collided";
  trace::Pair collided = CrateOnSlab().pair();
  requested.frames[0].pairs.push_back(collided);
  record = panel_texts(requested, Panel::Pipeline);
  EXPECT_THAT(record, Contains("of these overlap or touch"));
  EXPECT_THAT(record, Contains("pairs in contact"));
  requested.frames[0].pairs = {collided};
  EXPECT_THAT(panel_texts(requested, Panel::Pipeline), Not(Contains("of these overlap or touch")));
}

TEST(Answers, ASummaryShowsAllPairsThatItHasRoomFor) {
  CrateWithQuery requested(true, true);
  requested.query().requested = "distance";
  requested.query().gap = 0.12;
  for (const char* label : {"second", "third", "fourth"}) {
    requested.frames[0].pairs.push_back(requested.pair());
    requested.frames[0].pairs.back().label = label;
  }
  const std::vector<std::string> record = panel_texts(requested, Panel::Summary);
  EXPECT_THAT(record, Contains("fourth: slab, crate"));
  EXPECT_THAT(record, Not(Contains(HasSubstr("more pair"))));
}

TEST(Answers, PanelsStateWhereTheyDoNotApply) {
  CrateWithQuery requested(true, false);
  requested.pair().query.reset();
  EXPECT_THAT(panel_texts(requested, Panel::Answers), Contains(HasSubstr("does not apply")));
  EXPECT_THAT(panel_texts(requested, Panel::AxisIntervals), Contains(HasSubstr("does not apply")));
}

}  // namespace
}  // namespace contactscope::draw
