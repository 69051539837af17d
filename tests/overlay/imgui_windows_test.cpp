#include "overlay/panels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <imgui.h>

#include <filesystem>
#include <functional>
#include <memory>

namespace contactscope::overlay {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

void window(const char* name, ImVec2 corner, ImVec2 size) {
  ImGui::SetNextWindowPos(corner);
  ImGui::SetNextWindowSize(size);
  ImGui::Begin(name, nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoSavedSettings);
  ImGui::End();
}

std::vector<draw::Fill> fills(Windows& windows, const std::function<void()>& issue) {
  draw::Drawing drawing;
  windows.begin_frame();
  issue();
  windows.end_frame(drawing);
  std::vector<draw::Fill> list;
  for (const draw::Primitive& primitive : drawing.primitives)
    list.push_back(std::get<draw::Fill>(primitive));
  return list;
}

/// Left, top, right and bottom of all fills together, and their area.
std::vector<float> extent(const std::vector<draw::Fill>& list) {
  std::vector<float> result = {1e9f, 1e9f, -1e9f, -1e9f, 0};
  for (const draw::Fill& fill : list) {
    for (std::size_t i = 0; i < fill.polygon.size(); ++i) {
      const draw::Point2& p = fill.polygon[i];
      const draw::Point2& next = fill.polygon[(i + 1) % fill.polygon.size()];
      result = {std::min(result[0], p.x), std::min(result[1], p.y), std::max(result[2], p.x),
                std::max(result[3], p.y), result[4] + 0.5f * (p.x * next.y - next.x * p.y)};
    }
  }
  return result;
}

void sample() { window("sample", {40, 30}, {200, 140}); }

TEST(Windows, AreWhiteRectanglesWhereTheyStand) {
  Windows windows(320, 200, 1);
  const std::vector<draw::Fill> list = fills(windows, sample);
  EXPECT_THAT(extent(list), ElementsAre(40, 30, 240, 170, 200 * 140));
  for (const draw::Fill& fill : list) {
    EXPECT_EQ(fill.color.r, 1);
    EXPECT_EQ(fill.color.a, 1);
  }
}

TEST(Windows, AreCutAtTheBorderOfTheCanvas) {
  Windows windows(320, 200, 1);
  const auto at_the_corner = [] { window("sample", {300, 150}, {100, 100}); };
  EXPECT_THAT(extent(fills(windows, at_the_corner)), ElementsAre(300, 150, 320, 200, 20 * 50));
}

TEST(Windows, ShapesHaveTheirOwnColourAndAreCutByClipRectangles) {
  Windows windows(320, 200, 1);
  const std::vector<draw::Fill> list = fills(windows, [] {
    ImDrawList* shapes = ImGui::GetForegroundDrawList();
    shapes->PushClipRect({150, 125}, {170, 145}, true);
    shapes->AddRectFilled({100, 120}, {220, 150}, IM_COL32(0, 158, 115, 255));
    shapes->PopClipRect();
  });
  EXPECT_THAT(extent(list), ElementsAre(150, 125, 170, 145, 20 * 20));
  EXPECT_FLOAT_EQ(list.at(0).color.g, 158 / 255.0f);
}

TEST(Windows, EqualFramesOfOneSequenceAreEqual) {
  Windows windows(320, 200, 1);
  const std::vector<float> first = extent(fills(windows, sample));
  for (int i = 0; i < 5; ++i) EXPECT_EQ(extent(fills(windows, sample)), first) << i;
  EXPECT_THAT(fills(windows, [] {}), IsEmpty());
  EXPECT_EQ(extent(fills(windows, sample)), first) << "after a frame without the window";
}

TEST(Windows, TwoContextsTakeTurns) {
  Windows windows(320, 200, 1);
  const auto padding = [](Windows& of) {
    of.begin_frame();
    const float found = ImGui::GetStyle().WindowPadding.x;
    draw::Drawing drawing;
    of.end_frame(drawing);
    return found;
  };
  EXPECT_EQ(padding(windows), 12);
  {
    Windows larger(320, 200, 2);
    EXPECT_EQ(padding(larger), 24);
    EXPECT_EQ(padding(windows), 12);
  }
  EXPECT_EQ(padding(windows), 12) << "after the other is gone";
}

TEST(Windows, MoreVerticesThanSixteenBitsCount) {
  Windows windows(320, 200, 1);
  const std::vector<draw::Fill> list = fills(windows, [] {
    ImDrawList* shapes = ImGui::GetForegroundDrawList();
    for (int i = 0; i < 20000; ++i) {
      const float x = static_cast<float>(i % 100), y = static_cast<float>(i / 100);
      shapes->AddRectFilled({x, y}, {x + 1, y + 1}, IM_COL32(i / 100, 0, 0, 255));
    }
  });
  ASSERT_EQ(list.size(), 40000u);
  for (const std::size_t row : {0, 99, 150, 199}) {
    EXPECT_FLOAT_EQ(list[200 * row].color.r, static_cast<float>(row) / 255);
    EXPECT_EQ(list[200 * row].polygon[0].y, static_cast<float>(row));
  }
}

TEST(Windows, LeaveNoFilesBehind) {
  std::filesystem::remove("imgui.ini");
  {
    Windows windows(320, 200, 1);
    // A window that may be saved, for longer than the five seconds after which ImGui saves.
    for (int i = 0; i < 400; ++i) {
      fills(windows, [] {
        ImGui::Begin("saved", nullptr, ImGuiWindowFlags_NoDecoration);
        ImGui::End();
      });
    }
  }
  EXPECT_FALSE(std::filesystem::exists("imgui.ini"));
  EXPECT_FALSE(std::filesystem::exists("imgui_log.txt"));
}

}  // namespace
}  // namespace contactscope::overlay
