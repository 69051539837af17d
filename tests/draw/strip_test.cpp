#include "draw/strip.h"

#include <gmock/gmock.h>

#include "crate_on_slab.h"

namespace contactscope::draw {
namespace {

using crate_sample::CrateOnSlab;

/// Ten frames in which a crate rises by 1 cm each; only the first touches.
CrateOnSlab rising() {
  CrateOnSlab scene;
  scene.view.layers = {Layer::Shapes, Layer::Contacts, Layer::Normals};
  for (int f = 1; f < 10; ++f) {
    trace::Frame frame = scene.frames.front();
    frame.frame = f;
    frame.time = 0.1 * f;
    frame.poses[1].second.position.y() += 0.01 * f;
    frame.pairs[0].manifolds.clear();
    frame.pairs[0].state = "separated";
    scene.frames.push_back(frame);
  }
  return scene;
}

Drawing strip_of(const Strip& strip, const std::vector<trace::Frame>& shown) {
  Drawing page = strip.page();
  for (std::size_t i = 0; i < shown.size(); ++i)
    strip.place(static_cast<int>(i), illustrate(strip.cell(), shown[i]), page);
  return page;
}

std::vector<Text> texts_of(const Drawing& drawing, const std::string& text) {
  std::vector<Text> found;
  for (const Primitive& primitive : drawing.primitives) {
    const Text* one = std::get_if<Text>(&primitive);
    if (one != nullptr && one->text.find(text) != std::string::npos) found.push_back(*one);
  }
  return found;
}

TEST(Strip, HasOneTitleOneLegendAndAMomentACell) {
  const CrateOnSlab scene = rising();
  const std::vector<trace::Frame> shown = {scene.frames[0], scene.frames[5], scene.frames[9]};
  const Strip strip(scene.header, scene.frames, shown, scene.view, 1200, 0, 3, {});
  const Drawing page = strip_of(strip, shown);
  EXPECT_EQ(page.width, 1200);
  EXPECT_EQ(texts_of(page, "A crate on a slab").size(), 1u);
  EXPECT_EQ(texts_of(page, "none").size(), 1u) << "the source";
  EXPECT_EQ(texts_of(page, "frame ").size(), 3u);
  // Only the first frame has contacts, but the common legend explains them.
  const auto legend_of_one = legend_of(strip.cell(), scene.frames[0]).listed;
  for (const LegendEntry& entry : legend_of_one)
    EXPECT_EQ(texts_of(page, entry.text).size(), 1u) << entry.text;
  EXPECT_LT(legend_of(strip.cell(), scene.frames[9]).listed.size(), legend_of_one.size());
}

TEST(Strip, ItsTitleSpeaksOfAllFramesThatAreDrawn) {
  CrateOnSlab scene = rising();
  for (std::size_t f = 1; f < 6; ++f) {
    scene.frames[f].pairs = scene.frames[0].pairs;
    for (trace::Point& point : scene.frames[f].pairs[0].manifolds[0].points)
      point.separation -= 0.001 * static_cast<double>(f);
  }
  scene.frames[5].pairs[0].manifolds[0].points.pop_back();
  scene.view.title = "Engine: {kept:point}, {overlap} deep | Engine: nothing touches";
  const auto title_of = [&](std::vector<std::size_t> numbers) {
    std::vector<trace::Frame> shown;
    for (const std::size_t f : numbers) shown.push_back(scene.frames[f]);
    const Drawing page =
        Strip(scene.header, scene.frames, shown, scene.view, 1600, 0, 3, {}).page();
    const std::vector<Text> titles = texts_of(page, "Engine");
    return titles.size() == 1 ? titles[0].text : std::string();
  };
  EXPECT_EQ(title_of({0, 1, 3}), "Engine: 2 points, 2.00 to 5.00 mm deep");
  EXPECT_EQ(title_of({3, 0, 5}), "Engine: 1 to 2 points, 2.00 to 7.00 mm deep");
  EXPECT_EQ(title_of({9, 0, 5}), "Engine: 1 point, 7.00 mm deep (frame 5)");
  EXPECT_EQ(title_of({7, 8, 9}), "Engine: nothing touches");
}

TEST(Strip, CellsStandInRowsAndDoNotOverlap) {
  const CrateOnSlab scene = rising();
  const std::vector<trace::Frame> shown(scene.frames.begin(), scene.frames.begin() + 5);
  const Strip strip(scene.header, scene.frames, shown, scene.view, 1200, 900, 3, {});
  EXPECT_EQ(strip.height(), 900);
  Drawing page = strip.page();
  const std::vector<Text> moments = texts_of(page, "frame ");
  ASSERT_EQ(moments.size(), 5u);
  EXPECT_EQ(moments[0].at.y, moments[2].at.y);
  EXPECT_EQ(moments[0].at.x, moments[3].at.x);
  EXPECT_GT(moments[3].at.y, moments[0].at.y + static_cast<float>(strip.cell().layout.height));
  const float across = moments[1].at.x - moments[0].at.x;
  EXPECT_GT(across, static_cast<float>(strip.cell().layout.width));
  // Every cell is on the page, below its moment.
  const std::size_t own = page.primitives.size();
  strip.place(4, illustrate(strip.cell(), shown[4]), page);
  ASSERT_GT(page.primitives.size(), own);
  const Rect canvas{0, 0, 1200, 900};
  for (std::size_t i = own; i < page.primitives.size(); ++i) {
    const Fill* fill = std::get_if<Fill>(&page.primitives[i]);
    if (fill == nullptr) continue;
    for (const Point2& corner : fill->polygon) {
      EXPECT_TRUE(canvas.contains(corner));
      EXPECT_GE(corner.y, moments[4].at.y);
      EXPECT_GE(corner.x, moments[4].at.x - 1);
    }
  }
}

TEST(Strip, TypeOfACellIsAsLargeAsThePages) {
  const CrateOnSlab scene = rising();
  const std::vector<trace::Frame> shown = {scene.frames[0], scene.frames[9]};
  for (const double requested : {0.0, 20.0}) {
    FigureStyle style;
    style.type = requested;
    const Strip strip(scene.header, scene.frames, shown, scene.view, 720, 0, 2, style);
    EXPECT_NEAR(strip.cell().layout.scale, requested > 0 ? requested / 15 : 1.0, 1e-5);
  }
}

TEST(Strip, RowsAreOfAboutTheSameLength) {
  for (const auto& [cells, columns] :
       {std::pair{1, 1}, {2, 2}, {4, 4}, {5, 3}, {6, 3}, {8, 4}, {9, 3}})
    EXPECT_EQ(usual_columns(cells), columns) << cells;
}

TEST(Strip, ASheetNamesEachThumbnailAboveIt) {
  const CrateOnSlab scene = rising();
  const ContactSheet sheet("two", 2, 1000, 2, {});
  Drawing page = sheet.page({{"group/a", "First title"}, {"group/b", "Second title"}});
  ASSERT_EQ(texts_of(page, "group/b").size(), 1u);
  const Point2 name = texts_of(page, "group/b").front().at;
  EXPECT_GT(texts_of(page, "Second title").front().at.y, name.y);
  const std::size_t own = page.primitives.size();
  const Staging staging = stage(scene.header, scene.frames, scene.view, sheet.cell_width(),
                                sheet.cell_height(), sheet.thumbnail_style());
  sheet.place(1, illustrate(staging, scene.frames[0]), page);
  ASSERT_GT(page.primitives.size(), own);
  for (std::size_t i = own; i < page.primitives.size(); ++i) {
    const Fill* fill = std::get_if<Fill>(&page.primitives[i]);
    if (fill == nullptr) continue;
    for (const Point2& corner : fill->polygon) {
      EXPECT_GE(corner.x, name.x - 1);
      EXPECT_GT(corner.y, name.y);
      EXPECT_LE(corner.y, static_cast<float>(sheet.height()));
    }
  }
}

}  // namespace
}  // namespace contactscope::draw
