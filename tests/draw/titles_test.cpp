#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "crate_on_slab.h"
#include "draw/scene/pairs.h"
#include "draw/scene/quantity.h"

namespace contactscope::draw {
namespace {

using crate_sample::CrateOnSlab;
using ::testing::Contains;
using ::testing::HasSubstr;

struct TitledCrate : CrateOnSlab {
  std::string title(const std::string& text, int frame = 0) {
    view.title = text;
    const Staging staging = staged();
    return fill_title(staging, frames[static_cast<std::size_t>(frame)]);
  }
};

TEST(TitlesOfPictures, AreFilledFromTheFrameThatIsDrawn) {
  TitledCrate crate;
  EXPECT_EQ(crate.title("{kept:point}, {overlap} deep, {touching:pair}"),
            "2 points, 2.00 mm deep, 1 pair");
  EXPECT_THAT(crate_sample::texts(illustrate(crate.staged(), crate.frames[0])),
              Contains("2 points, 2.00 mm deep, 1 pair"));
  crate.manifold().points.pop_back();
  EXPECT_EQ(crate.title("{kept:point/points}"), "1 point");
}

TEST(TitlesOfPictures, TheFirstAlternativeThatIsWholeIsShown) {
  TitledCrate crate;
  const std::string text = "{gap} apart | {from 1}later | {overlap} deep";
  EXPECT_EQ(crate.title(text), "2.00 mm deep");
  crate.pair().manifolds.clear();
  crate.pair().state = "separated";
  crate.pair().separation = 0.25;
  EXPECT_EQ(crate.title(text), "250 mm apart");
  EXPECT_EQ(crate.title("{kept:point} | {frame}: none touch"), "0: none touch");
  EXPECT_EQ(crate.title("{kept:point}"), "0 points");
  crate.frames[0].frame = 1;
  crate.pair().separation = 0;
  EXPECT_EQ(crate.title(text), "later");
  EXPECT_EQ(crate.title("{gap} | {overlap}"), "…");
}

TEST(TitlesOfPictures, FillInPairsShapesAndSequences) {
  TitledCrate crate;
  crate.pair().label = "left";
  trace::Pair other = crate.pair();
  other.label = "right";
  other.separation = -0.004;
  other.manifolds[0].points.resize(1);
  crate.frames[0].pairs.push_back(other);
  EXPECT_EQ(crate.title("{kept of right} {kept of left} {kept of crate and slab}"), "1 2 3");
  EXPECT_EQ(crate.title("{overlap of right}"), "4.00 mm");
  crate.frames.push_back(crate.frames[0]);
  crate.frames[1].frame = 1;
  crate.frames[1].pairs[0].cache.emplace().hit = true;
  EXPECT_EQ(crate.title("{hits} of {frames:frame}, {hit_rate}"), "1 of 2 frames, 50 %");
}

TEST(TitlesOfPictures, AnotherEngineKeepsItsBraces) {
  TitledCrate crate;
  EXPECT_EQ(crate.title("map<{int}>"), "map<{int}>");
}

TEST(TitlesOfPictures, LongOnesShrinkAndThenTakeTwoLines) {
  const std::string words =
      "Baumgarte pushes overlaps out with a velocity, and the deep crate keeps";
  const FittedTitle whole = fit_title("Short", 1232, 1);
  EXPECT_EQ(whole.size, 28);
  const FittedTitle smaller = fit_title(words, 0.9f * text_width(words, 28, Weight::Bold), 1);
  EXPECT_EQ(smaller.lines.size(), 1u);
  EXPECT_LT(smaller.size, 28);
  const FittedTitle two = fit_title(words, 500, 1);
  ASSERT_EQ(two.lines.size(), 2u);
  EXPECT_EQ(two.lines[0] + " " + two.lines[1], words);
  for (const std::string& line : two.lines)
    EXPECT_LE(text_width(line, static_cast<float>(two.size), Weight::Bold), 500);
  EXPECT_THAT(fit_title(words, 120, 1).lines.front(), HasSubstr("…"));
}

TEST(TitlesOfPictures, RequestTheStagesTheyRead) {
  View view;
  view.layers.clear();
  EXPECT_FALSE(stages_shown({view}).reduction);
  view.title = "{area_kept}";
  EXPECT_TRUE(stages_shown({view}).reduction);
  EXPECT_FALSE(stages_shown({view}).gjk);
  view.title = "{iterations}";
  EXPECT_TRUE(stages_shown({view}).gjk);
}

TEST(WordsOfPairs, RefineTheState) {
  trace::Pair pair;
  pair.state = "touching";
  pair.separation = 0.004;
  EXPECT_EQ(spell_state(state_of(pair, 1e-4)), "within the margin");
  pair.separation = 5e-5;
  EXPECT_EQ(spell_state(state_of(pair, 1e-4)), "touching");
  pair.separation = -0.1;
  EXPECT_EQ(spell_state(state_of(pair, 1e-4)), "touching");
  pair.state = "separated";
  EXPECT_EQ(spell_state(state_of(pair, 1e-4)), "overlap, contact skipped");
  pair.separation = 0.1;
  EXPECT_EQ(spell_state(state_of(pair, 1e-4)), "apart");
}

TEST(WordsOfPairs, CallThreePointsWithASmallMarginMarginal) {
  trace::Stability stability;
  stability.verdict = "stable";
  stability.support = {{0, 0, 0}, {0.5, 0, 0}, {0, 0, 0.5}};
  stability.margin = 0.0012;
  EXPECT_EQ(spell_balance(balance_of(stability)), "marginal");
  stability.margin = 0.1;
  EXPECT_EQ(spell_balance(balance_of(stability)), "stable");
  stability.verdict = "turns about a line";
  EXPECT_EQ(spell_balance(balance_of(stability)), "unstable");
}

TEST(WordsOfPairs, GapsAndOverlapsHaveNoSign) {
  EXPECT_EQ(spell_separation(-0.002, 0), "overlap 2.00 mm");
  EXPECT_EQ(spell_separation(0.002, 0), "gap 2.00 mm");
}

TEST(Quantities, EndWhereTheNoiseBegins) {
  EXPECT_EQ(spell_length(7.45e-9, 0x1p-24), "< 60 nm");
  EXPECT_EQ(spell_length(-29.8e-9, 0x1p-24), "< 60 nm");
  EXPECT_EQ(spell_length(3.583e-6, 0x1p-24), "3.58 µm");
  EXPECT_EQ(spell_length(4.56e-7, 0x1p-24), "460 nm");
  EXPECT_EQ(spell_length(0.002, 0x1p-24), "2.00 mm");
  EXPECT_EQ(spell_length(0, 0x1p-24), "0 m");
  EXPECT_EQ(spell_length(7.45e-9, 0), "7.45 nm");
  EXPECT_EQ(spell_length(0.00977, 4.9e-4), "9.8 mm");
}

TEST(Quantities, NoiseIsOfTheScalarAndTheDistanceFromTheOrigin) {
  CrateOnSlab crate;
  crate.header.scalar = "float";
  const ShapeMeshes meshes(crate.header.shapes);
  const double near = noise_of(crate.header, meshes, crate.frames[0], crate.pair());
  EXPECT_NEAR(near, 0x1p-24 * std::sqrt(0.75), 1e-12);
  for (trace::Point& point : crate.manifold().points) point.position.x() += 8192;
  EXPECT_NEAR(noise_of(crate.header, meshes, crate.frames[0], crate.pair()), 0x1p-24 * 8191.5,
              1e-9);
  crate.header.scalar = "double";
  EXPECT_LT(noise_of(crate.header, meshes, crate.frames[0], crate.pair()), 1e-12);
  crate.header.scalar.clear();
  EXPECT_EQ(noise_of(crate.header, meshes, crate.frames[0], crate.pair()), 0);
}

}  // namespace
}  // namespace contactscope::draw
