#include "vector/pieces.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "draw/crate_on_slab.h"

namespace contactscope::vector {
namespace {

using draw::crate_sample::CrateOnSlab;
using nlohmann::json;

json anchors(CrateOnSlab& scene) {
  const draw::Staging staging = scene.staged();
  const draw::Drawing drawing = draw::illustrate(staging, scene.frames[0]);
  return json::parse(anchors_of(staging, scene.frames[0], drawing));
}

TEST(Anchors, PointsStandWhereTheirDotsAre) {
  CrateOnSlab scene;
  scene.view.layers = {Layer::Shapes, Layer::Contacts};
  const json all = anchors(scene);
  EXPECT_EQ(all["size"], json({1280, 720}));
  ASSERT_EQ(all["points"].size(), 2u);
  const draw::Drawing drawing = draw::illustrate(scene.staged(), scene.frames[0]);
  for (const json& point : all["points"]) {
    EXPECT_EQ(point["pair"], json({"slab", "crate"}));
    EXPECT_EQ(point["separation"], -0.002);
    const double x = point["at"]["pixels"][0], y = point["at"]["pixels"][1];
    EXPECT_NEAR(point["at"]["fraction"][0], x / 1280, 1e-4);
    EXPECT_NEAR(point["at"]["fraction"][1], y / 720, 1e-4);
    const auto is_there = [&](const draw::Primitive& primitive) {
      const auto* disc = std::get_if<draw::Disc>(&primitive);
      return disc != nullptr && draw::crate_sample::same(disc->color, draw::kContact) &&
             distance(disc->center, draw::pixel(x, y)) < 0.02f;
    };
    EXPECT_EQ(std::ranges::count_if(drawing.primitives, is_there), 1);
  }
  EXPECT_EQ(all["points"][0]["number"], 1);
  EXPECT_EQ(all["points"][0]["id"], "b:v4");
  EXPECT_EQ(all["points"][1]["id"], "b:v5");
}

TEST(Anchors, ANormalPointsUpFromBetweenThePoints) {
  CrateOnSlab scene;
  scene.view.layers = {Layer::Shapes, Layer::Contacts};
  const json all = anchors(scene);
  ASSERT_EQ(all["normals"].size(), 1u);
  const json& normal = all["normals"][0];
  EXPECT_LT(normal["tip"]["pixels"][1], normal["at"]["pixels"][1]);
}

TEST(Anchors, FacesHaveTheirNameMiddleAndCorners) {
  CrateOnSlab scene;
  scene.view.layers = {Layer::Shapes, Layer::ReferenceFace};
  trace::Clip& clip = scene.pair().clip.emplace();
  clip.reference.shape = "slab";
  clip.reference.polygon = {{-0.5, 0, -0.5}, {-0.5, 0, 0.5}, {0.5, 0, 0.5}, {0.5, 0, -0.5}};
  clip.reference.normal = Vec3d::UnitY();
  const json all = anchors(scene);
  ASSERT_EQ(all["faces"].size(), 1u);
  EXPECT_EQ(all["faces"][0]["name"], "reference face");
  EXPECT_EQ(all["faces"][0]["shape"], "slab");
  EXPECT_EQ(all["faces"][0]["polygon"].size(), 4u);
}

TEST(Anchors, LabelsHaveTheirTargetAndPosition) {
  CrateOnSlab scene;
  scene.view.layers = {Layer::Shapes, Layer::Ids};
  const json all = anchors(scene);
  int named = 0;
  for (const json& label : all["labels"]) {
    if (label["text"] != "corner B4") continue;
    EXPECT_EQ(label["layer"], "ids");
    EXPECT_EQ(label["of"], "point b:v4");
    EXPECT_GT(label["box"]["pixels"][2], 10);
    ++named;
  }
  EXPECT_EQ(named, 1);
}

TEST(Anchors, RectanglesOfViewAndCaptions) {
  CrateOnSlab scene;
  scene.view.layers = {Layer::Shapes, Layer::Contacts};
  const json all = anchors(scene);
  std::vector<std::string> names;
  for (const json& rectangle : all["rectangles"]) {
    names.push_back(rectangle["name"]);
    EXPECT_GE(rectangle["rect"]["fraction"][0], 0);
    EXPECT_LE(rectangle["rect"]["fraction"][2], 1);
  }
  EXPECT_THAT(names, testing::ElementsAre("view", "legend", "title", "source", "moment"));
}

}  // namespace
}  // namespace contactscope::vector
