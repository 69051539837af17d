#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "draw/scene/palette.h"
#include "draw/scene/solid.h"
#include "draw/staging.h"

namespace contactscope::draw {
namespace {

trace::Shape ball(const std::string& name, double radius) {
  trace::Shape shape;
  shape.name = name;
  shape.type = "sphere";
  shape.vertices = {Vec3d::Zero()};
  shape.radius = radius;
  return shape;
}

trace::Shape ground(const Vec3d& normal, double offset) {
  trace::Shape shape;
  shape.name = "ground";
  shape.type = "plane";
  shape.half_space = trace::HalfSpace{normal, offset};
  return shape;
}

// A wavy square of 2 n^2 triangles.
trace::Shape terrain(int n, double size) {
  trace::Shape shape;
  shape.name = "ground";
  shape.type = "mesh";
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      const double x = size * (double(i) / n - 0.5), z = size * (double(j) / n - 0.5);
      shape.vertices.emplace_back(x, 0.02 * size * std::sin(9 * x / size) * std::cos(7 * z / size),
                                  z);
    }
  }
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const int a = i * (n + 1) + j, b = a + 1, c = a + n + 1, d = c + 1;
      shape.faces.push_back({a, b, d});
      shape.faces.push_back({a, d, c});
    }
  }
  return shape;
}

struct BallOn {
  trace::Header header;
  std::vector<trace::Frame> frames;
  View view;

  BallOn(const trace::Shape& below, const std::vector<Vec3d>& centers, const Vec3d& normal) {
    header.scenario = "test/ball";
    header.title = "A ball";
    header.source = "none";
    header.up = "y";
    header.frames = static_cast<int>(centers.size());
    header.shapes = {below, ball("ball", 0.5)};
    for (const Vec3d& center : centers) {
      trace::Frame& frame = frames.emplace_back();
      frame.frame = static_cast<int>(frames.size()) - 1;
      Pose<double> pose;
      pose.position = center;
      frame.poses = {{"ground", {}}, {"ball", pose}};
      trace::Pair& pair = frame.pairs.emplace_back();
      pair.a = "ground";
      pair.b = "ball";
      pair.kind = below.type + "-sphere";
      pair.state = "touching";
      pair.separation = -0.01;
      trace::Manifold& manifold = pair.manifolds.emplace_back();
      manifold.normal = normal;
      manifold.axis = "closest_points";
      manifold.type = "point-face";
      manifold.points = {{center - 0.495 * normal, -0.01, "a:f0 b:v0"}};
      if (below.type == "mesh") manifold.triangle = 0;
    }
    view.layers = {Layer::Shapes, Layer::Contacts, Layer::Normals};
  }
  Staging staged() const { return stage(header, frames, view, 1280, 720); }
};

double share_of_view(const Staging& staging, const Vec3d& center, double radius) {
  return 2 * radius * staging.camera.pixels_per_metre(center) / staging.layout.view.height;
}

TEST(PlanePatch, HoldsTheShapesOfAllFramesAndKeepsItsSize) {
  const BallOn scene(ground(Vec3d::UnitY(), 0), {{0, 0.49, 0}, {1, 0.49, 0}, {3, 0.49, 0.5}},
                     Vec3d::UnitY());
  const Staging staging = scene.staged();
  ASSERT_TRUE(staging.meshes[0].patch);
  const PlanePatch& patch = *staging.meshes[0].patch;
  EXPECT_NEAR(patch.u.cross(patch.v).norm(), 1, 1e-12);
  EXPECT_NEAR(patch.center.y(), 0, 1e-12);
  const Sketch first = sketch_frame(staging, scene.frames[0]);
  const Sketch last = sketch_frame(staging, scene.frames[2]);
  ASSERT_FALSE(first.occluders.empty());
  EXPECT_EQ(first.occluders[0], last.occluders[0]);
  for (const trace::Frame& frame : scene.frames) {
    const Vec3d from = frame.poses[1].second.position - patch.center;
    EXPECT_LT(std::abs(from.dot(patch.u)) + 0.5, patch.half_u);
    EXPECT_LT(std::abs(from.dot(patch.v)) + 0.5, patch.half_v);
  }
}

TEST(PlanePatch, LiesInThePlaneOnASlope) {
  const Vec3d normal = Vec3d(1, 2, 0.5).normalized();
  const BallOn scene(ground(normal, 0.7), {1.19 * normal}, normal);
  const Staging staging = scene.staged();
  const std::vector<PlacedShape> placed = place_shapes(staging.meshes, scene.frames[0]);
  for (const Vec3d& corner : patch_corners(*placed[0].mesh->patch, placed[0].pose)) {
    EXPECT_NEAR(normal.dot(corner), 0.7, 1e-12);
  }
  EXPECT_NEAR(staging.meshes[0].patch->u.y(), 0, 1e-12);  // its edges are level
}

TEST(PlanePatch, IsLookedAtFromOutside) {
  for (const Vec3d& axis : {Vec3d(0, 1, 0), Vec3d(0, -1, 0), Vec3d(-1, 0, 0), Vec3d(0, 0, -1)}) {
    const BallOn scene(ground(axis, 0.2), {0.69 * axis}, axis);
    const Staging staging = scene.staged();
    EXPECT_GT(staging.camera.eye().dot(axis), 0.2) << axis.transpose();
  }
}

