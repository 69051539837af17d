#include "draw/scene/outlines.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

namespace contactscope::draw {
namespace {

/// Values of a function of column and row.
template <class Function>
std::vector<double> grid(int columns, int rows, const Function& function) {
  std::vector<double> values;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) values.push_back(function(column, row));
  return values;
}

double length_of(const Contour& contour) {
  double length = 0;
  for (std::size_t i = contour.closed ? 0 : 1; i < contour.points.size(); ++i) {
    const std::size_t before = (i + contour.points.size() - 1) % contour.points.size();
    length += (contour.points[i] - contour.points[before]).norm();
  }
  return length;
}

/// A rasterizer that rounds corners leaves no gap only between polygons that share the corners of
/// their border.
TEST(Outlines, PiecesAroundHolesShareTheCornersOnTheirBorders) {
  const Outline square = {{0, 0}, {640, 0}, {640, 480}, {0, 480}};
  std::vector<Outline> pieces = {square};
  double holes = 0;
  for (const Vec2d& middle : {Vec2d(200, 250), Vec2d(400, 260)}) {
    Outline hole;
    for (int i = 0; i < 24; ++i) {
      const double angle = 2 * std::numbers::pi * i / 24;
      hole.push_back(middle + 80 * Vec2d(std::cos(angle), std::sin(angle)));
    }
    holes += area_of(hole);
    pieces = without(pieces, hole);
  }
  double area = 0;
  const std::vector<Outline> joined = with_shared_corners(pieces);
  ASSERT_GT(joined.size(), 24u);
  ASSERT_EQ(joined.size(), pieces.size());
  for (const Outline& piece : joined) area += area_of(piece);
  EXPECT_NEAR(area, area_of(square) - holes, 1);
  int inside_edges = 0;
  for (const Outline& piece : joined)
    for (std::size_t i = 0; i < piece.size(); ++i) {
      const Vec2d &from = piece[i], edge = piece[(i + 1) % piece.size()] - from;
      for (const Outline& other : joined)
        for (const Vec2d& corner : other) {
          const Vec2d offset = corner - from;
          const double along = edge.dot(offset) / edge.norm();
          inside_edges +=
              along > 0.02 && along < edge.norm() - 0.02 &&
              std::abs(edge.x() * offset.y() - edge.y() * offset.x()) < 0.005 * edge.norm();
        }
    }
  EXPECT_EQ(inside_edges, 0);
}

TEST(Contours, ACircleIsOneClosedLine) {
  const auto values =
      grid(41, 31, [](int x, int y) { return std::hypot(x - 19.3, y - 15.1) - 11.2; });
  const std::vector<Contour> found = contours_at(values, 41, 0);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(found[0].closed);
  for (const Vec3d& point : found[0].points)
    EXPECT_NEAR((point - Vec3d(19.3, 15.1, 0)).norm(), 11.2, 0.02);
  EXPECT_NEAR(length_of(found[0]), 2 * 3.14159265 * 11.2, 0.1);
}

TEST(Contours, APlaneEndsAtTheBorder) {
  const auto values = grid(9, 5, [](int x, int y) { return 0.5 * x + y; });
  const std::vector<Contour> found = contours_at(values, 9, 2.75);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_FALSE(found[0].closed);
  for (const Vec3d& point : found[0].points) EXPECT_NEAR(0.5 * point.x() + point.y(), 2.75, 1e-12);
  EXPECT_NEAR(length_of(found[0]), std::hypot(5.5, 2.75), 1e-12);
}

TEST(Contours, WhereTwoCouldCrossTheMeanDecides) {
  const std::vector<double> values = {1, -1, -1, 3};
  const auto both_ends = [&](double level) {
    std::vector<double> sums;
    for (const Contour& contour : contours_at(values, 2, level)) {
      EXPECT_EQ(contour.points.size(), 2U);
      sums.push_back(contour.points.front().sum() + contour.points.back().sum());
    }
    return sums;
  };
  // The mean is 0.5. Below it the high corners are connected, and each line surrounds a low corner.
  EXPECT_THAT(both_ends(0), testing::ElementsAre(testing::DoubleNear(0.5 + 1.25, 1e-12),
                                                 testing::DoubleNear(0.5 + 1.25, 1e-12)));
  // Above it each line surrounds a high corner.
  EXPECT_THAT(both_ends(0.75), testing::ElementsAre(testing::DoubleNear(0.25, 1e-12),
                                                    testing::DoubleNear(2.875, 1e-12)));
}

TEST(Contours, GoByACornerThatLiesOnAPointOfTheGrid) {
  const auto notch = [](int x, int y) { return std::min(x - 2.0, y - 2.0); };
  const std::vector<Contour> lines = contours_at(grid(5, 5, notch), 5, 0);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_THAT(lines[0].points, testing::Contains(Vec3d(2, 2, 0)));
}

TEST(Contours, ConstantOrOutOfRangeHasNone) {
  EXPECT_TRUE(contours_at(grid(5, 5, [](int, int) { return 2.0; }), 5, 0).empty());
  EXPECT_TRUE(contours_at(grid(5, 5, [](int, int) { return 0.0; }), 5, 0).empty());
  EXPECT_TRUE(contours_at(grid(5, 1, [](int x, int) { return x - 2.0; }), 5, 0).empty());
}

}  // namespace
}  // namespace contactscope::draw
