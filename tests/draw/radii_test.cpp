#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "crate_on_slab.h"
#include "draw/scene/clip_story.h"

namespace contactscope::draw {
namespace {

using crate_sample::cuboid;
using testing::Contains;
using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::Not;

trace::Shape round_shape(const std::string& name, std::vector<Vec3d> core, double radius) {
  trace::Shape shape;
  shape.name = name;
  shape.type = core.size() == 1 ? "sphere" : "capsule";
  shape.vertices = std::move(core);
  if (shape.vertices.size() == 2) shape.edges = {{0, 1}};
  for (const Vec3d& v : shape.vertices)
    shape.center_of_mass += v / static_cast<double>(shape.vertices.size());
  shape.radius = radius;
  return shape;
}

/// Two shapes with one manifold, or none.
struct RoundScene {
  trace::Header header;
  std::vector<trace::Frame> frames{1};
  View view;

  RoundScene(const trace::Shape& a, const Vec3d& at_a, const trace::Shape& b, const Vec3d& at_b) {
    header.title = "Round";
    header.source = "none";
    header.up = "y";
    header.frames = 1;
    header.shapes = {a, b};
    Pose<double> pose_a, pose_b;
    pose_a.position = at_a;
    pose_b.position = at_b;
    frames[0].poses = {{a.name, pose_a}, {b.name, pose_b}};
    trace::Pair pair;
    pair.a = a.name;
    pair.b = b.name;
    pair.state = "separated";
    frames[0].pairs = {pair};
    view.layers = {Layer::Core};
    view.eye = Vec3d(0, 0.2, 4);
    view.target = Vec3d(0, 0.2, 0);
  }