TEST(PlanePatch, HidesWhatIsBelowIt) {
  const BallOn scene(ground(Vec3d::UnitY(), 0), {{0, 0.2, 0}}, Vec3d::UnitY());
  const Staging staging = scene.staged();
  const Sketch sketch = sketch_frame(staging, scene.frames[0]);
  const HiddenLines hidden(staging.camera, sketch.occluders, {});
  EXPECT_TRUE(hidden.split({0, -0.1, 0}, {0.01, -0.1, 0}).front().hidden);
  EXPECT_FALSE(hidden.split({0, 0.1, 0}, {0.01, 0.1, 0}).front().hidden);
}

TEST(CameraFit, ALargeMeshDoesNotTakeOver) {
  const BallOn on_plane(ground(Vec3d::UnitY(), 0), {{0, 0.49, 0}}, Vec3d::UnitY());
  const BallOn on_hills(terrain(20, 200), {{0, 0.49, 0}}, Vec3d::UnitY());
  for (const BallOn* scene : {&on_plane, &on_hills}) {
    EXPECT_GT(share_of_view(scene->staged(), {0, 0.49, 0}, 0.5), 0.3);
  }
}

TEST(CameraFit, ASphereIsSeenWhole) {
  const BallOn scene(ground(Vec3d::UnitY(), 0), {{0, 0.49, 0}}, Vec3d::UnitY());
  const Staging staging = scene.staged();
  const RoundBody body{{{0, 0.49, 0}}, 0.5};
  for (const Vec3d& p : body.outline(staging.camera)) {
    const std::optional<Point2> at = staging.camera.project(p);
    ASSERT_TRUE(at);
    EXPECT_TRUE(staging.layout.view.contains(*at));
  }
}

// tests/bench/render_bench measures the time.
TEST(LargeMesh, TenThousandTrianglesAreDrawn) {
  const BallOn scene(terrain(71, 20), {{0, 0.6, 0}}, Vec3d::UnitY());
  EXPECT_GT(illustrate(scene.staged(), scene.frames[0]).primitives.size(), 500u);
}

TEST(LargeMesh, SlowLinesFadeAsTrianglesBecomeSmall) {
  const auto darkest = [](int n) {
    const BallOn scene(terrain(n, 1.5), {{0, 0.6, 0}}, Vec3d::UnitY());
    const Staging staging = scene.staged();
    float alpha = 0;
    for (const Line& line : sketch_frame(staging, scene.frames[0]).lines) {
      if (line.style.hidden == LineStyle::Hidden::Gone && line.style.width == 1.0f) {
        alpha = std::max(alpha, line.style.color.a);
      }
    }
    return alpha;
  };
  const float coarse = darkest(8), middle = darkest(30), fine = darkest(300);
  EXPECT_GT(coarse, middle);
  EXPECT_GT(middle, fine);
  EXPECT_EQ(fine, 0);
}

TEST(LargeMesh, ATouchedTriangleIsHighlightedOnce) {
  BallOn scene(terrain(8, 4), {{0, 0.6, 0}}, Vec3d::UnitY());
  scene.frames[0].pairs.push_back(scene.frames[0].pairs[0]);  // two shapes on one triangle
  const Staging staging = scene.staged();
  const Sketch sketch = sketch_frame(staging, scene.frames[0]);
  const auto is_blue = [](const Surface& surface) {
    return surface.color.b == kReferenceFace.b && surface.color.r == kReferenceFace.r;
  };
  EXPECT_EQ(std::ranges::count_if(sketch.surfaces, is_blue), 1);
}

TEST(ManyOccluders, HideTheSameAsFew) {
  // The first alone, and again with hundreds of others behind it.
  const Camera camera =
      Camera::perspective({1, 2, 6}, Vec3d::Zero(), Vec3d::UnitY(), 0.6, {0, 0, 800, 600});
  std::mt19937 random(3);
  std::uniform_real_distribution<double> coordinate(-1.5, 1.5);
  const auto point = [&](double z) { return Vec3d(coordinate(random), coordinate(random), z); };
  Occluders few;
  for (int i = 0; i < 40; ++i) {
    const Vec3d corner = point(1);
    few.push_back({corner, corner + Vec3d(0.4, 0, 0), corner + Vec3d(0.1, 0.3, 0.2)});
  }
  Occluders many = few;
  for (int i = 0; i < 300; ++i) {
    const Vec3d corner = point(-20);
    many.push_back({corner, corner + Vec3d(0.2, 0, 0), corner + Vec3d(0, 0.2, 0)});
  }
  const HiddenLines one(camera, few), other(camera, many);
  int compared = 0;
  for (int i = 0; i < 500; ++i) {
    const Vec3d from = 0.5 * point(0), to = 0.5 * point(0.5);
    const std::vector<Span> expected = one.split(from, to), found = other.split(from, to);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t k = 0; k < found.size(); ++k) {
      EXPECT_EQ(found[k].hidden, expected[k].hidden);
      EXPECT_DOUBLE_EQ(found[k].from, expected[k].from);
      ++compared;
    }
  }
  EXPECT_GT(compared, 700);
}

}  // namespace
}  // namespace contactscope::draw
