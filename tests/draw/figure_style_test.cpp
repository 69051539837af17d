#include "draw/scene/layout.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "draw/crate_on_slab.h"

namespace contactscope::draw {
namespace {

using crate_sample::CrateOnSlab;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

struct Figure : CrateOnSlab {
  FigureStyle style;
  int width = 1280, height = 720;

  Figure legended() const {
    Figure figure = *this;
    figure.view.layers = {Layer::Shapes, Layer::Contacts};
    return figure;
  }
  Staging staged() const { return stage(header, frames, view, width, height, style); }
  Drawing drawn() const { return illustrate(staged(), frames[0]); }
};

TEST(FigureStyle, AsItStandsChangesNothing) {
  const CrateOnSlab plain;
  Drawing drawing = Figure().drawn();
  const std::size_t count = drawing.primitives.size();
  finish({}, drawing);
  EXPECT_EQ(drawing.primitives.size(), count);
  EXPECT_EQ(crate_sample::texts(drawing),
            crate_sample::texts(illustrate(plain.staged(), plain.frames[0])));
  EXPECT_EQ(drawing.background.a, 1);
}

TEST(FigureStyle, OmittedPartsGiveTheirRoomToTheView) {
  const Rect all = Figure().staged().layout.view;
  Figure figure;
  figure.style.title = false;
  EXPECT_LT(figure.staged().layout.view.y, all.y);
  EXPECT_THAT(crate_sample::texts(figure.drawn()), Not(Contains("A crate on a slab")));
  figure = {};
  figure.style.legend = false;
  figure.view.layers = {Layer::Shapes, Layer::Contacts};
  const double with_legend = Figure().legended().staged().layout.view.height;
  EXPECT_GT(figure.staged().layout.view.height, with_legend);
  figure = {};
  figure.style.footer = false;
  EXPECT_GT(figure.staged().layout.view.bottom(), all.bottom());
  EXPECT_THAT(crate_sample::texts(figure.drawn()), Not(Contains("frame 0, t = 0.000 s")));
  figure.style.title = figure.style.legend = false;
  const Rect bare = figure.staged().layout.view;
  EXPECT_EQ(bare.y, 24);
  EXPECT_EQ(bare.bottom(), 720 - 24);
}

TEST(FigureStyle, AnEmptyTitleLeavesNoHole) {
  Figure figure;
  figure.header.title = "";
  EXPECT_EQ(figure.staged().layout.view.y, 24);
}

TEST(FigureStyle, TypeHasTheRequestedSize) {
  // 8 pt at 300 dots an inch: an em of 33.3 pixels, with a line of 39 pixels.
  Figure figure;
  figure.width = 992;
  figure.height = 1400;
  figure.style.type = type_of_em(8.0 / 72 * 300);
  figure.style.margin = 2;
  figure.view.panels = {Panel::Summary};
  const Layout layout = figure.staged().layout;
  EXPECT_NEAR(layout.px(15), 39.06, 0.05);
  EXPECT_GE(layout.panels.y, layout.view.bottom()) << "too narrow for both side by side";
  EXPECT_EQ(layout.panels.width, layout.view.width);
  EXPECT_LE(layout.panels.bottom(), layout.legend.y);
}

TEST(FigureStyle, WideFiguresKeepSidePanels) {
  Figure figure;
  figure.width = 2126;  // 180 mm
  figure.height = 1200;
  figure.style.type = type_of_em(8.0 / 72 * 300);
  figure.style.margin = 2;
  figure.view.panels = {Panel::Summary};
  const Layout layout = figure.staged().layout;
  EXPECT_GE(layout.panels.x, layout.view.right());
}

TEST(FigureStyle, LinesAloneCanBeWider) {
  Figure figure;
  Drawing drawing = figure.drawn();
  const Drawing before = drawing;
  figure.style.line_width = 2;
  finish(figure.style, drawing);
  for (std::size_t i = 0; i < drawing.primitives.size(); ++i) {
    const Primitive &then = before.primitives[i], &now = drawing.primitives[i];
    if (const Stroke* const line = std::get_if<Stroke>(&now)) {
      EXPECT_FLOAT_EQ(line->width, 2 * std::get<Stroke>(then).width);
    }
    if (const Text* const text = std::get_if<Text>(&now)) {
      EXPECT_EQ(text->size, std::get<Text>(then).size);
    }
  }
}

TEST(FigureStyle, ScaleIsOfTypeAndLines) {
  Figure figure;
  figure.style.scale = 1.5;
  EXPECT_FLOAT_EQ(figure.staged().layout.scale, 1.5f);
}

TEST(FigureStyle, WordsAreReplacedWhereTheyEnterAndMeasuredSo) {
  Figure figure;
  Words words;
  const std::string long_word = "Normale von A nach B" + std::string(80, 'W');
  words.replace("normal, from A to B", long_word);
  words.replace("frame 0, t = {n}", "Bild 0 bei {n}");
  figure.style.words = std::make_shared<const Words>(words);
  figure.view.layers = {Layer::Shapes, Layer::Contacts, Layer::Normals};
  const Staging staging = figure.staged();
  const std::vector<std::string> all = crate_sample::texts(illustrate(staging, figure.frames[0]));
  EXPECT_THAT(all, Contains("Bild 0 bei 0.000 s"));
  EXPECT_THAT(all, Contains(HasSubstr("Normale von A nach B")));
  EXPECT_THAT(all, Not(Contains("normal, from A to B")));
  figure.style.words = nullptr;
  EXPECT_GT(staging.layout.legend.height, figure.staged().layout.legend.height)
      << "the row that it takes is measured in German";
}

TEST(Moments, StoriesAndCountedFramesShowSteps) {
  std::vector<trace::Frame> frames(5);
  for (int i = 0; i < 5; ++i) {
    frames[static_cast<std::size_t>(i)].frame = i;
    frames[static_cast<std::size_t>(i)].time = 0.125 * i;
  }
  EXPECT_EQ(Moments(frames, Story::None).of(frames[2]), "frame 2, t = 0.250 s");
  EXPECT_EQ(Moments(frames, Story::ClipSteps).of(frames[2]), "step 2 of 4");
  EXPECT_EQ(Moments(frames, Story::GjkSteps).of(frames[0]), "step 0 of 4");
  trace::Pair pair;
  pair.clip.emplace().steps.resize(3);
  for (trace::Frame& frame : frames) frame.pairs = {pair};
  EXPECT_EQ(Moments(frames, Story::ClipSteps).of(frames[3]), "step 3 of 4");
  EXPECT_EQ(Moments(frames, Story::ClipSteps).of(frames[4]), "step 4 of 4");
  for (trace::Frame& frame : frames) frame.time = frame.frame;
  EXPECT_EQ(Moments(frames, Story::None).of(frames[2]), "picture 3 of 5");
  frames.resize(1);
  EXPECT_EQ(Moments(frames, Story::None).of(frames[0]), "frame 0, t = 0.000 s");
}

TEST(Camera, OrthographicWithoutAHeightIsFitted) {
  Figure figure;
  figure.view.orthographic_height = 0;
  const Staging staging = figure.staged();
  const Camera& camera = staging.camera;
  EXPECT_FALSE(camera.is_perspective());
  const Scene scene = scene_of(staging, figure.frames[0]);
  for (const PlacedShape& shape : scene.shapes) {
    if (shape.traced().name != "crate") continue;
    for (const Vec3d& vertex : shape.vertices) EXPECT_TRUE(camera.project(vertex).has_value());
  }
  const double metres = camera.viewport().height / camera.pixels_per_metre(Vec3d::Zero());
  EXPECT_GT(metres, 0.5);
  EXPECT_LT(metres, 6);
}

}  // namespace
}  // namespace contactscope::draw
