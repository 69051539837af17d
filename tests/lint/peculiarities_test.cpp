#include "lint/recorded.h"

/// Peculiarities of engines are hints, not faults. Each is next to a fault of the same size.
namespace contactscope::lint {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::Not;

trace::Shape ball(const std::string& name, double radius) {
  trace::Shape shape;
  shape.name = name, shape.type = "sphere", shape.radius = radius;
  shape.vertices = {Vec3d::Zero()};
  return shape;
}

trace::Shape cube(double half) {
  trace::Shape shape;
  shape.name = "a", shape.type = "box";
  for (int i = 0; i < 8; ++i)
    shape.vertices.push_back(half * Vec3d(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
  shape.faces = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                 {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  return shape;
}

/// Adds a frame with one point between a at the origin and b.
void add(Trace& trace, const Pose<double>& b, const Vec3d& normal, const Vec3d& on_a,
         const Vec3d& on_b) {
  trace::Frame& frame = trace.frames.emplace_back();
  frame.frame = int(trace.frames.size()) - 1;
  frame.time = frame.frame / 60.0, frame.line = frame.frame + 2;
  frame.poses = {{"a", {}}, {"b", b}};
  trace::Pair& pair = frame.pairs.emplace_back();
  pair.a = "a", pair.b = "b", pair.state = "touching";
  trace::Manifold& manifold = pair.manifolds.emplace_back();
  manifold.normal = normal;
  trace::Point& point = manifold.points.emplace_back();
  point.on_a = on_a, point.on_b = on_b;
  point.position = (on_a + on_b) / 2;
  point.separation = (on_b - on_a).dot(normal);
}

/// Causes of the findings, and of the hints with their counts.
std::string all_in(const Trace& trace) {
  Linter linter(trace.header);
  for (const trace::Frame& frame : trace.frames) linter.look_at(frame);
  std::string all;
  for (const Finding& one : linter.findings())
    if (one.is_hint)
      all += "hint " + one.cause + " " + std::to_string(one.count) + " ";
    else if (is_reported(one))
      all += one.cause + " ";
  return all;
}

/// A ball overlaps the edge of a cube by 5 mm, whose edge is an arc of radius `rounding`.
Trace at_an_edge(const std::string& engine, double rounding) {
  Trace trace;
  trace.header.up = "y", trace.header.engine = engine;
  trace.header.shapes = {cube(0.5), ball("b", 0.2)};
  const Vec3d out = Vec3d(1, 1, 0).normalized(), center(0.5 - rounding, 0.5 - rounding, 0);
  for (int f = 0; f < 10; ++f) {
    const Vec3d on_a = center + rounding * out, middle = on_a + 0.195 * out + Vec3d(0, 0, 1e-3 * f);
    Pose<double> pose;
    pose.position = middle;
    add(trace, pose, out, on_a + Vec3d(0, 0, 1e-3 * f), middle - 0.2 * out);
  }
  return trace;
}

TEST(LintPeculiarities, BulletRoundsTheEdgesOfABoxByATenthOfItsHalfExtentUpTo40mm) {
  EXPECT_EQ(all_in(at_an_edge("Bullet", 0)), "");
  EXPECT_EQ(all_in(at_an_edge("Bullet", 0.04)), "hint rounded_edges 10 ");
  EXPECT_EQ(all_in(at_an_edge("another", 0.04)), "margin_taken_off ");
  EXPECT_THAT(all_in(at_an_edge("Bullet", 0.08)), Not(IsEmpty()));
  Trace boxes = at_an_edge("Bullet", 0.04);
  boxes.header.shapes[1] = cube(0.2);
  boxes.header.shapes[1].name = "b";
  EXPECT_THAT(all_in(boxes), Not(testing::HasSubstr("hint"))) << "two boxes stay sharp";
}

/// A point on the top of a cube, kept while the other one slides to its edge: then the least overlap is
/// sideways. The point of the second frame is `shift` from that of the first, and its normal turned.
Trace of_kept_point(double shift, double turned, double slide = 0.015) {
  Trace trace;
  trace.header.up = "y", trace.header.engine = "Bullet";
  trace.header.shapes = {cube(0.5), cube(0.3)};
  trace.header.shapes[1].name = "b";
  for (const double s : {0.0, slide}) {
    Pose<double> pose;
    pose.position = Vec3d(0.78 + s, 0.79 - s, 0);
    const Vec3d normal = s == 0 ? Vec3d(0, 1, 0) : Vec3d(std::sin(turned), std::cos(turned), 0);
    const Vec3d moved(s == 0 ? 0 : shift, 0, 0);
    add(trace, pose, normal, Vec3d(0.49, 0.5, 0) + moved,
        pose.position + Vec3d(-0.29, -0.3, 0) + moved);
  }
  return trace;
}

TEST(LintPeculiarities, APointThatIsKeptHasTheNormalOfItsFirstFrame) {
  EXPECT_EQ(all_in(of_kept_point(0, 0)), "hint kept_points 1 ");
  EXPECT_EQ(all_in(of_kept_point(0.002, 0)), "normal ") << "a new point";
  EXPECT_EQ(all_in(of_kept_point(0, 0.01)), "normal ") << "a new normal";
  EXPECT_THAT(all_in(of_kept_point(0, 0, 0.025)), testing::HasSubstr("normal ")) << "too far";
}

/// Small cubes and balls on a large cube. For ten frames they overlap by 20 mm, and for forty by less
/// than any tolerance. Of `halved` cubes the large overlaps are reported as half.
Trace on_a_large_cube(int halved) {
  Trace trace;
  trace.header.shapes = {cube(2)};
  for (int i = 0; i < 8; ++i) {
    trace.header.shapes.push_back(i < 4 ? cube(0.2) : ball("", 0.2));
    trace.header.shapes.back().name = (i < 4 ? "cube_" : "ball_") + std::to_string(i);
  }
  for (int f = 0; f < 50; ++f) {
    trace::Frame& frame = trace.frames.emplace_back();
    frame.frame = f, frame.time = f / 60.0, frame.line = f + 2;
    frame.poses = {{"a", {}}};
    const double overlap = f < 10 ? 0.02 : 2e-4;
    for (int i = 0; i < 8; ++i) {
      const std::string name = trace.header.shapes[static_cast<std::size_t>(i) + 1].name;
      const Vec3d place(i % 4 - 1.5, 2 - overlap / 2, i < 4 ? 1 : -1);
      frame.poses.emplace_back(name, Pose<double>{});
      frame.poses.back().second.position = place + Vec3d(0, 0.2 - overlap / 2, 0);
      trace::Pair& pair = frame.pairs.emplace_back();
      pair.a = "a", pair.b = name, pair.state = "touching";
      trace::Manifold& manifold = pair.manifolds.emplace_back();
      manifold.normal = Vec3d::UnitY();
      manifold.points.push_back({place, i < halved && f < 10 ? -overlap / 2 : -overlap, ""});
    }
  }
  return trace;
}

TEST(LintPeculiarities, HalfDepthsOfOneKindOfPairsAreNamedWithIt) {
  EXPECT_EQ(all_in(on_a_large_cube(0)), "");
  const std::vector<Finding> findings = lint(on_a_large_cube(4));
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].what, "separations are half of the overlap, in pairs of kind box-box");
  EXPECT_EQ(findings[0].count, 40);
  EXPECT_EQ(findings[0].b, "cube_0");
  EXPECT_THAT(all_in(on_a_large_cube(1)), Not(testing::HasSubstr("half_depths")))
      << "one pair is no convention";
}

/// Only a sample of many occurrences is marked, and each mark has its shapes.
TEST(LintPeculiarities, EachMarkOfManyHasItsShapes) {
  Trace trace;
  trace.header.shapes = {cube(0.5), ball("b", 0.2)};
  for (int f = 0; f < 1200; ++f) {
    Pose<double> pose;
    pose.position = Vec3d(0, 0.69, 1e-4 * (f % 100));
    add(trace, pose, Vec3d(0, -1, 0), pose.position * (0.5 / 0.69),
        pose.position - Vec3d(0, 0.2, 0));
  }
  const std::vector<Finding> findings = lint(trace);
  ASSERT_FALSE(findings.empty());
  EXPECT_GT(findings[0].marks.size(), 400u);
  for (const Mark& mark : findings[0].marks)
    ASSERT_TRUE(mark.a == "a" && mark.b == "b") << mark.frame;
}

}  // namespace
}  // namespace contactscope::lint
