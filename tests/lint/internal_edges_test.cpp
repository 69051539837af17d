#include <gtest/gtest.h>

#include <cmath>

#include "lint/recorded.h"

/// Contacts with edges that a surface does not have. The pipeline makes them with
/// internal_edges = false, and makes none otherwise; on a ridge the same direction is right.
namespace contactscope::lint {
namespace {

/// A shape slides over 2 m of a mesh, as recorded by another engine.
Trace slide(const std::string& shape, double height, const std::string& mesh, double size,
            bool internal_edges) {
  const auto number = [&](double metres) { return std::to_string(metres * size * 1e4) + "e-4"; };
  const Scenario scenario = parse_scenario(
      "title = \"slide\"\nsource = \"test\"\ntags = []\n[time]\nframes = 41\ndt = 0.025\n"
      "[pipeline]\nscalar = \"double\"\ninternal_edges = " +
          std::string(internal_edges ? "true" : "false") + "\n[shapes.slider]\n" + shape +
          "\n[shapes.slider.motion]\nkeyframes = [\n" + "{ time = 0, position = [" + number(-1) +
          ", " + number(height) + ", " + number(0.1) + "] },\n{ time = 1, position = [" +
          number(1) + ", " + number(height) + ", " + number(0.3) +
          "] } ]\n[shapes.floor]\ntype = \"mesh\"\n" + mesh + "\n",
      "slide.toml");
  Runner runner(scenario, trace::Stages::none());
  Trace trace{runner.header(), {}};
  for (int f = 0; f < 41; ++f) {
    trace.frames.push_back(runner.frame(f));
    trace.frames.back().line = f + 2;
  }
  return trace;
}

std::string grid(double size) {
  return "grid = { size = [" + std::to_string(4 * size) + ", " + std::to_string(4 * size) +
         "], cells = [13, 11] }";
}

std::vector<std::pair<std::string, double>> sliders(double size) {
  const auto number = [&](double metres) { return std::to_string(metres * size); };
  return {{"type = \"sphere\"\nradius = " + number(0.4), 0.36},
          {"type = \"box\"\nhalf_extents = [" + number(0.4) + ", " + number(0.3) + ", " +
               number(0.4) + "]",
           0.29},
          {"type = \"capsule\"\nradius = " + number(0.2) + "\nhalf_height = " + number(0.3), 0.46}};
}

TEST(InternalEdges, AreNamedWhereAFlatFloorPushesSideways) {
  for (const double size : {0.1, 1.0, 100.0}) {
    for (const auto& [shape, height] : sliders(size)) {
      const Trace trace = slide(shape, height, grid(size), size, false);
      const std::vector<Finding> findings = lint(trace);
      ASSERT_FALSE(findings.empty()) << shape;
      EXPECT_EQ(findings.front().cause, "internal_edge") << shape;
      EXPECT_EQ(findings.front().a, "floor") << shape;
      // The face's normal, as the record has it: from the slider down, or from the floor up.
      for (const Mark& mark : findings.front().marks) {
        ASSERT_TRUE(mark.normal) << shape;
        EXPECT_LT((mark.normal->cwiseAbs() - Vec3d::UnitY()).norm(), 1e-6) << shape;
        const auto& manifolds = trace.frames[std::size_t(mark.frame)].pairs[0].manifolds;
        EXPECT_TRUE(std::ranges::any_of(manifolds, [&](const trace::Manifold& manifold) {
          return manifold.normal.dot(*mark.normal) > 0.1;
        })) << shape;
      }
      EXPECT_EQ(causes_of(lint(slide(shape, height, grid(size), size, true))),
                std::vector<std::string>{})
          << shape;
    }
  }
}

/// A body that an edge stops is still apart from it, but gets an impulse. The largest one along the
/// surface comes first.
TEST(InternalEdges, AreNamedBeforeTheyAreTouched) {
  Trace trace = slide(sliders(1)[1].first, 0.301, grid(1), 1, true);
  for (int f : {10, 20, 30}) {
    trace::Pair& pair = trace.frames[std::size_t(f)].pairs[0];
    trace::Manifold& manifold = pair.manifolds.emplace_back();
    const double down = pair.a == "floor" ? 1 : -1;
    const Vec3d lean = f == 30 ? Vec3d(1, 0.8, 0) : Vec3d(1, 0.1, 0);
    manifold.normal = down * lean.normalized();
    const Vec3d at = trace.frames[std::size_t(f)].poses[0].second.position;
    manifold.points.push_back({{at.x(), 0, at.z()}, 0.001, "a:v0 b:f0"});
    manifold.points[0].impulse = trace::Impulse{.normal = f == 20 ? 4.0 : f == 30 ? 90.0 : 0.1};
    pair.state = "touching";
  }
  const std::vector<Finding> findings = lint(trace);
  const auto edges = std::ranges::find(findings, "internal_edge", &Finding::cause);
  ASSERT_NE(edges, findings.end()) << testing::PrintToString(causes_of(findings));
  EXPECT_EQ(edges->count, 3);
  EXPECT_EQ(edges->frame, 30);
}

/// Once in hundreds of pairs engines are grossly wrong.
TEST(InternalEdges, AreNamedBeforeAPointThatIsOffOnce) {
  const auto [shape, height] = sliders(1).front();
  Trace trace = slide(shape, height, grid(1), 1, false);
  const std::vector<trace::Frame> frames = trace.frames;
  for (int n = 1; n < 16; ++n)
    for (trace::Frame frame : frames) {
      frame.frame += 41 * n, frame.line += 41 * n, frame.time += 1.025 * n;
      trace.frames.push_back(frame);
    }
  for (trace::Manifold& manifold : trace.frames[20].pairs[0].manifolds)
    for (trace::Point& point : manifold.points) point.position.y() += 2;
  const std::vector<std::string> causes = causes_of(lint(trace));
  const auto edges = std::ranges::find(causes, "internal_edge");
  const auto off = std::ranges::find(causes, "surface");
  ASSERT_NE(off, causes.end()) << testing::PrintToString(causes);
  EXPECT_LT(edges, off) << testing::PrintToString(causes);
}

// The ridge is real: while the sphere passes, its normal turns from one slope to the other.
TEST(InternalEdges, AreNotTheEdgesThatASurfaceHas) {
  const std::string ridge =
      "vertices = [[0, 0, -2], [0, 0, 2], [2, -1, 2], [2, -1, -2], [-2, -1, -2], [-2, -1, 2]]\n"
      "triangles = [[0, 1, 2], [0, 2, 3], [0, 4, 5], [0, 5, 1]]";
  const Trace trace = slide("type = \"sphere\"\nradius = 0.4", 0.39, ridge, 1, true);
  int upright = 0;  // between the normals of the slopes
  for (const trace::Frame& frame : trace.frames)
    for (const trace::Pair& pair : frame.pairs)
      for (const trace::Manifold& manifold : pair.manifolds)
        upright += std::abs(manifold.normal.y()) > std::cos(0.2);
  EXPECT_GT(upright, 1);
  EXPECT_EQ(causes_of(lint(trace)), std::vector<std::string>{});
}

// A valley has the directions of its two faces, and none between.
TEST(InternalEdges, OfAValleyAreNotTouched) {
  const std::string valley =
      "vertices = [[0, 0, -2], [0, 0, 2], [2, 2, 2], [2, 2, -2], [-2, 2, -2], [-2, 2, 2]]\n"
      "triangles = [[0, 1, 2], [0, 2, 3], [0, 4, 5], [0, 5, 1]]";
  Trace trace = slide("type = \"sphere\"\nradius = 0.4", 0.6, valley, 1, true);
  EXPECT_EQ(causes_of(lint(trace)), std::vector<std::string>{});
  // The engine takes the edge itself, straight up, as deep as it is along that direction.
  int changed = 0;
  for (trace::Frame& frame : trace.frames) {
    const Vec3d center = pose_of(frame, "slider").position;
    if (std::abs(center.x()) > 0.05) continue;
    for (trace::Pair& pair : frame.pairs) {
      trace::Manifold edge;
      edge.normal = Vec3d(-center.x(), -center.y(), 0).normalized();
      if (pair.a == "floor") edge.normal = -edge.normal;
      edge.points.push_back({Vec3d(0, 0, center.z()), -0.001, ""});
      pair.manifolds = {edge};
      ++changed;
    }
  }
  ASSERT_GT(changed, 0);
  const std::vector<Finding> findings = lint(trace);
  ASSERT_FALSE(findings.empty());
  EXPECT_EQ(findings.front().cause, "internal_edge");
}

}  // namespace
}  // namespace contactscope::lint
