// The panels "stability" and "plots", from facts by hand.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "crate_on_slab.h"
#include "draw/charts/series_chart.h"
#include "draw/panels/panel.h"
#include "draw/scene/palette.h"
#include "inside.h"

namespace contactscope::draw {
namespace {

using crate_sample::CrateOnSlab;
using crate_sample::same;
using crate_sample::texts;
using ::testing::Contains;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// Five frames: in the air, then on one, two, four points; in the last one it has slid off.
std::vector<trace::Frame> settling() {
  CrateOnSlab scene;
  std::vector<trace::Frame> frames(5, scene.frames[0]);
  const char* const verdicts[] = {"no contact", "turns about a point", "turns about a line",
                                  "stable", "turns about a line"};
  for (std::size_t f = 0; f < frames.size(); ++f) {
    frames[f].frame = static_cast<int>(f);
    frames[f].time = 0.25 * static_cast<double>(f);
    trace::Pair& pair = frames[f].pairs[0];
    trace::Stability& stability = pair.stability.emplace();
    stability.shape = "crate";
    stability.verdict = verdicts[f];
    stability.margin = 0.1 * static_cast<double>(f) - 0.25;
    if (f == 0) {
      pair.manifolds.clear();
    } else {
      stability.support = {{-0.5, 0, -0.5}, {0.5, 0, -0.5}, {0.5, 0, 0.5}};
    }
    trace::Solver& solver = frames[f].solver.emplace();
    solver.bodies = {
        {"crate", 1, Vec3d::Zero(), Vec3d::Zero(), Vec3d::Zero(), static_cast<double>(f), 0}};
    for (trace::Manifold& manifold : pair.manifolds) {
      for (trace::Point& point : manifold.points) {
        point.separation = -0.001 * static_cast<double>(f);
        point.impulse = trace::Impulse{0.5 * static_cast<double>(f), Vec3d::Zero(), 0};
      }
    }
  }
  return frames;
}

const Rect kPanel{900, 80, 330, 520};

/// Draws a panel of a sequence, with `room` under its heading.
Drawing panel_of(Panel panel, const std::vector<trace::Frame>& frames, std::size_t moment,
                 const Rect& room = kPanel, float pixel = 1,
                 std::vector<Layer> layers = {Layer::Shapes}) {
  CrateOnSlab scene;
  scene.frames = frames;
  scene.view.panels = {panel};
  scene.view.layers = std::move(layers);
  Staging staging = scene.staged();
  staging.layout.scale = pixel;
  const double heading = Sheet::heading_height(pixel);
  const Rect rect{room.x, room.y - heading, room.width, room.height + heading};
  Drawing drawing;
  Sheet sheet(rect, pixel, drawing);
  make_panels(staging, scene.frames).at(0).content->lay_out({moment, {}}, sheet);
  expect_inside(drawing, rect);
  return drawing;
}

Drawing stability_panel(const std::vector<trace::Frame>& frames, std::size_t moment,
                        const Rect& rect = kPanel, float pixel = 1) {
  return panel_of(Panel::Stability, frames, moment, rect, pixel);
}

TEST(StabilityPanel, ShowsTheVerdictAndTheMarginInWords) {
  const std::vector<trace::Frame> frames = settling();
  EXPECT_THAT(texts(stability_panel(frames, 3)), Contains("stable"));
  EXPECT_THAT(texts(stability_panel(frames, 3)), Contains("50.0 mm inside of the support"));
  EXPECT_THAT(texts(stability_panel(frames, 2)), Contains("unstable: turns about a line"));
  EXPECT_THAT(texts(stability_panel(frames, 2)), Contains("50.0 mm outside of the support"));
  EXPECT_THAT(texts(stability_panel(frames, 0)), Contains("no contact"));
  for (std::size_t f = 0; f < frames.size(); ++f) stability_panel(frames, f);  // stays inside
}

TEST(StabilityPanel, ShowsAgesIfThePictureShowsThem) {
  CrateOnSlab scene;
  scene.persist();
  scene.balance("stable");
  const auto rings = [&](std::vector<Layer> layers) {
    const Drawing drawing =
        panel_of(Panel::Stability, scene.frames, 0, kPanel, 1, std::move(layers));
    return std::ranges::count_if(drawing.primitives, [](const Primitive& primitive) {
      const Disc* disc = std::get_if<Disc>(&primitive);
      return disc != nullptr && same(disc->color, kContact) && disc->inner > 0;
    });
  };
  EXPECT_EQ(rings({Layer::Persistent}), 1);  // of the half-filled dot of the persisted point
  EXPECT_EQ(rings({Layer::Contacts}), 0);
}

/// Height and length, from the left, of the lines in the verdicts' rows in the only pair's style.
std::vector<std::pair<float, float>> verdict_levels(const Drawing& drawing) {
  std::vector<std::pair<float, float>> levels;
  float rows = 0;  // top of the rows: the first of the bands behind them
  for (const Primitive& primitive : drawing.primitives) {
    const Text* text = std::get_if<Text>(&primitive);
    if (text != nullptr && text->text == "stable" && text->align == Align::Right)
      rows = text->at.y - text->size;
  }
  for (const Primitive& primitive : drawing.primitives) {
    const Stroke* stroke = std::get_if<Stroke>(&primitive);
    if (stroke == nullptr || !same(stroke->color, series_style(0).color)) continue;
    if (rows == 0 || stroke->from.y < rows || stroke->from.y != stroke->to.y) continue;
    levels.emplace_back(stroke->from.y, stroke->to.x - stroke->from.x);
  }
  return levels;
}

TEST(StabilityPanel, VerdictsAreStepsThroughTheirRowsUpToTheCurrentFrame) {
  const std::vector<trace::Frame> frames = settling();
  EXPECT_THAT(verdict_levels(stability_panel(frames, 0)), IsEmpty());
  ASSERT_EQ(verdict_levels(stability_panel(frames, 1)).size(), 1u);
  const float frame = verdict_levels(stability_panel(frames, 1))[0].second;
  // About a point, about a line, stable, about a line again.
  const auto all = verdict_levels(stability_panel(frames, 4));
  ASSERT_EQ(all.size(), 4u);
  for (const auto& [height, length] : all) EXPECT_NEAR(length, frame, 1e-3);
  EXPECT_GT(all[0].first, all[1].first);
  EXPECT_GT(all[1].first, all[2].first);
  EXPECT_EQ(all[1].first, all[3].first);
}

TEST(StabilityPanel, TimeHasAnAxisWithItsUnitAndMarginsBelowZeroHaveANumber) {
  const Drawing drawing = stability_panel(settling(), 4);
  EXPECT_THAT(texts(drawing), ::testing::IsSupersetOf({"0", "time"}));
  EXPECT_THAT(texts(drawing), Contains(::testing::EndsWith(" s")));
  EXPECT_THAT(texts(drawing), Contains(::testing::MatchesRegex("−[0-9]+")));
}

TEST(StabilityPanel, SmallPanelsKeepTheMapAndStayInside) {
  const std::vector<trace::Frame> frames = settling();
  for (const double height : {200.0, 120.0, 80.0}) {
    const Rect rect{10, 10, 240, height};
    EXPECT_THAT(texts(stability_panel(frames, 3, rect, 0.72f)), Contains("marginal"))
        << "50 mm of a support of more than a metre";
  }
}

TEST(StabilityPanel, WithoutTheFactItHasANote) {
  const CrateOnSlab scene;
  EXPECT_THAT(
      texts(stability_panel(scene.frames, 0)),
      ElementsAre("stability: centre of mass over the contact", "no stability in this sequence"));
}

TEST(TimeSeries, HoldsTheValuesOfTheFrames) {
  const std::vector<TimeSeries> all = time_series(settling());
  ASSERT_EQ(all.size(), 1u);
  EXPECT_THAT(all[0].penetration, ElementsAre(0, 0.001, 0.002, 0.003, 0.004));
  EXPECT_THAT(all[0].points, ElementsAre(0, 2, 2, 2, 2));
  EXPECT_THAT(all[0].energy, ElementsAre(0, 1, 2, 3, 4));
  EXPECT_THAT(all[0].impulse, ElementsAre(0, 1, 2, 3, 4));
  ASSERT_EQ(all[0].ids.size(), 2u);
  EXPECT_EQ(all[0].ids[0][0], IdState::Absent);
  EXPECT_EQ(all[0].ids[1][4], IdState::Kept);
}

TEST(TimeSeries, ReducedPointsAreInTheStripAndPairsWithLabelsAreSeriesOfTheirOwn) {
  std::vector<trace::Frame> frames = settling();
  for (trace::Frame& frame : frames) {
    frame.pairs[0].label = "one-shot";
    frame.pairs.push_back(frame.pairs[0]);
    frame.pairs[1].label = "incremental";
    frame.pairs[1].b = "other crate";
    if (frame.frame == 0) continue;
    trace::Reduction& reduction = frame.pairs[1].reduction.emplace();
    reduction.points = frame.pairs[1].manifolds[0].points;
    reduction.points.push_back({{0, 0, 0}, -0.5, "b:v6"});
  }
  const std::vector<TimeSeries> all = time_series(frames);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].name, "one-shot");
  EXPECT_THAT(all[0].energy, ElementsAre(0, 1, 2, 3, 4));
  EXPECT_THAT(all[1].energy, Each(0)) << "the crate has no pair of that label";
  ASSERT_EQ(all[1].ids.size(), 3u);
  EXPECT_EQ(all[1].ids[2][1], IdState::Dropped);
  EXPECT_THAT(all[1].penetration, ElementsAre(0, 0.001, 0.002, 0.003, 0.004));
}

