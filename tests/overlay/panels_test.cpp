// Panels in their windows, as pixels.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <algorithm>

#include "draw/scene/palette.h"
#include "gl/painting.h"
#include "gl/rasterizer.h"
#include "overlay/panels.h"

namespace contactscope::overlay {
namespace {

using ::testing::ElementsAre;
using testing::pixel;

/// A ball on the ground that comes to rest, with or without the facts that the panels show.
std::vector<trace::Frame> resting_ball(bool with_facts) {
  std::vector<trace::Frame> frames(4);
  for (std::size_t f = 0; f < frames.size(); ++f) {
    frames[f].frame = static_cast<int>(f);
    frames[f].time = 0.1 * static_cast<double>(f);
    frames[f].poses = {{"ground", {}}, {"ball", {}}};
    trace::Pair pair;
    pair.a = "ground";
    pair.b = "ball";
    trace::Manifold manifold;
    manifold.normal = Vec3d::UnitY();
    manifold.points = {{{0, 0, 0}, -0.001 * static_cast<double>(f + 1), "a:f0"}};
    pair.manifolds = {manifold};
    if (with_facts) {
      trace::Stability& stability = pair.stability.emplace();
      stability.shape = "ball";
      stability.support = {Vec3d(0, 0, 0)};
      stability.projection = {0.2, 0, 0};
      stability.verdict = "turns about a point";
      stability.margin = -0.2;
    }
    frames[f].pairs = {pair};
  }
  return frames;
}

class PanelColumnTest : public ::testing::Test {
 protected:
  static draw::Staging staged(trace::Header& header, const std::vector<trace::Frame>& frames,
                              const std::vector<Panel>& panels, int width, int height) {
    header.up = "y";
    trace::Shape ball;
    ball.name = "ball";
    ball.type = "sphere";
    ball.vertices = {Vec3d::Zero()};
    ball.radius = 0.5;
    header.shapes = {ball};
    View view;
    view.panels = panels;
    return draw::stage(header, frames, view, width, height);
  }

  static Image rendered(const std::vector<trace::Frame>& frames, const std::vector<Panel>& names,
                        int width, int height, std::size_t current,
                        const draw::Color& ground = draw::kWhite) {
    trace::Header header;
    const draw::Staging staging = staged(header, frames, names, width, height);
    const auto context = gl::open_context(gl::Backend::Auto);
    gl::Rasterizer rasterizer(*context, width, height);
    PanelColumn panels(staging, frames);
    draw::Drawing drawing;
    panels.add({current, {}}, drawing);
    drawing.background = ground;
    rasterizer.paint(drawing);
    return rasterizer.read();
  }
  /// Number of pixels of a colour.
  static int count(const Image& image, const draw::Color& color) {
    int pixels = 0;
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        const testing::Pixel at = pixel(image, x, y);
        pixels += std::abs(at[0] - static_cast<int>(255 * color.r + 0.5f)) <= 1 &&
                  std::abs(at[1] - static_cast<int>(255 * color.g + 0.5f)) <= 1 &&
                  std::abs(at[2] - static_cast<int>(255 * color.b + 0.5f)) <= 1;
      }
    }
    return pixels;
  }
};

TEST_F(PanelColumnTest, PlotsGrowWithTheFrames) {
  const std::vector<trace::Frame> frames = resting_ball(false);
  for (const auto& [width, height] : {std::pair{1280, 720}, {640, 360}}) {
    const int early = count(rendered(frames, {Panel::Plots}, width, height, 0), draw::kBox);
    const int late = count(rendered(frames, {Panel::Plots}, width, height, 3), draw::kBox);
    EXPECT_GT(early, 0);
    EXPECT_GT(late, early + 50) << "the curve has grown; ids that never change are a line of words";
  }
}

TEST_F(PanelColumnTest, StabilityShowsVerdictRowsOnlyWithTheFact) {
  const Image with = rendered(resting_ball(true), {Panel::Stability}, 1280, 720, 3);
  const Image without = rendered(resting_ball(false), {Panel::Stability}, 1280, 720, 3);
  EXPECT_GT(testing::ink(with), 2 * testing::ink(without)) << "map, margin and verdicts";
  EXPECT_GT(testing::ink(without), 0) << "it says that there is none";
}

