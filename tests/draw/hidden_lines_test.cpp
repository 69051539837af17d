#include "draw/scene/visibility.h"

#include <gtest/gtest.h>

#include "draw/scene/sketch.h"
#include "support/random_geometry.h"

namespace contactscope::draw {
namespace {

const Rect kViewport{0, 0, 400, 400};
const std::vector<Vec3d> kSquare = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};

Camera from_front() {
  return Camera::orthographic({0, 0, 10}, {0, 0, 0}, Vec3d::UnitY(), 4, kViewport);
}

double hidden_length(const std::vector<Span>& spans) {
  double sum = 0;
  for (const Span& span : spans) sum += span.hidden ? span.to - span.from : 0;
  return sum;
}

TEST(HiddenLines, ASquareSeenEdgeOnHidesNothing) {
  test::Random random(41);
  for (int i = 0; i < 2000; ++i) {
    const Quatd turn(Eigen::AngleAxisd(random.uniform(0, 6), Vec3d::UnitZ()));
    Quatd noise = Quatd::Identity();  // rounding that a solver's step leaves
    noise.vec() = random.vector(-3e-17, 3e-17);
    std::vector<Vec3d> side;
    for (const Vec3d& corner : kSquare)
      side.push_back(noise * (turn * Vec3d(corner.x(), 0.6, corner.y() - 0.5)));
    const HiddenLines lines(from_front(), {side});
    const Vec3d from = turn * random.vector(-2, 2), to = turn * random.vector(-2, 2);
    ASSERT_EQ(hidden_length(lines.split(from, to)), 0) << "square " << i;
  }
}

TEST(HiddenLines, ASliverThatIsNotFlatHidesNothingBeyondIt) {
  test::Random random(43);
  int hiding = 0;
  for (int i = 0; i < 2000; ++i) {
    std::vector<Vec3d> sliver;
    Eigen::AlignedBox3d box;
    for (int k = 0; k < 5; ++k) {
      sliver.push_back(random.vector(-1e-3, 1e-3).cwiseProduct(Vec3d(1, 0.02, 1)));
      box.extend(sliver.back());
    }
    const HiddenLines lines(from_front(), {sliver});
    const Vec3d from(-2, random.uniform(-2e-5, 2e-5), -1), to(2, random.uniform(-2e-5, 2e-5), -1);
    const double hidden = 4 * hidden_length(lines.split(from, to));
    ASSERT_LE(hidden, box.sizes().x()) << "sliver " << i;
    hiding += hidden > 0;
  }
  EXPECT_GT(hiding, 50);
}

TEST(HiddenLines, MiddleOfALineBehindASquareIsHidden) {
  const HiddenLines lines(from_front(), {kSquare});
  const std::vector<Span> spans = lines.split({-2, 0, -1}, {2, 0, -1});
  ASSERT_EQ(spans.size(), 3u);
  EXPECT_FALSE(spans[0].hidden);
  EXPECT_TRUE(spans[1].hidden);
  EXPECT_NEAR(spans[1].from, 0.25, 1e-3);
  EXPECT_NEAR(spans[1].to, 0.75, 1e-3);
  EXPECT_FALSE(spans[2].hidden);
}

TEST(HiddenLines, LineInFrontIsSeen) {
  const HiddenLines lines(from_front(), {kSquare});
  EXPECT_EQ(hidden_length(lines.split({-2, 0, 1}, {2, 0, 1})), 0);
}

TEST(HiddenLines, EdgesOfTheOccluderItselfAreSeen) {
  const HiddenLines lines(from_front(), {kSquare});
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(hidden_length(lines.split(kSquare[i], kSquare[(i + 1) % 4])), 0);
  }
}

TEST(HiddenLines, LinePiercingASquareIsHiddenFromTheCrossingOn) {
  const HiddenLines lines(from_front(), {kSquare});
  const std::vector<Span> spans = lines.split({0, 0, 1}, {0.5, 0, -1});
  ASSERT_EQ(spans.size(), 2u);
  EXPECT_FALSE(spans[0].hidden);
  EXPECT_NEAR(spans[0].to, 0.5, 1e-3);
  EXPECT_TRUE(spans[1].hidden);
}

TEST(HiddenLines, NoGapBetweenTheShadowsOfNeighbours) {
  const std::vector<Vec3d> left = {{-1, -1, 0}, {0, -1, 0}, {0, 1, 0}, {-1, 1, 0}};
  const std::vector<Vec3d> right = {{0, -1, 0}, {1, -1, 0}, {1, 1, 0}, {0, 1, 0}};
  const HiddenLines lines(from_front(), {left, right});
  const std::vector<Span> spans = lines.split({-0.9, 0.1, -1}, {0.9, 0.2, -1});
  ASSERT_EQ(spans.size(), 1u);
  EXPECT_TRUE(spans[0].hidden);
}

// The same depth is hidden behind a floor of any width: 5 mm of 4 m are one pixel here.
TEST(HiddenLines, TheWidthOfAFloorDoesNotDecideWhatItHides) {
  for (const double half : {1.0, 128.0}) {
    const HiddenLines lines(
        from_front(), {{{-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0}}});
    EXPECT_NEAR(hidden_length(lines.split({-0.5, 0, -0.005}, {0.5, 0, -0.005})), 1, 1e-12) << half;
    EXPECT_EQ(hidden_length(lines.split({-0.5, 0, 0}, {0.5, 0, 0})), 0) << half;
  }
}

TEST(HiddenLines, PerspectiveShadowWidensBehindTheOccluder) {
  const Camera camera = Camera::perspective({0, 0, 10}, {0, 0, 0}, Vec3d::UnitY(), 0.6, kViewport);
  const HiddenLines lines(camera, {kSquare});
  // Ten metres behind, the shadow is twice as wide as the square.
  const std::vector<Span> spans = lines.split({-4, 0, -10}, {4, 0, -10});
  ASSERT_EQ(spans.size(), 3u);
  EXPECT_NEAR(8 * (spans[1].to - spans[1].from), 4, 1e-2);
}

TEST(HiddenLines, CurvesWithoutAPieceDrawNothing) {
  Sketch sketch;
  for (const bool closed : {false, true}) {
    Curve curve;
    curve.style.width = 2;
    curve.closed = closed;
    sketch.curves.push_back(curve);
  }
  sketch.curves.push_back({{{0.1, 0.2, 0}}, {.width = 2}});
  Drawing drawing;
  compose(sketch, from_front(), make_layout(400, 400, false, {}), drawing);
  EXPECT_TRUE(drawing.primitives.empty());

  sketch.curves.push_back({{{0.1, 0.2, 0}, {0.5, 0.2, 0}}, {.width = 2}});
  compose(sketch, from_front(), make_layout(400, 400, false, {}), drawing);
  EXPECT_FALSE(drawing.primitives.empty());
}

}  // namespace
}  // namespace contactscope::draw