/// The crate and a second one next to it, twice as deep and only in the last two frames.
std::vector<trace::Frame> two_pairs() {
  std::vector<trace::Frame> frames = settling();
  for (trace::Frame& frame : frames) {
    frame.pairs.push_back(frame.pairs[0]);
    trace::Pair& other = frame.pairs.back();
    other.a = "slab";
    other.b = "other";
    if (frame.frame < 3) other.manifolds.clear();
    for (trace::Manifold& manifold : other.manifolds) {
      for (trace::Point& point : manifold.points) point.separation *= 2;
    }
  }
  return frames;
}

TEST(TimeSeries, TwoPairsHaveLinesOfTheirOwnThatEndWithTheirContact) {
  const std::vector<TimeSeries> all = time_series(two_pairs());
  ASSERT_EQ(all.size(), 1u);
  ASSERT_EQ(all[0].pairs.size(), 2u);
  const PairSeries& second = all[0].pairs[1];
  EXPECT_EQ(second.name, "slab and other");
  EXPECT_TRUE(std::isnan(second.penetration[2]));
  EXPECT_EQ(second.penetration[3], 0.006);
  EXPECT_EQ(second.impulse[3], 3);
  EXPECT_EQ(all[0].pairs[0].penetration[3], 0.003);
  EXPECT_EQ(all[0].penetration[3], 0.006) << "of all";
  EXPECT_THAT(all[0].id_pairs, ElementsAre(0, 0, 1, 1));
  EXPECT_THAT(all[0].deepest, IsEmpty());
  EXPECT_THAT(time_series(settling())[0].pairs, IsEmpty()) << "one pair needs no name";
}

