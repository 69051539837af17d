#include "draw/scene/pen.h"

#include <gtest/gtest.h>

#include <cmath>

namespace contactscope::draw {
namespace {

std::vector<Stroke> hatched(const std::vector<Vec2d>& whole, const std::vector<Vec2d>& hole,
                            double spacing) {
  Drawing drawing;
  Pen(drawing, 1, 1).hatch(convex_polygon(whole), convex_polygon(hole), spacing, 1, Color{});
  std::vector<Stroke> strokes;
  for (const Primitive& primitive : drawing.primitives) {
    strokes.push_back(std::get<Stroke>(primitive));
  }
  return strokes;
}

double length_of(const std::vector<Stroke>& strokes) {
  double sum = 0;
  for (const Stroke& s : strokes) sum += std::hypot(s.to.x - s.from.x, s.to.y - s.from.y);
  return sum;
}

std::vector<Vec2d> box(double x, double y, double width, double height) {
  return {{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}};
}

/// Depth of a place in a box; negative outside.
double depth_in(const Point2& p, double x, double y, double width, double height) {
  return std::min(std::min(p.x - x, x + width - p.x), std::min(p.y - y, y + height - p.y));
}

TEST(Hatch, LengthTimesSpacingIsTheArea) {
  for (const double spacing : {1.0, 2.0, 5.0}) {
    EXPECT_NEAR(spacing * length_of(hatched(box(3, 7, 400, 200), {}, spacing)), 80000, 1600);
    EXPECT_NEAR(spacing * length_of(hatched({{0, 0}, {300, 40}, {90, 250}}, {}, spacing)), 35700,
                700);
  }
}

TEST(Hatch, LeavesTheHoleOut) {
  const std::vector<Stroke> strokes = hatched(box(0, 0, 400, 200), box(100, 50, 200, 100), 2);
  EXPECT_NEAR(2 * length_of(strokes), 60000, 1200);
  for (const Stroke& stroke : strokes) {
    for (int i = 0; i <= 20; ++i) {
      const auto t = static_cast<float>(i) / 20;
      const Point2 p{stroke.from.x + t * (stroke.to.x - stroke.from.x),
                     stroke.from.y + t * (stroke.to.y - stroke.from.y)};
      EXPECT_LE(depth_in(p, 100, 50, 200, 100), 1e-3);
      EXPECT_GE(depth_in(p, 0, 0, 400, 200), -1e-3);
    }
  }
}

TEST(Hatch, AHoleThatSharesCornersIsLeftOutToo) {
  // Half of a square is lost if a triangle of its corners is kept.
  const std::vector<Stroke> strokes =
      hatched(box(0, 0, 300, 300), {{0, 0}, {300, 0}, {300, 300}}, 2);
  EXPECT_NEAR(2 * length_of(strokes), 45000, 900);
  for (const Stroke& s : strokes) {
    EXPECT_GE(s.from.y, s.from.x - 1e-3);
    EXPECT_GE(s.to.y, s.to.x - 1e-3);
  }
}

TEST(Hatch, NothingIsLostWhereAllIsKept) {
  EXPECT_NEAR(length_of(hatched(box(5, 5, 90, 60), box(5, 5, 90, 60), 3)), 0, 1e-3);
  EXPECT_NEAR(length_of(hatched(box(5, 5, 90, 60), box(0, 0, 200, 200), 3)), 0, 1e-3);
}

TEST(Hatch, CollinearOrEqualPointsHaveNone) {
  EXPECT_TRUE(hatched({{1, 1}, {5, 5}, {9, 9}}, {}, 2).empty());
  EXPECT_TRUE(hatched({{1, 1}, {1, 1}, {1, 1}}, {}, 2).empty());
  EXPECT_TRUE(hatched({}, {}, 2).empty());
}

TEST(Hatch, LinesOfNeighboursContinueEachOther) {
  const std::vector<Stroke> left = hatched(box(0, 0, 100, 100), {}, 5);
  const std::vector<Stroke> right = hatched(box(100, 0, 100, 100), {}, 5);
  const auto offset = [](const Stroke& s) { return (s.from.x + s.from.y) / std::sqrt(2.0) / 5; };
  for (const auto& strokes : {left, right}) {
    EXPECT_GT(strokes.size(), 20u);
    for (const Stroke& s : strokes) EXPECT_NEAR(offset(s), std::round(offset(s)), 1e-4);
  }
}

}  // namespace
}  // namespace contactscope::draw
