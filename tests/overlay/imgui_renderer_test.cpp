#include "overlay/imgui_renderer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <imgui.h>

#include <filesystem>
#include <functional>

#include "gl/painting.h"
#include "gl/rasterizer.h"

namespace contactscope::overlay {
namespace {

using ::testing::ElementsAre;
using testing::pixel;

constexpr int kWidth = 320, kHeight = 200;

/// A window with a line, a circle and a clipped rectangle.
void sample_window() {
  ImGui::SetNextWindowPos({40, 30});
  ImGui::SetNextWindowSize({200, 140});
  ImGui::Begin("sample", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoSavedSettings);
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddLine({60, 100}, {200, 120}, IM_COL32(0, 114, 178, 255), 2);
  list->AddCircleFilled({100, 140}, 8, IM_COL32(213, 94, 0, 255));
  list->PushClipRect({150, 125}, {170, 145}, true);
  list->AddRectFilled({100, 120}, {220, 150}, IM_COL32(0, 158, 115, 255));
  list->PopClipRect();
  ImGui::End();
}

class PanelRendererTest : public ::testing::Test {
 protected:
  /// A frame on a grey ground.
  static Image paint(gl::Rasterizer& rasterizer, PanelRenderer& panels,
                     const std::function<void()>& windows = sample_window) {
    rasterizer.begin({0.5f, 0.5f, 0.5f, 1});
    panels.begin_frame();
    windows();
    panels.end_frame_and_draw();
    return rasterizer.read();
  }
  static Image paint_afresh(gl::Backend backend) {
    const auto context = gl::open_context(backend);
    gl::Rasterizer rasterizer(*context, kWidth, kHeight);
    PanelRenderer panels(*context, kWidth, kHeight, 1);
    return paint(rasterizer, panels);
  }
};

TEST_F(PanelRendererTest, DrawsIntoTheRasterizersPictureTheRightWayUp) {
  const Image image = paint_afresh(gl::Backend::Auto);
  EXPECT_THAT(pixel(image, 10, 10), ElementsAre(128, 128, 128)) << "outside of the window";
  EXPECT_THAT(pixel(image, 230, 35), ElementsAre(255, 255, 255)) << "window, top right";
  EXPECT_THAT(pixel(image, 230, 180), ElementsAre(128, 128, 128)) << "below the window";
  EXPECT_THAT(pixel(image, 100, 140), ElementsAre(213, 94, 0)) << "circle";
}

TEST_F(PanelRendererTest, ClipRectanglesCutWhatIsDrawn) {
  const Image image = paint_afresh(gl::Backend::Auto);
  EXPECT_THAT(pixel(image, 160, 135), ElementsAre(0, 158, 115));
  EXPECT_THAT(pixel(image, 148, 135), ElementsAre(255, 255, 255)) << "left of it";
  EXPECT_THAT(pixel(image, 172, 135), ElementsAre(255, 255, 255)) << "right of it";
  EXPECT_THAT(pixel(image, 160, 123), ElementsAre(255, 255, 255)) << "above it";
  EXPECT_THAT(pixel(image, 160, 147), ElementsAre(255, 255, 255)) << "below it";
}

TEST_F(PanelRendererTest, EglAndOsmesaGiveIdenticalBytes) {
  const Image egl = paint_afresh(gl::Backend::Egl);
  EXPECT_EQ(paint_afresh(gl::Backend::Osmesa), egl);
  EXPECT_EQ(paint_afresh(gl::Backend::Egl), egl) << "a fresh context remembers nothing";
}

TEST_F(PanelRendererTest, EqualFramesOfOneSequenceAreEqual) {
  const auto context = gl::open_context(gl::Backend::Auto);
  gl::Rasterizer rasterizer(*context, kWidth, kHeight);
  PanelRenderer panels(*context, kWidth, kHeight, 1);
  const Image first = paint(rasterizer, panels);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(paint(rasterizer, panels), first) << i;
  const Image empty = paint(rasterizer, panels, [] {});
  EXPECT_THAT(pixel(empty, 100, 100), ElementsAre(128, 128, 128));
  EXPECT_EQ(paint(rasterizer, panels), first) << "after a frame without the window";
}

TEST_F(PanelRendererTest, TwoRenderersTakeTurns) {
  const auto context = gl::open_context(gl::Backend::Auto);
  gl::Rasterizer rasterizer(*context, kWidth, kHeight);
  PanelRenderer panels(*context, kWidth, kHeight, 1);
  const Image expected = paint(rasterizer, panels);
  {
    PanelRenderer larger(*context, kWidth, kHeight, 2);
    EXPECT_NE(larger.imgui(), panels.imgui());
    ImGui::SetCurrentContext(larger.imgui());
    EXPECT_EQ(ImGui::GetStyle().WindowPadding.x, 24);
    EXPECT_EQ(paint(rasterizer, larger), expected) << "the same window, and nothing inside it";
    EXPECT_EQ(paint(rasterizer, panels), expected);
  }
  EXPECT_EQ(paint(rasterizer, panels), expected) << "after the other is gone";
}

TEST_F(PanelRendererTest, LeavesTheRasterizerAsItWas) {
  const auto context = gl::open_context(gl::Backend::Auto);
  gl::Rasterizer rasterizer(*context, kWidth, kHeight);
  draw::Drawing drawing;
  drawing.primitives = {draw::Disc{{10, 190}, 0, 6, {0, 0, 0, 1}},
                        draw::Stroke{{0, 0}, {320, 200}, 3, {0, 0, 0, 1}}};
  const Image before = testing::paint(rasterizer, drawing);
  PanelRenderer panels(*context, kWidth, kHeight, 1);
  paint(rasterizer, panels);
  EXPECT_EQ(testing::paint(rasterizer, drawing), before);
}

TEST_F(PanelRendererTest, MoreVerticesThanSixteenBitsCount) {
  const auto context = gl::open_context(gl::Backend::Auto);
  gl::Rasterizer rasterizer(*context, kWidth, kHeight);
  PanelRenderer panels(*context, kWidth, kHeight, 1);
  const Image image = paint(rasterizer, panels, [] {
    ImDrawList* list = ImGui::GetForegroundDrawList();
    for (int i = 0; i < 20000; ++i) {
      const float x = static_cast<float>(i % 100), y = static_cast<float>(i / 100);
      list->AddRectFilled({x, y}, {x + 1, y + 1}, IM_COL32(i / 100, 0, 0, 255));
    }
  });
  for (const int y : {0, 99, 150, 199}) {
    EXPECT_THAT(pixel(image, 50, y), ElementsAre(y, 0, 0));
  }
}

TEST_F(PanelRendererTest, LeavesNoFilesBehind) {
  std::filesystem::remove("imgui.ini");
  const auto context = gl::open_context(gl::Backend::Auto);
  gl::Rasterizer rasterizer(*context, kWidth, kHeight);
  {
    PanelRenderer panels(*context, kWidth, kHeight, 1);
    // A window that may be saved, for longer than the five seconds after which ImGui saves.
    for (int i = 0; i < 400; ++i) {
      paint(rasterizer, panels, [] {
        ImGui::Begin("saved");
        ImGui::End();
      });
    }
  }
  EXPECT_FALSE(std::filesystem::exists("imgui.ini"));
  EXPECT_FALSE(std::filesystem::exists("imgui_log.txt"));
}

}  // namespace
}  // namespace contactscope::overlay
