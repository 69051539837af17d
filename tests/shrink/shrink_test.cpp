#include "shrink/shrink.h"

#include <gmock/gmock.h>

#include <cmath>

#include "lint/linter.h"
#include "scenario/run.h"
#include "scenario/scenario.h"
#include "support/random_geometry.h"

namespace contactscope::shrink {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// Points on a ball; all of them are corners of their hull.
std::vector<Vec3d> on_a_ball(int count, double radius, std::uint64_t seed) {
  test::Random random(seed);
  std::vector<Vec3d> points;
  for (int i = 0; i < count; ++i) points.push_back(radius * random.unit_vector());
  return points;
}

/// Two rocks of many corners, at random poses.
PairOfTwo two_rocks(double distance) {
  PairOfTwo pair;
  pair.a.name = "rock";
  pair.a.vertices = on_a_ball(30, 1, 1);
  pair.a.position = {12.345678, -3.14159, 0.271828};
  pair.a.turn = {Turn::Form::Quaternion, {0.5, 0.5, -0.5, 0.5}};
  pair.b.name = "stone";
  pair.b.vertices = on_a_ball(24, 0.7, 2);
  pair.b.position = pair.a.position + Vec3d(0.1, distance, 0.05);
  pair.b.turn = {Turn::Form::Quaternion, {std::sqrt(0.5), 0, std::sqrt(0.5), 0}};
  pair.settings = {{"reducer", "\"area\""}, {"max_points", "3"}};
  return pair;
}

Shrunk shrunk(const PairOfTwo& pair, const std::string& text,
              std::map<std::string, Engine> engines = {}) {
  const find::Expression expression(text, vocabulary());
  Judge judge(expression, std::move(engines));
  if (!pair.expectation.empty()) judge.remember_unmet(pair);
  EXPECT_TRUE(judge.holds(pair)) << text;
  Shrunk result = shrink(pair, judge);
  EXPECT_TRUE(judge.holds(result.pair)) << text;
  return result;
}

TEST(Shrink, TwoRocksThatTouchBecomeTwoTetrahedraWithRoundNumbers) {
  const Shrunk result = shrunk(two_rocks(1.2), "touching and separation < -0.05");
  EXPECT_EQ(result.pair.vertex_count(), 8);
  EXPECT_THAT(result.pair.settings, IsEmpty());
  EXPECT_TRUE(result.pair.a.position.isZero(0));
  EXPECT_LE(digits_of(result.pair), 40);
}

TEST(Shrink, TheSamePairGivesTheSameResult) {
  const std::string text = "touching and points > 1";
  const PairOfTwo pair = two_rocks(1.2);
  const std::string once = to_scenario(shrunk(pair, text).pair, "a", "b");
  EXPECT_EQ(to_scenario(shrunk(pair, text).pair, "a", "b"), once);
}

TEST(Shrink, ADisagreementOfFloatAndDoubleStays) {
  // Far from the origin, float loses a separation of a tenth of a millimetre.
  PairOfTwo pair = two_rocks(1.2);
  pair.a.kind = pair.b.kind = SmallShape::Kind::Box;
  pair.a.vertices.clear();
  pair.b.vertices.clear();
  pair.a.half_extents = pair.b.half_extents = {0.5, 0.5, 0.5};
  pair.a.turn = pair.b.turn = {};
  pair.a.position = {123456.789, 0, 0};
  pair.b.position = {123457.7891, 0.1, 0.2};
  const Shrunk result = shrunk(pair, "float.touching != double.touching");
  EXPECT_LE(result.pair.vertex_count(), 12);
}

TEST(Shrink, AnUnmetExpectationStaysTheSameOne) {
  PairOfTwo pair = two_rocks(1.2);
  pair.a.kind = pair.b.kind = SmallShape::Kind::Box;
  pair.a.vertices.clear();
  pair.b.vertices.clear();
  pair.a.turn = pair.b.turn = {};
  pair.a.half_extents = {2.125, 0.5, 2.0625};
  pair.b.half_extents = {0.5, 0.53125, 0.4375};
  pair.b.position = pair.a.position + Vec3d(0.123, 1.02, 0.456);
  pair.settings = {{"max_points", "3"}};
  pair.expectation = {{"points", "4"}};  // but it has three
  const Shrunk result = shrunk(pair, "unmet");
  EXPECT_LE(result.pair.vertex_count(), 12);
  const Scenario scenario = parse_scenario(to_scenario(result.pair, "", ""), "shrink/pair.toml");
  Runner runner(scenario);
  const std::vector<std::string> unmet = unmet_expectations(scenario, {runner.frame(0)});
  ASSERT_EQ(unmet.size(), 1u);
  EXPECT_THAT(unmet.front(), HasSubstr("expected 4 points, got 3"));
}

/// The contacts of a pair as an engine with some mistake would record them.
PairOfTwo recorded(PairOfTwo pair, const std::function<void(trace::Manifold&)>& mistake) {
  const trace::Pair right = *Judge::in_double(pair);
  const Pose<double> pose = pair.a.pose();
  pair.claims = right.manifolds;
  for (trace::Manifold& manifold : *pair.claims) {
    mistake(manifold);
    manifold.normal = pose.inverse_rotate(manifold.normal);
    for (trace::Point& point : manifold.points)
      point.position = pose.inverse_transform(point.position);
  }
  return pair;
}

TEST(Shrink, ALintFindingStaysAndItsTraceIsWritten) {
  struct Case {
    const char* cause;
    std::function<void(trace::Manifold&)> mistake;
  };
  const Case cases[] = {
      {"flipped_normals", [](trace::Manifold& manifold) { manifold.normal *= -1; }},
      {"positive_depths",
       [](trace::Manifold& manifold) {
         for (trace::Point& point : manifold.points) point.separation *= -1;
       }},
      {"half_depths",
       [](trace::Manifold& manifold) {
         for (trace::Point& point : manifold.points) point.separation *= 0.5;
       }},
  };
  for (const Case& wrong : cases) {
    PairOfTwo pair = two_rocks(1.2);
    pair.a.kind = SmallShape::Kind::Box;
    pair.a.vertices.clear();
    pair.a.half_extents = {2, 1, 2};
    pair.a.turn = {};
    const std::string text = std::string("lint.") + wrong.cause;
    const Shrunk result = shrunk(recorded(pair, wrong.mistake), text);
    EXPECT_LE(result.pair.vertex_count(), 12) << wrong.cause;
    ASSERT_TRUE(result.pair.claims.has_value());
    std::vector<std::string> causes;
    for (const lint::Finding& finding : lint::lint(Judge::trace_of(result.pair)))
      causes.push_back(finding.cause);
    EXPECT_THAT(causes, testing::Contains(wrong.cause));
  }
}

TEST(Shrink, ADisagreeingEngineIsRunForEachPair) {
  int requested = 0;
  // It misses everything above two metres.
  const Engine blind = [&](const trace::Trace& request) {
    ++requested;
    trace::Trace answer = request;
    trace::Pair& pair = answer.frames.front().pairs.front();
    const double height = answer.frames.front().poses.back().second.position.y();
    if (height < 2)
      pair.manifolds = {{.normal = Vec3d::UnitY(), .axis = "", .triangle = {}, .points = {{}}}};
    return answer;
  };
  PairOfTwo pair = two_rocks(1.2);
  pair.a.position.y() = 3.14159;
  pair.b.position.y() = 3.14159 + 1.2;
  const Shrunk result = shrunk(pair, "double.touching and not blind.touching", {{"blind", blind}});
  EXPECT_LE(result.pair.vertex_count(), 12);
  EXPECT_GE(result.pair.b.position.y(), 2);
  EXPECT_GT(requested, 10);
}

TEST(Shrink, AMeshKeepsTheTrianglesThatMatter) {
  PairOfTwo pair;
  pair.a.name = "terrain";
  pair.a.kind = SmallShape::Kind::Mesh;
  for (int z = 0; z <= 4; ++z)
    for (int x = 0; x <= 4; ++x) pair.a.vertices.emplace_back(x - 2.03, 0.01 * x, z - 1.98);
  for (int z = 0; z < 4; ++z)
    for (int x = 0; x < 4; ++x) {
      const int corner = 5 * z + x;
      pair.a.triangles.push_back({corner, corner + 5, corner + 1});
      pair.a.triangles.push_back({corner + 1, corner + 5, corner + 6});
    }
  pair.b.name = "ball";
  pair.b.kind = SmallShape::Kind::Sphere;
  pair.b.radius = 0.4142;
  pair.b.position = {0.3, 0.42, 0.2};
  const Shrunk result = shrunk(pair, "touching");
  EXPECT_EQ(result.pair.a.triangles.size(), 1u);
  EXPECT_EQ(result.pair.vertex_count(), 4);
}

TEST(Shrink, APairOfAFrameKeepsShapesPlacesAndSettings) {
  const Scenario scenario = parse_scenario(R"(title = "A crate on a table"
[shapes.table]
type = "box"
half_extents = [1, 0.2, 1]
[shapes.crate]
type = "capsule"
half_height = 0.5
radius = 0.25
position = [0, 0.4, 0]
rotation = { axis = [0, 0, 1], degrees = 90 }
[pipeline]
scalar = "double"
reducer = "area"
margin = 0.01
[[expect]]
a = "table"
b = "crate"
points = 2
)",
                                           "mine/crate.toml");
  Runner runner(scenario, trace::Stages::none());
  const trace::Frame frame = runner.frame(0);
  const auto pair = pair_of_frame(runner.header(), frame, frame.pairs.front(), &scenario);
  ASSERT_TRUE(pair.has_value());
  const std::string text = to_scenario(*pair, "A {crate} | a table", "nowhere");
  EXPECT_THAT(text, HasSubstr("half_extents = [1, 0.2, 1]"));
  EXPECT_THAT(text, HasSubstr("reducer = \"area\""));
  EXPECT_THAT(text, HasSubstr("margin = 0.01"));
  EXPECT_THAT(text, HasSubstr("points = 2"));
  EXPECT_THAT(text, Not(HasSubstr("max_points")));
  const Scenario again = parse_scenario(text, "mine/again.toml");
  Runner rerun(again, trace::Stages::none());
  const trace::Pair& before = frame.pairs.front();
  const trace::Frame after = rerun.frame(0);
  EXPECT_EQ(after.pairs.front().separation, before.separation);
  EXPECT_EQ(after.pairs.front().manifolds.size(), before.manifolds.size());
}

}  // namespace
}  // namespace contactscope::shrink