TEST(TimeSeries, TheDeepestOfManyPairsIsNamed) {
  std::vector<trace::Frame> frames = two_pairs();
  for (trace::Frame& frame : frames) {
    for (const char* name : {"third", "fourth", "fifth"}) {
      frame.pairs.push_back(frame.pairs[0]);
      frame.pairs.back().b = name;
    }
  }
  const TimeSeries series = time_series(frames)[0];
  EXPECT_THAT(series.pairs, IsEmpty());
  EXPECT_EQ(series.deepest[0], "");
  EXPECT_EQ(series.deepest[2].substr(series.deepest[2].size() - 5), "crate")
      << "the first of equals";
  EXPECT_EQ(series.deepest[4], "slab and other");
  EXPECT_THAT(texts(panel_of(Panel::Plots, frames, 4)), Contains("slab and other 8.00 mm"));
}

TEST(PlotsPanel, PairsAreNamedAndTheirValuesStandSideBySide) {
  const Drawing drawing = panel_of(Panel::Plots, two_pairs(), 3);
  EXPECT_THAT(texts(drawing), Contains("slab and other"));
  EXPECT_THAT(texts(drawing), Contains("3.00 mm"));
  EXPECT_THAT(texts(drawing), Contains("6.00 mm"));
}

TEST(PlotsPanel, WithTheTimeOfAFrameImpulsesAreForces) {
  const Drawing drawing = panel_of(Panel::Plots, settling(), 3, kPanel, 1, {Layer::Loads});
  EXPECT_THAT(texts(drawing), Contains("normal forces, N"));
  EXPECT_THAT(texts(drawing), Contains("12.0 N")) << "3 N s in a quarter of a second";
}

