#include "draw/scene/labels.h"

#include <gtest/gtest.h>

namespace contactscope::draw {
namespace {

constexpr float kHeight = 14;
const Rect kFrame{0, 0, 500, 400};

bool overlap(const Rect& a, const Rect& b) {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

void expect_separated_and_inside(const std::vector<PlacedLabel>& places) {
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Rect& box = places[i].box;
    EXPECT_GE(box.x, kFrame.x);
    EXPECT_GE(box.y, kFrame.y);
    EXPECT_LE(box.x + box.width, kFrame.x + kFrame.width);
    EXPECT_LE(box.y + box.height, kFrame.y + kFrame.height);
    for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(overlap(box, places[j].box)) << i << " " << j;
  }
}

TEST(LineLabels, ALoneLabelStandsRightOfItsEnd) {
  LabelObstacles obstacles;
  obstacles.lines.push_back({{100, 200}, {200, 200}});
  obstacles.markers = {{100, 200}, {200, 200}};
  const std::vector<PlacedLabel> places =
      place_line_labels({{60, {{200, 200}, {100, 200}}}}, obstacles, kFrame, kHeight, 1);
  ASSERT_EQ(places.size(), 1u);
  EXPECT_GT(places[0].box.x, 200);
  EXPECT_LT(places[0].box.x, 220);
  EXPECT_NEAR(places[0].box.y + 0.5 * kHeight, 200, 8);
  EXPECT_FALSE(places[0].needs_leader);
}

TEST(LineLabels, EighteenAtOnePlaceSpreadOut) {
  std::vector<LineLabel> labels;
  LabelObstacles obstacles;
  for (int i = 0; i < 18; ++i) {
    const Point2 end{250, 200 + 0.5f * static_cast<float>(i)};
    labels.push_back({80, {end}});
    obstacles.markers.push_back(end);
  }
  const std::vector<PlacedLabel> places = place_line_labels(labels, obstacles, kFrame, kHeight, 1);
  ASSERT_EQ(places.size(), 18u);
  expect_separated_and_inside(places);
  for (const PlacedLabel& place : places) {
    EXPECT_FALSE(overlap(place.box, {246, 200, 8, 8}));  // the markers stay free
  }
  EXPECT_TRUE(places.back().needs_leader || places.front().needs_leader);
}

TEST(LineLabels, TheFrameAndBoxesHoldAtTheBorder) {
  LabelObstacles obstacles;
  const Rect taken{380, 350, 120, 50};
  obstacles.boxes.push_back(taken);
  const std::vector<PlacedLabel> places = place_line_labels(
      {{90, {{495, 390}}}, {90, {{498, 395}}}, {90, {{2, 2}}}}, obstacles, kFrame, kHeight, 1);
  expect_separated_and_inside(places);
  for (const PlacedLabel& place : places) EXPECT_FALSE(overlap(place.box, taken));
}

TEST(LineLabels, AFrameTooSmallStillGivesEveryLabelAPlace) {
  const std::vector<LineLabel> labels(5, LineLabel{90, {{20, 10}}});
  EXPECT_EQ(place_line_labels(labels, {}, {0, 0, 100, 30}, kHeight, 1).size(), 5u);
}

}  // namespace
}  // namespace contactscope::draw
