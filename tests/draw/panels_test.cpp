// Contents of panels, from facts by hand. Their charts have tests of their own.

#include "draw/panels/panel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "crate_on_slab.h"
#include "inside.h"

namespace contactscope::draw {
namespace {

using crate_sample::CrateOnSlab;
using crate_sample::same;
using crate_sample::texts;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using ::testing::Not;

/// A panel of a crate on a slab, made for a sequence.
class PanelSheet : public ::testing::Test {
 protected:
  CrateOnSlab scene;

  struct Filled {
    Drawing drawing;
    std::string missing;
  };

  Filled filled(Panel panel, const Rect& rect = kSheet, const PanelMoment& moment = {}) {
    scene.view.panels = {panel};
    const Staging staging = scene.staged();
    const std::vector<FilledPanel> panels = make_panels(staging, scene.frames);
    EXPECT_EQ(panels.size(), 1u);
    Filled result;
    Sheet sheet(rect, staging.layout.scale, result.drawing);
    result.missing = panels.at(0).content->lay_out(moment, sheet);
    return result;
  }

  PanelNeed need(Panel panel) {
    scene.view.panels = {panel};
    const Staging staging = scene.staged();
    return make_panels(staging, scene.frames).at(0).content->need({});
  }

  /// Copies the crate's pair until there are `times` of it.
  void repeat_pair(int times) {
    for (int i = 1; i < times; ++i) {
      scene.frames[0].pairs.push_back(scene.pair());
      scene.frames[0].pairs.back().label = "copy " + std::to_string(i);
    }
  }

