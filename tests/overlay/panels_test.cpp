// Drawings painted into panels, and the panels that are made of them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <imgui.h>

#include "draw/scene/palette.h"
#include "gl/painting.h"
#include "gl/rasterizer.h"
#include "overlay/imgui_renderer.h"
#include "overlay/paint.h"
#include "overlay/panels.h"

namespace contactscope::overlay {
namespace {

using ::testing::ElementsAre;
using testing::pixel;

constexpr draw::Color kRed{1, 0, 0, 1}, kBlue{0, 0, 1, 1};

class PaintedPanel : public ::testing::Test {
 protected:
  static Image painted(const draw::Drawing& drawing) {
    const auto context = gl::open_context(gl::Backend::Auto);
    gl::Rasterizer rasterizer(*context, 200, 100);
    PanelRenderer panels(*context, 200, 100, 1);
    rasterizer.begin({1, 1, 1, 1});
    panels.begin_frame();
    paint(drawing, ImGui::GetForegroundDrawList());
    panels.end_frame_and_draw();
    return rasterizer.read();
  }
};

TEST_F(PaintedPanel, FillsOfEitherWindingDiscsAndRingsCoverTheirInside) {
  draw::Drawing drawing;
  drawing.primitives = {
      draw::Fill{{{10, 10}, {30, 10}, {30, 30}, {10, 30}}, kRed},
      draw::Fill{{{40, 10}, {40, 30}, {60, 30}, {60, 10}}, kBlue},
      draw::Disc{{90, 20}, 0, 10, kRed},
      draw::Disc{{130, 20}, 8, 12, kBlue},
  };
  const Image image = painted(drawing);
  EXPECT_THAT(pixel(image, 20, 20), ElementsAre(255, 0, 0));
  EXPECT_THAT(pixel(image, 50, 20), ElementsAre(0, 0, 255));
  EXPECT_THAT(pixel(image, 35, 20), ElementsAre(255, 255, 255));
  EXPECT_THAT(pixel(image, 90, 20), ElementsAre(255, 0, 0));
  EXPECT_THAT(pixel(image, 130, 20), ElementsAre(255, 255, 255));
  EXPECT_THAT(pixel(image, 140, 20), ElementsAre(0, 0, 255));
}

TEST_F(PaintedPanel, DashesLeaveGapsAndGoOnWhereThePhaseSays) {
  draw::Drawing drawing;
  draw::Stroke stroke{{0, 20}, {200, 20}, 6, kRed};
  stroke.dash = 20;
  stroke.gap = 20;
  drawing.primitives.push_back(stroke);
  stroke.from.y = stroke.to.y = 60;
  stroke.phase = 20;
  drawing.primitives.push_back(stroke);
  const Image image = painted(drawing);
  for (const int x : {10, 50, 90}) {
    EXPECT_THAT(pixel(image, x, 20), ElementsAre(255, 0, 0)) << x;
    EXPECT_THAT(pixel(image, x + 20, 20), ElementsAre(255, 255, 255)) << x;
    EXPECT_THAT(pixel(image, x, 60), ElementsAre(255, 255, 255)) << x;
    EXPECT_THAT(pixel(image, x + 20, 60), ElementsAre(255, 0, 0)) << x;
  }
}

TEST_F(PaintedPanel, StrokesThatGoOnAreOneLineWithoutBeads) {
  draw::Drawing one, many;
  one.primitives = {draw::Stroke{{20, 50}, {180, 50}, 3, kRed, draw::Cap::Round}};
  for (int x = 20; x < 180; x += 4) {
    const auto from = static_cast<float>(x);
    many.primitives.push_back(draw::Stroke{{from, 50}, {from + 4, 50}, 3, kRed, draw::Cap::Round});
  }
  EXPECT_NEAR(testing::ink(painted(many)), testing::ink(painted(one)),
              0.01 * testing::ink(painted(one)));
}

TEST_F(PaintedPanel, TextStandsOnItsBaselineAtTheEndThatItIsAlignedTo) {
  draw::Drawing drawing;
  draw::Text text;
  text.text = "HH";
  text.at = {100, 60};
  text.size = 15;
  text.align = draw::Align::Right;
  text.color = {0, 0, 0, 1};
  drawing.primitives = {text};
  const Image image = painted(drawing);
  int right = 0, bottom = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (pixel(image, x, y)[0] > 128) continue;
      right = std::max(right, x);
      bottom = std::max(bottom, y);
    }
  }
  EXPECT_NEAR(right, 98, 2);
  EXPECT_NEAR(bottom, 59, 1);
}

/// A ball on the ground that comes to rest, with or without what the panels show.
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

class SeriesPanels : public ::testing::Test {
 protected:
  static Image rendered(const std::vector<trace::Frame>& frames, Panel panel, int width, int height,
                        std::size_t current) {
    trace::Header header;
    header.up = "y";
    trace::Shape ball;
    ball.name = "ball";
    ball.type = "sphere";
    ball.vertices = {Vec3d::Zero()};
    ball.radius = 0.5;
    header.shapes = {ball};
    View view;
    view.panels = {panel};
    const draw::Staging staging = draw::stage(header, frames, view, width, height);
    const auto context = gl::open_context(gl::Backend::Auto);
    gl::Rasterizer rasterizer(*context, width, height);
    PanelRenderer panels(*context, width, height, staging.layout.scale);
    rasterizer.begin({1, 1, 1, 1});
    panels.begin_frame();
    draw_panels({staging, frames, current, std::nullopt});
    panels.end_frame_and_draw();
    return rasterizer.read();
  }
  /// Pixels of a colour.
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

TEST_F(SeriesPanels, PlotsGrowWithTheFrames) {
  const std::vector<trace::Frame> frames = resting_ball(false);
  for (const auto& [width, height] : {std::pair{1280, 720}, {640, 360}}) {
    const int early = count(rendered(frames, Panel::Plots, width, height, 0), draw::kContact);
    const int late = count(rendered(frames, Panel::Plots, width, height, 3), draw::kContact);
    EXPECT_GT(early, 0);
    EXPECT_GT(late, early + 100);
  }
}

TEST_F(SeriesPanels, StabilityShowsVerdictRowsOnlyWithTheFact) {
  const Image with = rendered(resting_ball(true), Panel::Stability, 1280, 720, 3);
  const Image without = rendered(resting_ball(false), Panel::Stability, 1280, 720, 3);
  EXPECT_GT(testing::ink(with), 2 * testing::ink(without)) << "map, margin and verdicts";
  EXPECT_GT(testing::ink(without), 0) << "it says that there is none";
}

}  // namespace
}  // namespace contactscope::overlay
