#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "draw/contact_cells_sample.h"
#include "support/random_geometry.h"

namespace contactscope::draw {
namespace {

using testing::Contains;
using testing::Not;

Vec2d at_angle(double angle) { return {std::cos(angle), std::sin(angle)}; }

std::vector<Vec2d> square(double half_side) {
  return {{half_side, half_side},
          {-half_side, half_side},
          {-half_side, -half_side},
          {half_side, -half_side}};
}

/// Turned about the origin, then moved.
std::vector<Vec2d> placed(const std::vector<Vec2d>& points, double angle, const Vec2d& offset) {
  return mapped(points, [&](const Vec2d& point) {
    return Vec2d(offset + point.x() * at_angle(angle) +
                 point.y() * at_angle(angle + 0.5 * std::numbers::pi));
  });
}

TEST(MomentRose, SquarePatchResistsItsHalfSideTimesCosinePlusSine) {
  test::Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const double half_side = random.decade(-3, 1), turn = random.uniform(0, 7);
    const double angle = random.uniform(0, 7);
    const std::vector<Vec2d> corners =
        placed(square(half_side), turn, random.vector(-2, 2).head<2>());
    EXPECT_NEAR(longest_arm(corners, mean_of(corners), at_angle(turn + angle)),
                half_side * (std::abs(std::cos(angle)) + std::abs(std::sin(angle))), 1e-14);
  }
}

// Four more points on its axes of symmetry: across a side, the corners of the square have the arm of
// the half side, and all eight points that of these four.
TEST(MomentRose, SquareInsideAStarIsWeakestAcrossItsSides) {
  test::Random random(4);
  for (int i = 0; i < 1000; ++i) {
    const double half_side = random.uniform(0.1, 1), reach = half_side * random.uniform(1.01, 4);
    const double turn = random.uniform(0, 7);
    const Vec2d offset = random.vector(-2, 2).head<2>();
    const std::vector<Vec2d> kept = placed(square(half_side), turn, offset);
    std::vector<Vec2d> all = kept;
    for (const Vec2d& tip :
         placed(square(reach / std::sqrt(2)), turn + std::numbers::pi / 4, offset))
      all.push_back(tip);
    const WeakestTilt tilt = weakest_tilt(all, kept);
    EXPECT_NEAR(tilt.share, half_side / reach, 1e-12);
    EXPECT_NEAR(tilt.arm.norm(), reach, 1e-12);
    EXPECT_NEAR(std::sin(2 * (std::atan2(tilt.arm.y(), tilt.arm.x()) - turn)), 0, 1e-9);
  }
}

TEST(MomentRose, SlowNoDirectionOfRandomPatchesIsWeaker) {
  test::Random random(5);
  int tips = 0, whole = 0;
  for (int i = 0; i < 400; ++i) {
    std::vector<Vec2d> all, kept;
    for (int count = 3 + random.index(7); count > 0; --count) {
      all.emplace_back(random.vector(-1, 1).head<2>());
      if (kept.empty() || random.chance(0.6)) kept.push_back(all.back());
    }
    const Vec2d center = mean_of(all);
    const auto share_towards = [&](const Vec2d& toward) {
      return longest_arm(kept, center, toward) / longest_arm(all, center, toward);
    };
    const WeakestTilt tilt = weakest_tilt(all, kept);
    for (int k = 0; k < 3600; ++k)
      EXPECT_GE(share_towards(at_angle(k * std::numbers::pi / 1800)), tilt.share - 2e-4);
    if (tilt.share < 1) {
      EXPECT_NEAR(share_towards(tilt.arm.normalized()), tilt.share, 1e-12);
      EXPECT_NEAR(longest_arm(all, center, tilt.arm.normalized()), tilt.arm.norm(), 1e-12);
    }
    tips += tilt.share < 0;
    whole += tilt.share == 1;
  }
  EXPECT_GT(tips, 20);
  EXPECT_GT(whole, 20);
}

TEST(MomentRose, PointsOnALineTipOverTheLastOfThem) {
  std::vector<Vec2d> line;
  for (int i = 0; i < 5; ++i) line.emplace_back(Vec2d(1, 2) * i);
  const WeakestTilt half = weakest_tilt(line, {line[0], line[1], line[2], line[3]});
  EXPECT_NEAR(half.share, 0.5, 1e-12);
  EXPECT_NEAR((half.arm - Vec2d(2, 4)).norm(), 0, 1e-12);
  EXPECT_NEAR(weakest_tilt(line, {line[0], line[2]}).share, 0, 1e-12);
  EXPECT_EQ(weakest_tilt(line, {line[0], line[4]}).share, 1);
  EXPECT_EQ(weakest_tilt({line[1], line[1]}, {line[1]}).share, 1);
}

Drawing rose_of(const std::vector<ContactMoment>& moments, int width = 1280, int height = 720) {
  FigureStyle style;
  style.legend = width > 1000;
  return ContactCells("A crate on a floor", "Gregorius 2015", "y", moments, 0, width, height, style,
                      true)
      .frame(moments.front().frame);
}

// From the middle of a square, the border of the rose is farthest at the corners: by the diagonal.
TEST(MomentRose, DrawnRoseOfASquareReachesItsCornersAndTheMiddlesOfItsSides) {
  ContactMoment moment;
  moment.cells = {cell_of("area", {})};
  for (const Vec2d& corner : square(0.5))
    moment.cells[0].points.push_back({Vec3d(corner.x(), 0, corner.y()), -0.01, "id"});
  moment.cells[0].kept = {0, 1, 2, 3};
  const Drawing drawing = rose_of({moment}, 900, 700);
  std::vector<Point2> rim;
  Vec2d middle = Vec2d::Zero();
  for (const Stroke& stroke : all<Stroke>(drawing))
    if (stroke.color == kDropped) rim.push_back(stroke.from);
  ASSERT_GT(rim.size(), 100u);
  const std::vector<Disc> marks = rings(drawing);  // the load in the middle, and the kept points
  ASSERT_EQ(marks.size(), 5u);
  for (const Disc& ring : std::span(marks).subspan(1)) middle += 0.25 * flat(ring.center);
  EXPECT_LT((flat(marks[0].center) - middle).norm(), 0.1);
  EXPECT_THAT(words(drawing), Contains("load"));
  const double corner = (flat(marks[1].center) - middle).norm();
  double least = corner, most = 0;
  for (const Point2& place : rim) {
    least = std::min(least, (flat(place) - middle).norm());
    most = std::max(most, (flat(place) - middle).norm());
  }
  EXPECT_NEAR(most, corner, 0.1);
  EXPECT_NEAR(least, corner / std::sqrt(2), 0.1);
  EXPECT_THAT(words(drawing), Not(Contains("100 %")));
}

TEST(MomentRose, StaysOnTheCanvasWithTheShareOfEachReducer) {
  for (const int cells : {1, 3, 18}) {
    for (const int frames : {1, 20}) {
      for (const auto& [width, height] : {std::pair{640, 360}, {1280, 720}}) {
        const Drawing drawing = rose_of(moments_of(cells, frames), width, height);
        expect_on_canvas(drawing, std::to_string(cells) + " cells");
        const std::vector<std::string> texts = words(drawing);
        EXPECT_EQ(std::ranges::count_if(texts,
                                        [](const std::string& text) {
                                          return text.ends_with(" % left") &&
                                                 !text.starts_with("area");
                                        }),
                  cells);
        EXPECT_THAT(texts, Not(Contains("deepest lost, tips over")));
        const auto explained = std::ranges::count(texts, "radius: moment resisted");
        EXPECT_LE(explained, cells < 18);  // once, where there is room
        if (cells == 1 && frames == 1 && width == 1280) {
          EXPECT_EQ(explained, 1);
        }
      }
    }
  }
}

}  // namespace
}  // namespace contactscope::draw