TEST(IdBands, ABandIsAsHighAsPointsAreKeptAndCutWhereOneIsReplaced) {
  // Two points; then another two; then one of them. A second pair never changes.
  const IdState on = IdState::Kept, off = IdState::Absent;
  const std::vector<std::vector<IdState>> rows = {
      {on, off, off, off}, {on, on, on, on}, {off, on, on, off}, {on, on, on, on}};
  Drawing drawing;
  IdHistory(rows, {0, 0, 0, 1}).draw_bands({0, 0, 40, 20}, 3, 2, {drawing, 1, 14});
  std::vector<float> widths, heights;
  int cuts = 0;
  for (const Primitive& primitive : drawing.primitives) {
    if (const Fill* fill = std::get_if<Fill>(&primitive)) {
      widths.push_back(fill->polygon[1].x - fill->polygon[0].x);
      heights.push_back(fill->polygon[2].y - fill->polygon[1].y);
    } else if (const Stroke* stroke = std::get_if<Stroke>(&primitive)) {
      if (same(stroke->color, kWhite) && stroke->color.a == 1) ++cuts;
    }
  }
  EXPECT_THAT(widths, ElementsAre(10, 20, 10, 40));
  EXPECT_THAT(heights, ElementsAre(::testing::FloatEq(8), ::testing::FloatEq(8),
                                   ::testing::FloatEq(4), ::testing::FloatEq(8)));
  EXPECT_EQ(cuts, 2);
}

Drawing plots_panel(std::size_t moment, const Rect& rect = kPanel, float pixel = 1) {
  return panel_of(Panel::Plots, settling(), moment, rect, pixel);
}

TEST(PlotsPanel, ChartsHaveUnitsTheNewestValueAndARoundTick) {
  const std::vector<std::string> all = texts(plots_panel(3));
  EXPECT_THAT(all, Contains("overlap, mm"));
  EXPECT_THAT(all, Contains("3.00 mm"));
  EXPECT_THAT(all, Contains("kinetic energy, J"));
  EXPECT_THAT(all, Contains("3.00 J"));
  EXPECT_THAT(all, Contains("normal impulses, N s"));
  EXPECT_THAT(all, Contains("contact points"));
  EXPECT_THAT(all, Contains("points over time, a row each"));
  EXPECT_THAT(all, Contains("2")) << "tick below the largest value";
  EXPECT_THAT(all, Contains("1.00 s")) << "the whole sequence is on the axis";
  for (std::size_t f = 0; f < 5; ++f) plots_panel(f);  // stays inside
}