  static constexpr Rect kSheet{900, 80, 332, 500};
};

TEST_F(PanelSheet, SummaryNamesThePairAndSpellsItsFacts) {
  scene.manifold().type = "face-face";
  scene.pair().separation = -0.002;
  const Drawing drawing = filled(Panel::Summary).drawing;
  EXPECT_THAT(texts(drawing),
              ElementsAre("slab, crate", "pair", "hull and hull", "state", "touching", "contact",
                          "face on face", "overlap", "2.00 mm", "points", "2", "time", "0.000 s"));
  expect_inside(drawing, kSheet);
}

TEST_F(PanelSheet, SummaryShowsAMeasuredTimeOnlyWhereThereIsOne) {
  EXPECT_THAT(texts(filled(Panel::Summary, kSheet, {.pipeline_nanoseconds = 1234}).drawing),
              Contains("1.23 µs"));
  EXPECT_THAT(texts(filled(Panel::Summary).drawing), Not(Contains("pipeline")));
}

TEST_F(PanelSheet, SummaryOfManyPairsHoldsThoseThatHaveRoomAndCountsTheOthers) {
  repeat_pair(400);
  const Filled summary = filled(Panel::Summary);
  EXPECT_EQ(summary.missing, "397 pairs");
  EXPECT_THAT(texts(summary.drawing), IsSupersetOf({"slab, crate", "copy 2: slab, crate"}));
  EXPECT_THAT(texts(summary.drawing), Contains("and 397 more pairs"));
  EXPECT_THAT(texts(summary.drawing), Not(Contains("copy 3: slab, crate")));
  expect_inside(summary.drawing, kSheet);
}

TEST_F(PanelSheet, SummaryNeedsRoomForAllPairsAndTheLongestFrame) {
  const float one = need(Panel::Summary).wanted;
  repeat_pair(3);
  EXPECT_GT(need(Panel::Summary).wanted, 2.5f * one);
  EXPECT_FLOAT_EQ(need(Panel::Summary).least, one + Sheet::line_height(1))
      << "one, and a line for others";
  scene.frames.push_back(scene.frames[0]);
  const float before = need(Panel::Summary).wanted;
  scene.frames[1].pairs[2].degenerate.emplace();
  scene.frames[1].pairs[2].incremental.emplace();
  EXPECT_GT(need(Panel::Summary).wanted, before) << "room is kept in frames that say less";
}

TEST_F(PanelSheet, ContactPlaneCutsAFloorAtTheBorderOfItsMap) {
  trace::Clip& clip = scene.pair().clip.emplace();
  clip.reference.polygon = {{-50, 0, -50}, {50, 0, -50}, {50, 0, 50}, {-50, 0, 50}};
  clip.incident.polygon = {{-0.5, 0, -0.5}, {0.5, 0, -0.5}, {0.5, 0, 0.5}, {-0.5, 0, 0.5}};
  const Drawing drawing = filled(Panel::ContactPlane).drawing;
  expect_inside(drawing, kSheet);
  float widest = 0;
  for (const Primitive& primitive : drawing.primitives) {
    const Fill* fill = std::get_if<Fill>(&primitive);
    if (fill == nullptr) continue;
    const auto [least, most] = std::ranges::minmax(fill->polygon, {}, &Point2::x);
    widest = std::max(widest, most.x - least.x);
  }
  EXPECT_NEAR(widest, kSheet.width, 1) << "the floor fills the map";
}

TEST_F(PanelSheet, ContactPlaneSummarizesItsPoints) {
  EXPECT_THAT(texts(filled(Panel::ContactPlane).drawing), Contains("2 points, 1.00 m apart"));
  scene.manifold().points.pop_back();
  EXPECT_THAT(texts(filled(Panel::ContactPlane).drawing), Contains("1 point, no area"));
  scene.pair().manifolds.push_back(scene.manifold());
  EXPECT_THAT(texts(filled(Panel::ContactPlane).drawing), Contains("2 points in 2 manifolds"));
  scene.pair().manifolds.clear();
  EXPECT_THAT(texts(filled(Panel::ContactPlane).drawing), Contains("no contact in this frame"));
}

TEST_F(PanelSheet, ContactPlaneNumbersTheKeptPointsOfAReduction) {
  trace::Reduction& reduction = scene.pair().reduction.emplace();
  for (const auto& [x, z] : {std::pair{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}, {0, 0}})
    reduction.points.push_back({{x, 0, z}, -0.001, "id"});
  reduction.kept = {2, 0, 1, 3};
  scene.manifold().points.assign(reduction.points.begin(), reduction.points.begin() + 4);
  reduction.area = 0.8;
  reduction.best_area = 1;
  const Drawing drawing = filled(Panel::ContactPlane).drawing;
  EXPECT_THAT(texts(drawing),
              IsSupersetOf({"1", "2", "3", "4", "80.0 % of the best 4 of 5 points"}));
  EXPECT_THAT(texts(drawing), Contains("area 0.8000 m²"));
  expect_inside(drawing, kSheet);
}

TEST_F(PanelSheet, AxisHistoryCountsSwitchesAndCacheHitsUpToTheFrame) {
  scene.frames.assign(5, scene.frames[0]);
  for (std::size_t f = 0; f < scene.frames.size(); ++f) {
    scene.frames[f].frame = static_cast<int>(f);
    trace::Pair& pair = scene.frames[f].pairs[0];
    if (f == 2) {
      trace::Cache& cache = pair.cache.emplace();
      cache.hit = true;
      cache.axis = "face_a";
    } else {
      pair.sat.emplace().chosen = f < 3 ? "face_a" : "face_b";
    }
  }
  const auto title = [&](std::size_t frame) {
    return texts(filled(Panel::AxisHistory, kSheet, {frame}).drawing);
  };
  EXPECT_THAT(title(1), Contains("0 of 2"));  // frames that need no full test
  EXPECT_THAT(title(2), Contains("1 of 3"));
  EXPECT_THAT(title(4), Contains("1 of 5"));
  EXPECT_THAT(title(4), IsSupersetOf({"faces of A", "faces of B", "edges"}));
  EXPECT_THAT(title(4), Contains("full test"));
  // The axis of each frame, and below it the frames that the cache could not answer.
  std::vector<Rect> dark, axes;
  const Drawing drawing = filled(Panel::AxisHistory, kSheet, {4}).drawing;
  for (const Primitive& primitive : drawing.primitives) {
    const Fill* fill = std::get_if<Fill>(&primitive);
    if (fill == nullptr) continue;
    const auto [left, right] = std::ranges::minmax(fill->polygon, {}, &Point2::x);
    const auto [low, high] = std::ranges::minmax(fill->polygon, {}, &Point2::y);
    const Rect box{left.x, low.y, right.x - left.x, high.y - low.y};
    if (same(fill->color, kText)) dark.push_back(box);
    if (same(fill->color, kAxis)) axes.push_back(box);
  }
  ASSERT_EQ(axes.size(), 2u);
  EXPECT_NEAR(axes[0].width, 1.5 * axes[1].width, 2);  // frames 0 to 2, and 3 and 4
  ASSERT_EQ(dark.size(), 4u);                          // all but frame 2
  for (const Rect& test : dark) EXPECT_GT(test.y, axes[1].bottom());
  expect_inside(filled(Panel::AxisHistory, kSheet, {4}).drawing, kSheet);
}

TEST_F(PanelSheet, AxisHistoryWithoutTestsHasANoteThatFits) {
  const Drawing drawing = filled(Panel::AxisHistory).drawing;
  EXPECT_THAT(texts(drawing), Contains(HasSubstr("does not apply")));
  expect_inside(drawing, kSheet);
}

TEST_F(PanelSheet, AxisHistoryOfManyPairsHoldsThoseThatHaveRoom) {
  repeat_pair(40);
  for (trace::Pair& pair : scene.frames[0].pairs) pair.sat.emplace().chosen = "face_a";
  const Filled history = filled(Panel::AxisHistory);
  EXPECT_THAT(history.missing, HasSubstr(" pairs"));
  expect_inside(history.drawing, kSheet);
}

TEST(Sheet, WordsGoOnInAnotherLineAndLongOnesAreCut) {
  const float width = text_width("separating axis", 15, FontWeight::Regular) + 1;
  EXPECT_THAT(wrapped("separating axis of two hulls", 15, width),
              ElementsAre("separating axis", "of two hulls"));
  EXPECT_THAT(wrapped("", 15, width), ElementsAre(""));
  Drawing drawing;
  Sheet sheet({0, 0, 160, 140}, 1, drawing);
  sheet.heading("contact plane, seen along the normal");
  sheet.row("separation", "an overlap of many words");
  expect_inside(drawing, {0, 0, 160, 140});
  EXPECT_THAT(texts(drawing), Contains(::testing::EndsWith("…")));
}

TEST(Sheet, RowsStandOnWholePixelsAtEveryScale) {
  for (const float scale : {0.72f, 1.0f, 1.3f, 2.0f}) {
    Drawing drawing;
    Sheet sheet({10.5, 20.25, 300, 400}, scale, drawing);
    sheet.heading("heading");
    for (int i = 0; i < 4; ++i) sheet.line("line", {});
    for (const Primitive& primitive : drawing.primitives) {
      if (const Text* text = std::get_if<Text>(&primitive)) {
        EXPECT_EQ(text->at.y, std::floor(text->at.y));
      }
    }
    const double used = sheet.rest().y - 20.25;
    const double requested = Sheet::heading_height(scale) + 4 * Sheet::line_height(scale);
    EXPECT_NEAR(used, requested, 2.5);
  }
}

}  // namespace
}  // namespace contactscope::draw
