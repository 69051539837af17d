#include <contactscope/gtest.h>

namespace contactscope {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const std::vector<Vec3> kCorners = {{1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, {-1, 0, 1}};

Manifold patch() {
  Manifold manifold{{0, 1, 0}};
  for (const Vec3& corner : kCorners) manifold.points.push_back({corner, -0.01});
  manifold.points[2].separation = -0.02;
  return manifold;
}

std::string said_of(const Manifold& manifold, double tolerance = 1e-3) {
  return compare_manifold(manifold, {0, 1, 0}, 0.02, kCorners, tolerance).message;
}

TEST(ManifoldMatcher, TakesPointsInAnyOrder) {
  Manifold turned = patch();
  std::swap(turned.points[0], turned.points[3]);
  EXPECT_THAT(turned, IsManifold({0, 1, 0}, 0.02, kCorners, 1e-9));
  EXPECT_THAT(said_of(turned), IsEmpty());
}

TEST(ManifoldMatcher, NamesThePointThatMoved) {
  Manifold moved = patch();
  moved.points[1].position.x += 0.0013;
  EXPECT_THAT(moved, Not(IsManifold({0, 1, 0}, 0.02, kCorners, 1e-3)));
  EXPECT_EQ(said_of(moved), "point (1, 0, -1) moved 1.3 mm along x");
  EXPECT_THAT(said_of(moved, 0.002), IsEmpty());
}

TEST(ManifoldMatcher, NamesMissingAndExtraPoints) {
  Manifold fewer = patch();
  fewer.points.pop_back();
  EXPECT_EQ(said_of(fewer), "3 points instead of 4; no point at (-1, 0, 1)");
  Manifold more = patch();
  more.points.push_back({{0, 0, 0}, -0.01});
  EXPECT_EQ(said_of(more), "5 points instead of 4; an extra point at (0, 0, 0)");
}

TEST(ManifoldMatcher, ReportsTheNormalAndDepth) {
  Manifold other = patch();
  other.normal = {0, -1, 0};
  other.points[2].separation = -0.05;
  EXPECT_THAT(said_of(other), HasSubstr("normal flipped"));
  EXPECT_THAT(said_of(other), HasSubstr("depth 50 mm instead of 20 mm"));
}

TEST(ManifoldMatcher, NanIsNotEqual) {
  Manifold broken = patch();
  broken.points[0].position.y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(said_of(broken, 1), Not(IsEmpty()));
}

TEST(ManifoldMatcher, ReportsExpectedAndFound) {
  testing::StringMatchResultListener listener;
  const testing::Matcher<Manifold> matcher = IsManifold({0, 1, 0}, 0.02, {{0, 0, 0}}, 1e-3);
  EXPECT_FALSE(matcher.MatchAndExplain(patch(), &listener));
  EXPECT_THAT(listener.str(), HasSubstr("4 points instead of 1"));
  std::ostringstream words;
  matcher.DescribeTo(&words);
  EXPECT_THAT(words.str(), HasSubstr("normal (0, 1, 0), 1 point"));
  EXPECT_THAT(testing::PrintToString(patch()), HasSubstr("4 points: (1, 0, 1) -0.01"));
}

}  // namespace
}  // namespace contactscope