TEST_F(PanelColumnTest, WindowsAreWhiteWithABorderOfOnePixelAndContentsLieOnThem) {
  const std::vector<trace::Frame> frames = resting_ball(false);
  trace::Header header;
  const draw::Rect column = staged(header, frames, {Panel::Summary}, 1280, 720).layout.panels;
  const Image image = rendered(frames, {Panel::Summary}, 1280, 720, 0, {0.5f, 0.5f, 0.5f, 1});
  const int left = static_cast<int>(column.x), top = static_cast<int>(column.y);
  const auto grey = [&](int x, int y) { return pixel(image, x, y)[0]; };
  EXPECT_EQ(grey(left - 1, top + 20), 128) << "outside";
  EXPECT_NEAR(grey(left, top + 20), 255 - 54, 1) << "the border";
  EXPECT_EQ(grey(left + 1, top + 20), 255) << "inside of it";
  EXPECT_NEAR(grey(left + 100, top), 255 - 54, 1);
  EXPECT_GT(count(image, draw::kText), 50) << "letters";
}

TEST_F(PanelColumnTest, EveryLetterIsOneOfOurOwn) {
  const std::vector<trace::Frame> frames = resting_ball(true);
  trace::Header header;
  const draw::Staging staging = staged(
      header, frames,
      {Panel::Summary, Panel::ContactPlane, Panel::Stability, Panel::AxisHistory, Panel::Plots},
      1280, 1440);
  PanelColumn panels(staging, frames);
  draw::Drawing drawing, again;
  EXPECT_THAT(panels.add({3, {}}, drawing), ::testing::IsEmpty());
  const auto letters = [](const draw::Drawing& all) {
    return std::ranges::count_if(all.primitives, [](const draw::Primitive& primitive) {
      return std::holds_alternative<draw::Text>(primitive);
    });
  };
  EXPECT_GT(letters(drawing), 30);
  // Dear ImGui draws the same windows as two triangles each.
  const auto triangles = [](const draw::Drawing& all) {
    return std::ranges::count_if(all.primitives, [](const draw::Primitive& primitive) {
      const auto* fill = std::get_if<draw::Fill>(&primitive);
      return fill != nullptr && fill->polygon.size() == 3 && fill->color.r == 1;
    });
  };
  EXPECT_EQ(triangles(drawing), 5 * 2);
  panels.add({3, {}}, again);
  EXPECT_EQ(letters(again), letters(drawing));
  EXPECT_EQ(again.primitives.size(), drawing.primitives.size()) << "equal calls, equal pictures";
}

TEST_F(PanelColumnTest, EveryPairIsThereWhereTheColumnHasRoomAtAnyScale) {
  for (int pairs = 1; pairs <= 3; ++pairs) {
    for (const bool degenerate : {false, true}) {
      std::vector<trace::Frame> frames = resting_ball(false);
      for (trace::Frame& frame : frames) {
        if (degenerate) frame.pairs[0].degenerate.emplace();
        frame.pairs.resize(static_cast<std::size_t>(pairs), frame.pairs[0]);
      }
      for (int height = 720; height < 1440; height += 17) {
        trace::Header header;
        const draw::Staging staging =
            staged(header, frames, {Panel::Summary}, height * 16 / 9, height);
        draw::Drawing drawing;
        EXPECT_THAT(PanelColumn(staging, frames).add({0, {}}, drawing), ::testing::IsEmpty())
            << pairs << " pairs, " << height << " lines";
      }
    }
  }
}

TEST_F(PanelColumnTest, PanelsWithoutRoomAreNamedAndTheFirstIsShown) {
  const std::vector<trace::Frame> frames = resting_ball(true);
  trace::Header header;
  const draw::Staging staging =
      staged(header, frames, {Panel::Stability, Panel::Plots, Panel::ContactPlane}, 640, 360);
  PanelColumn panels(staging, frames);
  draw::Drawing drawing;
  EXPECT_THAT(panels.add({3, {}}, drawing), ::testing::Contains("panel contact_plane"));
  const auto says = [&](const std::string& what) {
    return std::ranges::any_of(drawing.primitives, [&](const draw::Primitive& primitive) {
      const auto* text = std::get_if<draw::Text>(&primitive);
      return text != nullptr && text->text.find(what) != std::string::npos;
    });
  };
  EXPECT_TRUE(says("stability: centre of mass"));
  EXPECT_TRUE(says("no room for"));
}

}  // namespace
}  // namespace contactscope::overlay
