#include "draw/scene/labels.h"

#include <gtest/gtest.h>

#include <random>

namespace contactscope::draw {
namespace {

const Rect kView{0, 0, 300, 200};
constexpr float kWidth = 60, kAscent = 10, kDescent = 4;

Rect box(const LabelPlacer::Place& place) {
  return {place.left_baseline.x, place.left_baseline.y - kAscent, kWidth, kAscent + kDescent};
}

bool overlap(const Rect& a, const Rect& b) {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

TEST(LabelPlacer, FreeLabelStandsInTheWantedDirection) {
  LabelPlacer placer(kView);
  const auto place = placer.place({150, 100}, kWidth, kAscent, kDescent, {8, {0, -1}});
  ASSERT_TRUE(place);
  EXPECT_LT(place->left_baseline.y, 100);
  EXPECT_FALSE(place->needs_leader);
}

TEST(LabelPlacer, CrowdedLabelsNeitherOverlapNorLeaveTheViewNorCoverPoints) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> x(0, 300), y(0, 200);
  for (int round = 0; round < 50; ++round) {
    LabelPlacer placer(kView);
    std::vector<Point2> points;
    for (int i = 0; i < 14; ++i) points.push_back({x(random), y(random)});
    for (const Point2& p : points) placer.block(p, 6);
    std::vector<Rect> boxes;
    int placed = 0;
    for (const Point2& p : points) {
      const auto place = placer.place(p, kWidth, kAscent, kDescent, {8, {1, 0}});
      if (!place) continue;
      ++placed;
      const Rect b = box(*place);
      EXPECT_GE(b.x, kView.x);
      EXPECT_GE(b.y, kView.y);
      EXPECT_LE(b.x + b.width, kView.x + kView.width);
      EXPECT_LE(b.y + b.height, kView.y + kView.height);
      for (const Rect& other : boxes) EXPECT_FALSE(overlap(b, other));
      for (const Point2& q : points) EXPECT_FALSE(overlap(b, {q.x - 6, q.y - 6, 12, 12}));
      boxes.push_back(b);
    }
    EXPECT_GE(placed, 8);
  }
}

TEST(LabelPlacer, WithoutAnyRoomThereIsNoLabel) {
  LabelPlacer placer({0, 0, 40, 40});
  EXPECT_FALSE(placer.place({20, 20}, kWidth, kAscent, kDescent, {8, {1, 0}}));
}

TEST(LabelPlacer, FarPlacesGetALeader) {
  LabelPlacer placer(kView);
  placer.block(Point2{150, 100}, 45);
  const auto place = placer.place({150, 100}, kWidth, kAscent, kDescent, {8, {0, -1}});
  ASSERT_TRUE(place);
  EXPECT_TRUE(place->needs_leader);
}

TEST(LabelPlacer, LinesDoNotCrossALabelThatHasRoomElsewhere) {
  LabelPlacer placer(kView);
  placer.avoid({{0, 90}, {300, 90}});  // directly above the anchor, the label's preferred place
  const auto place = placer.place({150, 100}, kWidth, kAscent, kDescent, {8, {0, -1}});
  ASSERT_TRUE(place);
  const Rect b = box(*place);
  EXPECT_TRUE(b.y > 90 || b.y + b.height < 90);
}

TEST(LabelPlacer, WhereLinesAreEverywhereTheLabelStandsOnThem) {
  LabelPlacer placer(kView);
  for (float y = 0; y < 200; y += 5) placer.avoid({{0, y}, {300, y}});
  EXPECT_TRUE(placer.place({150, 100}, kWidth, kAscent, kDescent, {8, {0, -1}}));
}

}  // namespace
}  // namespace contactscope::draw
