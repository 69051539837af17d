#include "draw/scene/pen.h"

#include <gmock/gmock.h>

#include <cmath>

namespace contactscope::draw {
namespace {

std::vector<Stroke> strokes(const Drawing& drawing) {
  std::vector<Stroke> list;
  for (const Primitive& primitive : drawing.primitives) {
    if (const Stroke* stroke = std::get_if<Stroke>(&primitive)) list.push_back(*stroke);
  }
  return list;
}

TEST(Pen, SizesAreThoseOfAPictureOf720Lines) {
  Drawing drawing;
  const Pen pen(drawing, 2, 14);
  pen.line({10, 10}, {30, 10}, 1.5, {}, 4);
  pen.text("x", {5, 5}, Align::Left, {});
  const Stroke stroke = strokes(drawing).at(0);
  EXPECT_EQ(stroke.width, 3);
  EXPECT_EQ(stroke.dash, 8);
  EXPECT_FLOAT_EQ(stroke.gap, 5.6f);
  EXPECT_EQ(stroke.to.x, 30) << "places are pixels";
  EXPECT_EQ(std::get<Text>(drawing.primitives[1]).size, 28);
}

TEST(Pen, AStraightPathIsOneStrokeForAnyNumberOfPoints) {
  Drawing drawing;
  std::vector<Point2> points;
  for (int i = 0; i <= 60; ++i) points.push_back({3.0f * static_cast<float>(i), 50});
  Pen(drawing, 1, 14).path(points, 3, {});
  ASSERT_EQ(strokes(drawing).size(), 1u);
  EXPECT_EQ(strokes(drawing)[0].to.x, 180);
}

TEST(Pen, ACurvedPathStaysWithinATenthOfAPixelAndDashesRunOn) {
  Drawing drawing;
  std::vector<Point2> points;
  for (int i = 0; i <= 400; ++i) {
    const float angle = 0.005f * static_cast<float>(i);
    points.push_back({100 * std::cos(angle), 100 * std::sin(angle)});
  }
  Pen(drawing, 1, 14).path(points, 2, {}, 6);
  const std::vector<Stroke> pieces = strokes(drawing);
  EXPECT_LT(pieces.size(), 40u);
  float run = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Point2 middle{0.5f * (pieces[i].from.x + pieces[i].to.x),
                        0.5f * (pieces[i].from.y + pieces[i].to.y)};
    EXPECT_NEAR(std::hypot(middle.x, middle.y), 100, 0.11);
    EXPECT_FLOAT_EQ(pieces[i].phase, run);
    run += std::hypot(pieces[i].to.x - pieces[i].from.x, pieces[i].to.y - pieces[i].from.y);
    if (i > 0) {
      EXPECT_EQ(pieces[i].from.x, pieces[i - 1].to.x);
    }
  }
}

TEST(Pen, APathThatTurnsBackKeepsItsTurn) {
  Drawing drawing;
  Pen(drawing, 1, 14).path({{0, 0}, {50, 0}, {20, 0}}, 1, {});
  ASSERT_EQ(strokes(drawing).size(), 2u);
  EXPECT_EQ(strokes(drawing)[0].to.x, 50);
}

}  // namespace
}  // namespace contactscope::draw
