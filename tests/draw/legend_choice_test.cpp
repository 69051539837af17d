#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "crate_on_slab.h"

namespace contactscope::draw {
namespace {

using crate_sample::CrateOnSlab;
using ::testing::Contains;
using ::testing::Not;

constexpr Swatch kFaceSwatch{LegendGroup::Faces, 0, [](auto&) {}};
constexpr Swatch kPointSwatch{LegendGroup::Points, 0, [](auto&) {}};
constexpr Swatch kBodySwatch{LegendGroup::Masses, 0, [](auto&) {}};

std::vector<std::string> texts_of(const std::vector<LegendEntry>& entries) {
  return mapped(entries, [](const LegendEntry& entry) { return entry.text; });
}

std::vector<LegendEntry> numbered(const Swatch& swatch, int count, bool anchored) {
  std::vector<LegendEntry> entries;
  for (int i = 0; i < count; ++i) {
    LegendEntry& entry = entries.emplace_back();
    entry.swatch = &swatch;
    entry.text = std::to_string(i);
    if (anchored) entry.anchor = Vec3d::Zero();
  }
  return entries;
}

TEST(LegendChoice, ListsFiveAndLabelsTwo) {
  const LegendChoice few = choose_legend(numbered(kFaceSwatch, 5, true));
  EXPECT_EQ(few.listed.size(), 5u);
  EXPECT_TRUE(few.labelled.empty());
  const LegendChoice many = choose_legend(numbered(kFaceSwatch, 8, true));
  EXPECT_EQ(many.listed.size(), 5u);
  EXPECT_EQ(many.labelled.size(), 2u);
}

// Each point has its own number or word next to it.
TEST(LegendChoice, LabelsNoPoints) {
  const LegendChoice choice = choose_legend(numbered(kPointSwatch, 8, true));
  EXPECT_EQ(choice.listed.size(), 5u);
  EXPECT_TRUE(choice.labelled.empty());
}

TEST(LegendChoice, ListsEntriesWithoutAPlaceAndRepeatedOnes) {
  std::vector<LegendEntry> entries = numbered(kBodySwatch, 1, true);
  for (const LegendEntry& entry : numbered(kFaceSwatch, 2, true)) entries.push_back(entry);
  for (const LegendEntry& entry : numbered(kPointSwatch, 3, true)) entries.push_back(entry);
  for (const LegendEntry& entry : numbered(kBodySwatch, 1, false)) entries.push_back(entry);
  const LegendChoice choice = choose_legend(entries);
  // The anchored body leaves the list first, then a face; points and unanchored entries stay.
  ASSERT_EQ(choice.labelled.size(), 1u);
  EXPECT_EQ(choice.labelled[0].swatch, &kFaceSwatch);
  EXPECT_FALSE(choice.listed.back().anchor);
}

TEST(LegendChoice, EntriesOnlyInAPanelAreDroppedFirst) {
  std::vector<LegendEntry> entries = numbered(kPointSwatch, 6, false);
  entries[1].in_panel = true;
  const LegendChoice choice = choose_legend(entries);
  EXPECT_EQ(choice.listed.size(), 5u);
  EXPECT_EQ(std::ranges::count(choice.listed, true, &LegendEntry::in_panel), 0);
}

TEST(LegendChoice, LabelsHaveTheFirstWords) {
  LegendEntry entry;
  entry.text = "side plane, outward normal";
  EXPECT_EQ(label_of(entry), "side plane");
  entry.text = "support: hull of the contact points";
  EXPECT_EQ(label_of(entry), "support");
}

/// The crate with more entries than a legend of five can hold.
struct BusyCrate : CrateOnSlab {
  BusyCrate() {
    persist();
    balance("turns about a line");
    solve(2);
    trace::Clip& clip = pair().clip.emplace();
    clip.reference.polygon = {{-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}};
    clip.reference.normal = Vec3d::UnitY();
    clip.incident.polygon = {{-0.5, 0, -0.5}, {0.5, 0, -0.5}, {0.5, 0, 0.5}, {-0.5, 0, 0.5}};
    trace::ClipStep& step = clip.steps.emplace_back();
    step.normal = -Vec3d::UnitX();
    step.polygon = clip.incident.polygon;
    clip.dropped.push_back({Vec3d(0.2, 0.1, 0.3), "above the reference face"});
    view.layers = {Layer::Shapes,       Layer::ReferenceFace, Layer::SidePlanes,
                   Layer::IncidentFace, Layer::ClipPolygons,  Layer::Dropped,
                   Layer::CenterOfMass, Layer::Support,       Layer::Normals,
                   Layer::Contacts,     Layer::Persistent,    Layer::Impulses,
                   Layer::Friction,     Layer::Velocities,    Layer::SurfacePoints};
  }
};

TEST(LegendOfPictures, HasFiveEntriesAndLabelsMostOthersInPlace) {
  BusyCrate crate;
  const Staging staging = crate.staged();
  const LegendChoice choice = legend_of(staging, crate.frames[0]);
  EXPECT_EQ(choice.listed.size(), kMaxLegendEntries);
  EXPECT_EQ(choice.labelled.size(), kMaxInPlace);
  const std::vector<std::string> drawn = crate_sample::texts(illustrate(staging, crate.frames[0]));
  for (const LegendEntry& entry : choice.listed) EXPECT_THAT(drawn, Contains(entry.text));
  for (const LegendEntry& entry : choice.labelled) EXPECT_THAT(drawn, Contains(label_of(entry)));
}

TEST(NamesOfShapes, StandOnThemAndNotInTheLegend) {
  CrateOnSlab crate;
  crate.view.layers = {Layer::Shapes, Layer::Contacts, Layer::Normals};
  const std::vector<std::string> drawn =
      crate_sample::texts(illustrate(crate.staged(), crate.frames[0]));
  EXPECT_THAT(drawn, Contains("A: slab"));
  EXPECT_THAT(drawn, Contains("B: crate"));
  for (const std::string& text : texts_of(legend_of(crate.staged(), crate.frames[0]).listed))
    EXPECT_THAT(text, Not(::testing::HasSubstr("slab")));
}

TEST(NamesOfShapes, HaveNoNumbersAndAreFew) {
  CrateOnSlab crate;
  crate.view.layers = {Layer::Shapes, Layer::Contacts};
  crate.header.shapes[1].name = "small_crate_3";
  crate.frames[0].poses[1].first = "small_crate_3";
  crate.pair().b = "small_crate_3";
  EXPECT_THAT(crate_sample::texts(illustrate(crate.staged(), crate.frames[0])),
              Contains("B: small crate"));
  for (const char* name : {"ball", "rod"}) {
    crate.header.shapes.push_back(crate_sample::cuboid(name, {0.1, 0.1, 0.1}));
    Pose<double> pose;
    pose.position = {name[0] == 'b' ? -0.8 : 0.8, 0.1, 0};
    crate.frames[0].poses.push_back({name, pose});
  }
  EXPECT_THAT(crate_sample::texts(illustrate(crate.staged(), crate.frames[0])),
              Not(Contains("B: small crate")));
}

TEST(NamesOfShapes, HaveNoLettersWhereTheSolverMovesBodiesAndNoNormalIsDrawn) {
  CrateOnSlab crate;
  crate.solve(1);
  crate.view.layers = {Layer::Shapes, Layer::Contacts};
  EXPECT_THAT(crate_sample::texts(illustrate(crate.staged(), crate.frames[0])), Contains("crate"));
  crate.view.layers.push_back(Layer::Normals);
  EXPECT_THAT(crate_sample::texts(illustrate(crate.staged(), crate.frames[0])),
              Contains("B: crate"));
}

TEST(NamesOfShapes, StandOnNoneOfSeveralAlike) {
  CrateOnSlab crate;
  crate.solve(1);
  crate.view.layers = {Layer::Shapes, Layer::Contacts};
  crate.header.shapes.push_back(crate_sample::cuboid("crate_2", {0.1, 0.1, 0.1}));
  Pose<double> pose;
  pose.position = {0.8, 0.1, 0};
  crate.frames[0].poses.push_back({"crate_2", pose});
  const std::vector<std::string> drawn =
      crate_sample::texts(illustrate(crate.staged(), crate.frames[0]));
  EXPECT_THAT(drawn, Contains("slab"));
  EXPECT_THAT(drawn, Not(Contains("crate")));
}

// A picture may omit obvious names and entries.
TEST(NamesOfShapes, AndEntriesOfTheLegendAreLeftOutByAnEmptyWord) {
  CrateOnSlab crate;
  crate.view.layers = {Layer::Shapes, Layer::Contacts};
  Words words;
  words.rename("crate", "");
  words.replace("contact point, {sign}", "");
  FigureStyle style;
  style.words = std::make_shared<const Words>(words);
  const Staging staging = stage(crate.header, crate.frames, crate.view, 1280, 720, style);
  EXPECT_TRUE(legend_of(staging, crate.frames[0]).listed.empty());
  const std::vector<std::string> drawn = crate_sample::texts(illustrate(staging, crate.frames[0]));
  EXPECT_THAT(drawn, Contains("A: slab"));
  EXPECT_THAT(drawn, Not(Contains("B: crate")));
}

}  // namespace
}  // namespace contactscope::draw