  trace::Pair& pair() { return frames[0].pairs[0]; }
  void touch(const Vec3d& normal, const std::string& axis,
             const std::vector<trace::Point>& points) {
    trace::Manifold manifold;
    manifold.normal = normal;
    manifold.axis = axis;
    manifold.points = points;
    pair().manifolds = {manifold};
    pair().state = "touching";
    pair().separation = points.front().separation;
  }
  Staging staged() const { return stage(header, frames, view, 1280, 720); }
  Sketch sketch() const { return sketch_frame(staged(), frames[0]); }
};

std::vector<std::string> said(const Sketch& sketch) {
  return mapped(sketch.labels, [](const Label& label) { return label.text; });
}

int virtual_spheres(const Sketch& sketch, const Vec3d& center, double radius) {
  int count = 0;
  for (const Curve& curve : sketch.curves) {
    if (!curve.style.dashed || !curve.closed || curve.points.empty()) continue;
    count += std::ranges::all_of(curve.points, [&](const Vec3d& p) {
      return std::abs((p - center).norm() - radius) < 1e-9;
    });
  }
  return count;
}

TEST(Radii, OverlapOfTwoSpheresIsTheSumOfTheRadiiLessTheDistanceOfTheCentres) {
  RoundScene scene(round_shape("large", {Vec3d::Zero()}, 0.5), Vec3d::Zero(),
                   round_shape("small", {Vec3d::Zero()}, 0.3), Vec3d(0, 0.62, 0));
  scene.touch(Vec3d::UnitY(), "closest_points", {{{0, 0.41, 0}, -0.18, "a:v0 b:v0"}});
  const Sketch sketch = scene.sketch();
  EXPECT_THAT(said(sketch), Contains("overlap 500 + 300 − 620 = 180 mm"));
  EXPECT_THAT(said(sketch), Contains("A's centre"));
  // Both radii and the distance next to the line between the centres, to scale, in own columns.
  std::vector<double> lengths, columns;
  for (const Arrow& arrow : sketch.arrows) {
    if (!arrow.double_headed) continue;
    lengths.push_back((*arrow.to - arrow.from).norm());
    columns.push_back(arrow.from.x());
  }
  EXPECT_THAT(lengths, testing::UnorderedElementsAre(testing::DoubleNear(0.5, 1e-9),
                                                     testing::DoubleNear(0.3, 1e-9),
                                                     testing::DoubleNear(0.62, 1e-9)));
  std::ranges::sort(columns);
  EXPECT_GT(std::ranges::adjacent_find(columns, [](double x, double y) { return y - x < 0.01; }) -
                columns.begin(),
            2);
}

TEST(Radii, AGapIsTheDistanceLessBothRadii) {
  RoundScene scene(round_shape("large", {Vec3d::Zero()}, 0.5), Vec3d::Zero(),
                   round_shape("small", {Vec3d::Zero()}, 0.3), Vec3d(0, 0.84, 0));
  scene.pair().separation = 0.04;
  EXPECT_THAT(said(scene.sketch()), Contains("gap 840 − 500 − 300 = 40 mm"));
}

TEST(Radii, ACapsuleHasAVirtualSphereAboutTheNearestPointOfItsAxis) {
  RoundScene scene(round_shape("pill", {{-0.6, 0, 0}, {0.5, 0, 0}}, 0.3), Vec3d::Zero(),
                   round_shape("ball", {Vec3d::Zero()}, 0.25), Vec3d(0.8, 0.4, 0));
  scene.touch({0.6, 0.8, 0}, "closest_points", {{{0.665, 0.22, 0}, -0.05, "a:v1 b:v0"}});
  const Sketch sketch = scene.sketch();
  EXPECT_EQ(virtual_spheres(sketch, {0.5, 0, 0}, 0.3), 1);
  EXPECT_EQ(virtual_spheres(sketch, {0.8, 0.4, 0}, 0.25), 0) << "a ball is one";
  EXPECT_THAT(said(sketch), Contains("end of A's axis"));
  EXPECT_THAT(said(sketch), Contains("B's centre"));
  EXPECT_THAT(said(sketch), Contains("overlap 300 + 250 − 500 = 50 mm"));
}

TEST(Radii, ParallelAxesMarkTheSegmentBetweenTheTwoPoints) {
  RoundScene scene(round_shape("lower", {{-0.8, 0, 0}, {0.8, 0, 0}}, 0.25), Vec3d::Zero(),
                   round_shape("upper", {{-0.6, 0, 0}, {0.6, 0, 0}}, 0.25), Vec3d(0.7, 0.42, 0));
  scene.touch(Vec3d::UnitY(), "closest_points",
              {{{0.1, 0.21, 0}, -0.08, "a:e0 b:v0"}, {{0.8, 0.21, 0}, -0.08, "a:v1 b:e0"}});
  const Sketch sketch = scene.sketch();
  EXPECT_THAT(said(sketch), Contains("shared stretch"));
  for (const double height : {0.0, 0.42}) {
    EXPECT_TRUE(std::ranges::any_of(sketch.lines, [&](const Line& line) {
      return (line.from - Vec3d(0.1, height, 0)).norm() < 1e-9 &&
             (line.to - Vec3d(0.8, height, 0)).norm() < 1e-9;
    })) << height;
  }
}

TEST(Radii, CrossingAxesHaveANormalPerpendicularToBoth) {
  RoundScene scene(round_shape("lower", {{-0.8, 0, 0}, {0.8, 0, 0}}, 0.25), Vec3d::Zero(),
                   round_shape("upper", {{0, 0, -0.7}, {0, 0, 0.7}}, 0.2), Vec3d::Zero());
  scene.view.eye = Vec3d(3, 1, 3);
  scene.touch(Vec3d::UnitY(), "closest_points", {{{0, 0.025, 0}, -0.45, "a:e0 b:e0"}});
  scene.pair().degenerate = trace::Degenerate{"crossing axes", "fallback"};
  // The side of each mark that ends on the normal.
  const auto marks = [&] {
    std::vector<Vec3d> along;
    for (const Line& line : scene.sketch().lines) {
      const bool is_level = std::abs(line.to.y() - line.from.y()) < 1e-9 && line.to.y() > 1e-3;
      if (is_level && std::hypot(line.to.x(), line.to.z()) < 1e-9)
        along.push_back((line.from - line.to).normalized());
    }
    return along;
  };
  const std::vector<Vec3d> along = marks();
  ASSERT_EQ(along.size(), 2u);
  EXPECT_NEAR(std::abs(along[0].x()), 1, 1e-9);
  EXPECT_NEAR(std::abs(along[1].z()), 1, 1e-9);
  EXPECT_THAT(said(scene.sketch()), Not(Contains("r 250 mm")));
  EXPECT_THAT(said(scene.sketch()), Not(Contains("cross product of both axes")))
      << "there is no arrow";
  scene.view.layers = {Layer::Core, Layer::Normals};
  EXPECT_THAT(said(scene.sketch()), Contains("cross product of both axes"));
  scene.pair().degenerate.reset();
  EXPECT_TRUE(marks().empty());
}

TEST(Radii, BeyondTheSurfaceOfAHullTheDistanceIsAdded) {
  RoundScene scene(cuboid("block", {0.8, 0.35, 0.5}), Vec3d(0, -0.35, 0),
                   round_shape("ball", {Vec3d::Zero()}, 0.3), Vec3d(0, -0.03, 0));
  scene.touch(Vec3d::UnitY(), "face_a", {{{0, 0, 0}, -0.33, "a:f2 b:v0"}});
  EXPECT_THAT(said(scene.sketch()), Contains("overlap 300 + 30 = 330 mm"));
}

// If the centre is on the surface of a hull, there is nothing to add.
TEST(Radii, OnTheSurfaceOfAHullTheOverlapIsTheRadius) {
  RoundScene scene(cuboid("block", {0.8, 0.35, 0.5}), Vec3d(0, -0.35, 0),
                   round_shape("ball", {Vec3d::Zero()}, 0.3), Vec3d::Zero());
  scene.touch(Vec3d::UnitY(), "face_a", {{{0, 0, 0}, -0.3, "a:f2 b:v0"}});
  EXPECT_THAT(said(scene.sketch()), Contains("overlap 300 mm"));
}

TEST(Contacts, ASkippedPairHasANote) {
  RoundScene scene(round_shape("outer", {Vec3d::Zero()}, 0.5), Vec3d::Zero(),
                   round_shape("inner", {Vec3d::Zero()}, 0.3), Vec3d::Zero());
  scene.pair().separation = -0.8;
  scene.view.layers = {Layer::Contacts};
  EXPECT_THAT(said(scene.sketch()), Not(Contains("no normal: contact skipped")));
  scene.pair().degenerate = trace::Degenerate{"coincident centres", "skip"};
  EXPECT_THAT(said(scene.sketch()), Contains("no normal: contact skipped"));
}

TEST(Normals, ACentreOnAnEdgeHasAnArrowForTheOtherFaceToo) {
  RoundScene scene(cuboid("block", {0.8, 0.35, 0.5}), Vec3d(0, -0.35, 0),
                   round_shape("ball", {Vec3d::Zero()}, 0.3), Vec3d(0.8, 0, 0));
  scene.touch(Vec3d::UnitY(), "face_a", {{{0.8, 0, 0}, -0.3, "a:f2 b:v0"}});
  scene.view.layers = {Layer::Normals};
  const auto others = [&] {
    std::vector<Vec3d> directions;
    for (const Arrow& arrow : scene.sketch().arrows)
      if (arrow.open) directions.push_back(arrow.direction);
    return directions;
  };
  EXPECT_TRUE(others().empty());
  scene.pair().degenerate = trace::Degenerate{"centre on the surface", "fallback"};
  ASSERT_EQ(others().size(), 1u);
  EXPECT_NEAR((others()[0] - Vec3d::UnitX()).norm(), 0, 1e-9);
  EXPECT_THAT(said(scene.sketch()), IsSupersetOf({"face 0", "face 2"}));
  scene.pair().manifolds.clear();
  scene.pair().degenerate->answer = "skip";
  EXPECT_EQ(others().size(), 2u);
}

TEST(ClippedSegment, TheAxisOfACapsuleIsCutAtTheSideThatItCrosses) {
  RoundScene scene(cuboid("block", {0.8, 0.3, 0.5}), Vec3d(0, -0.3, 0),
                   round_shape("pill", {{-0.5, 0, 0}, {0.5, 0, 0}}, 0.2), Vec3d(0.6, 0.18, 0.1));
  scene.touch(Vec3d::UnitY(), "face_a",
              {{{0.1, 0, 0.1}, -0.02, "a:f2 b:v0"}, {{0.8, 0, 0.1}, -0.02, "a:e1 b:e0"}});
  scene.view.layers = {Layer::ReferenceFace, Layer::SidePlanes, Layer::ClipPolygons};
  const Staging staging = scene.staged();
  const Scene shown = scene_of(staging, scene.frames[0]);
  const auto segment = clipped_segment(shown, scene.pair());
  ASSERT_TRUE(segment);
  EXPECT_NEAR((segment->from - Vec3d(0.1, 0.18, 0.1)).norm(), 0, 1e-9);
  EXPECT_NEAR((segment->to - Vec3d(0.8, 0.18, 0.1)).norm(), 0, 1e-9);
  ASSERT_EQ(segment->sides.size(), 4u);
  int cuts = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    if (!segment->cuts(i)) continue;
    ++cuts;
    EXPECT_NEAR(segment->sides[i].x(), 1, 1e-12);
  }
  EXPECT_EQ(cuts, 1);
  const Sketch sketch = scene.sketch();
  const auto green = std::ranges::find_if(sketch.lines, [](const Line& line) {
    return crate_sample::same(line.style.color, kClipPolygon);
  });
  ASSERT_NE(green, sketch.lines.end());
  EXPECT_NEAR((green->to - green->from).norm(), 0.7, 1e-9);
  // The cutting plane is drawn; no plane is drawn if the whole axis is over the face.
  const auto planes = [](const Sketch& drawn) {
    return std::ranges::count_if(drawn.surfaces, [](const Surface& surface) {
      return crate_sample::same(with_alpha(surface.color, 1), kSidePlane);
    });
  };
  EXPECT_EQ(planes(sketch), 1);
  RoundScene within = scene;
  within.frames[0].poses[1].second.position = {0.1, 0.18, 0.1};
  within.touch(Vec3d::UnitY(), "face_a",
               {{{-0.4, 0, 0.1}, -0.02, "a:f2 b:v0"}, {{0.6, 0, 0.1}, -0.02, "a:f2 b:v1"}});
  EXPECT_EQ(planes(within.sketch()), 0);
  // A contact of closest points has no reference face.
  scene.pair().manifolds[0].axis = "closest_points";
  EXPECT_FALSE(clipped_segment(shown, scene.pair()));
  EXPECT_FALSE(face_of_round(shown, scene.pair()));
}

// A block has room for the text, but the text must not cross its edges.
TEST(Radii, TheirSumStandsOffTheEdgesOfAHull) {
  RoundScene scene(cuboid("block", {0.9, 0.35, 0.6}), Vec3d(0, -0.35, 0),
                   round_shape("ball", {Vec3d::Zero()}, 0.3), Vec3d(0, 0.12, 0));
  trace::Shape& block = scene.header.shapes[0];
  block.edges = {{0, 1}, {0, 2}, {0, 4}, {1, 3}, {1, 5}, {2, 3},
                 {2, 6}, {3, 7}, {4, 5}, {4, 6}, {5, 7}, {6, 7}};
  scene.touch(Vec3d::UnitY(), "closest_points", {{{0, 0, 0}, -0.18, "a:f2 b:v0"}});
  scene.view.eye = Vec3d(1, 1, 4);
  scene.view.layers = {Layer::Shapes, Layer::Core};
  const Staging staging = scene.staged();
  const Drawing drawing = illustrate(staging, scene.frames[0]);
  const Text* sum = nullptr;
  for (const Primitive& primitive : drawing.primitives)
    if (const Text* text = std::get_if<Text>(&primitive))
      if (text->text == "overlap 300 − 120 = 180 mm") sum = text;
  ASSERT_NE(sum, nullptr);
  const Rect box{sum->at.x, sum->at.y - 0.7 * sum->size,
                 text_width(sum->text, sum->size, sum->weight), 0.8 * sum->size};
  for (const auto& edge : block.edges) {
    const Point2 from = *staging.camera.project(block.vertices[std::size_t(edge[0])] -
                                                Vec3d(0, 0.35, 0)),
                 to = *staging.camera.project(block.vertices[std::size_t(edge[1])] -
                                              Vec3d(0, 0.35, 0));
    EXPECT_FALSE(clip_segment(box, from, to)) << edge[0] << " to " << edge[1];
  }
}

TEST(Radii, TheirSumIsOutsideBothShapes) {
  for (const double aside : {0.0, 0.35}) {
    RoundScene scene(round_shape("large", {Vec3d::Zero()}, 0.5), Vec3d::Zero(),
                     round_shape("small", {Vec3d::Zero()}, 0.3), {aside, 0.6, 0});
    const Vec3d unit_direction = Vec3d(aside, 0.6, 0).normalized();
    scene.touch(unit_direction, "centres",
                {{0.45 * unit_direction, Vec3d(aside, 0.6, 0).norm() - 0.8, ""}});
    const Staging staging = scene.staged();
    const Sketch sketch = sketch_frame(staging, scene.frames[0]);
    const auto sum = std::ranges::find_if(sketch.labels, [](const Label& label) {
      return label.text.find(" = ") != std::string::npos;
    });
    ASSERT_NE(sum, sketch.labels.end());
    const Point2 at = *staging.camera.project(sum->at);
    for (const auto& [center, radius] :
         {std::pair(Vec3d(0, 0, 0), 0.5), std::pair(Vec3d(aside, 0.6, 0), 0.3)})
      EXPECT_GT(distance(at, *staging.camera.project(center)),
                radius * staging.camera.pixels_per_metre(center));
  }
}

}  // namespace
}  // namespace contactscope::draw
