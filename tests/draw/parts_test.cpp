#include <gmock/gmock.h>

#include "crate_on_slab.h"

/// The part of the scene that each primitive of a drawing shows.
namespace contactscope::draw {
namespace {

using crate_sample::CrateOnSlab;

std::vector<std::string> layers_of(const Drawing& drawing) {
  std::vector<std::string> layers;
  for (const Part& part : drawing.parts) layers.push_back(part.layer);
  return layers;
}

const Part& part_of(const Drawing& drawing, std::size_t primitive) {
  const auto after = std::ranges::upper_bound(drawing.parts, primitive, {}, &Part::first);
  return *std::prev(after);
}

TEST(Parts, EveryPrimitiveOfAPictureIsOfALayerOrACaption) {
  CrateOnSlab scene;
  scene.view.layers = {Layer::Shapes, Layer::Contacts, Layer::Normals, Layer::Ids};
  scene.pair().label = "crate";
  const Drawing drawing = illustrate(scene.staged(), scene.frames[0]);
  ASSERT_FALSE(drawing.parts.empty());
  EXPECT_EQ(drawing.parts.front().first, 0u);
  EXPECT_TRUE(std::ranges::is_sorted(drawing.parts, std::ranges::less(), &Part::first));
  EXPECT_THAT(layers_of(drawing),
              testing::IsSupersetOf({"shapes", "contacts", "normals", "ids", "pair_label", "legend",
                                     "title", "source", "moment"}));
  int dots = 0;
  for (std::size_t i = 0; i < drawing.primitives.size(); ++i) {
    const Part& part = part_of(drawing, i);
    const Disc* disc = std::get_if<Disc>(&drawing.primitives[i]);
    if (disc != nullptr && crate_sample::same(disc->color, kContact) && part.layer != "legend") {
      EXPECT_EQ(part.layer, "contacts");
      EXPECT_EQ(part.pair, "slab crate");
      EXPECT_EQ(part.role, "mark");
      ++dots;
    }
    const Text* text = std::get_if<Text>(&drawing.primitives[i]);
    if (text != nullptr && text->text == "A crate on a slab") {
      EXPECT_EQ(part.layer, "title");
    }
    if (text != nullptr && text->text == "b:v4") {
      EXPECT_EQ(part.layer, "ids");
      EXPECT_EQ(part.role, "label");
    }
  }
  EXPECT_EQ(dots, 2);
}

TEST(Parts, SurfacesCutAndSortedByDepthKeepTheirLayer) {
  // The reference face coincides with the crate's bottom: drawn one after the other despite cuts.
  CrateOnSlab scene;
  scene.view.layers = {Layer::Shapes, Layer::Support};
  scene.balance("stable");
  const Drawing drawing = illustrate(scene.staged(), scene.frames[0]);
  int support = 0, shapes = 0;
  for (std::size_t i = 0; i < drawing.primitives.size(); ++i) {
    const Fill* fill = std::get_if<Fill>(&drawing.primitives[i]);
    const Part& part = part_of(drawing, i);
    if (fill == nullptr || part.role != "surface") continue;
    const bool green = crate_sample::same(fill->color, kClipPolygon);
    EXPECT_EQ(part.layer, green ? "support" : "shapes");
    (green ? support : shapes) += 1;
  }
  EXPECT_GT(support, 0);
  EXPECT_GT(shapes, 3);
}

TEST(Parts, ALabelKnowsWhatItNames) {
  CrateOnSlab scene;
  scene.view.layers = {Layer::Shapes, Layer::Ids};
  const Staging staging = scene.staged();
  const Drawing drawing = illustrate(staging, scene.frames[0]);
  int ids = 0;
  for (const Callout& callout : drawing.callouts) {
    const Text& text = std::get<Text>(drawing.primitives[callout.text]);
    if (callout.layer != "ids" || text.text != "corner B4") continue;
    const std::optional<Point2> at = staging.camera.project({-0.5, 0, 0.5});
    ASSERT_TRUE(at);
    EXPECT_EQ(callout.at, *at);
    EXPECT_EQ(callout.pair, "slab crate");
    ++ids;
  }
  EXPECT_EQ(ids, 1);
}

TEST(Parts, PartsWithoutPrimitivesAreLeftOut) {
  Drawing drawing;
  drawing.begin("shapes");
  drawing.begin("contacts", "a b", "mark");
  drawing.primitives.push_back(Disc{});
  drawing.begin("contacts", "a b", "mark");  // repeated arguments begin no new part
  drawing.primitives.push_back(Disc{});
  drawing.begin("contacts", "a c", "mark");
  drawing.primitives.push_back(Disc{});
  EXPECT_THAT(layers_of(drawing), testing::ElementsAre("contacts", "contacts"));
  EXPECT_EQ(drawing.parts[1].first, 2u);
  EXPECT_EQ(drawing.parts[1].pair, "a c");
}

TEST(Parts, AppendedDrawingsKeepTheirPartsAndCallouts) {
  Drawing page, cell;
  page.begin("title");
  page.primitives.push_back(Text{"page", {1, 2}});
  cell.begin("shapes", {}, "surface");
  cell.primitives.push_back(Fill{{{0, 0}, {1, 0}, {1, 1}}, {}});
  cell.primitives.push_back(Stroke{{0, 0}, {1, 0}});
  cell.begin("ids", "a b", "label");
  cell.callouts.push_back({2, {3, 4}, "ids", "a b"});
  cell.primitives.push_back(Text{"e1", {5, 6}});
  page.append(cell, {100, 10});
  ASSERT_EQ(page.primitives.size(), 4u);
  EXPECT_THAT(layers_of(page), testing::ElementsAre("title", "shapes", "ids"));
  EXPECT_EQ(page.parts[1].first, 1u);
  EXPECT_EQ(page.parts[2].first, 3u);
  EXPECT_EQ(std::get<Fill>(page.primitives[1]).polygon[2], (Point2{101, 11}));
  EXPECT_EQ(std::get<Stroke>(page.primitives[2]).to, (Point2{101, 10}));
  EXPECT_EQ(std::get<Text>(page.primitives[3]).at, (Point2{105, 16}));
  ASSERT_EQ(page.callouts.size(), 1u);
  EXPECT_EQ(page.callouts[0].text, 3u);
  EXPECT_EQ(page.callouts[0].at, (Point2{103, 14}));
}

}  // namespace
}  // namespace contactscope::draw