TEST(PlotsPanel, AClockThatIsResetIsNoAxis) {
  std::vector<trace::Frame> frames = settling();
  EXPECT_THAT(texts(panel_of(Panel::Plots, frames, 2)), Contains("time"));
  frames.back().time = 0;
  const std::vector<std::string> all = texts(panel_of(Panel::Plots, frames, 2));
  EXPECT_THAT(all, Not(Contains("time")));
  EXPECT_THAT(all, Contains("frame " + std::to_string(frames.back().frame)));
}

TEST(PlotsPanel, AConstantSeriesIsALineOfWords) {
  std::vector<trace::Frame> frames = settling();
  frames.erase(frames.begin());  // in the air
  const std::vector<std::string> all = texts(panel_of(Panel::Plots, frames, 2));
  EXPECT_THAT(all, Contains("contact points: 2 in every frame"));
  EXPECT_THAT(all, Contains("contact points: none changes"));
  EXPECT_THAT(all, Not(Contains("contact points")));
  EXPECT_THAT(all, Not(Contains(HasSubstr("a row each"))));
  EXPECT_THAT(texts(plots_panel(2)), Not(Contains(HasSubstr("in every frame"))));
}

TEST(PlotsPanel, CurvesEndAtTheCurrentFrame) {
  const auto strokes = [](std::size_t moment) {
    return std::ranges::count_if(plots_panel(moment).primitives, [](const Primitive& primitive) {
      const Stroke* stroke = std::get_if<Stroke>(&primitive);
      return stroke != nullptr && same(stroke->color, series_style(0).color);
    });
  };
  EXPECT_EQ(strokes(0), 0);
  EXPECT_EQ(strokes(1), 3 + 3) << "a step of the points is three";
  EXPECT_EQ(strokes(4), 3 + 3) << "what goes on straight is one stroke";
}

TEST(PlotsPanel, RoundingErrorAroundZeroIsZero) {
  std::vector<trace::Frame> frames = settling();
  for (trace::Frame& frame : frames) frame.solver->bodies[0].kinetic_energy *= 1e-15;
  const Drawing drawing = panel_of(Panel::Plots, frames, 3);
  EXPECT_THAT(texts(drawing), Contains("kinetic energy, J"));
  EXPECT_THAT(texts(drawing), Contains("0 J"));
}

TEST(PlotsPanel, WithoutASolverNeitherEnergyNorImpulses) {
  std::vector<trace::Frame> frames = settling();
  for (trace::Frame& frame : frames) frame.solver.reset();
  const Drawing drawing = panel_of(Panel::Plots, frames, 2);
  EXPECT_THAT(texts(drawing), Contains("overlap, mm"));
  EXPECT_THAT(texts(drawing), Not(Contains(HasSubstr("energy"))));
  EXPECT_THAT(texts(drawing), Not(Contains(HasSubstr("impulses"))));
}

TEST(TimeSeries, WithoutEnergiesOfBodiesThatMoveThereIsNoCurveOfThem) {
  std::vector<trace::Frame> frames = settling();
  for (trace::Frame& frame : frames)
    for (trace::Body& body : frame.solver->bodies) {
      body.velocity = Vec3d(0, -1, 0);
      body.kinetic_energy = 0;
    }
  EXPECT_THAT(time_series(frames)[0].energy, IsEmpty());
  EXPECT_THAT(time_series(frames)[0].impulse, testing::SizeIs(frames.size()));
  frames.back().solver->bodies[0].kinetic_energy = 1;
  EXPECT_THAT(time_series(frames)[0].energy, testing::SizeIs(frames.size()));
}

TEST(PlotsPanel, SmallPanelsGiveUpTheStripAndLastCharts) {
  const Rect low{10, 10, 240, 110};
  const Drawing drawing = plots_panel(3, low, 0.72f);
  EXPECT_THAT(texts(drawing), Contains("overlap, mm"));
  EXPECT_THAT(texts(drawing), Not(Contains("contact points")));
  const Rect usual{10, 10, 240, 205};
  EXPECT_THAT(texts(plots_panel(3, usual, 0.72f)), Contains("contact points"));
}

}  // namespace
}  // namespace contactscope::draw
