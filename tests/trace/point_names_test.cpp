#include "trace/find.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "trace/trace.h"

namespace contactscope::trace {
namespace {

Shape unit_box(const std::string& name) {
  Shape box;
  box.name = name;
  box.type = "box";
  for (int i = 0; i < 8; ++i)
    box.vertices.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
  box.faces = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  Shape::edges_from_faces(box);
  return box;
}

/// A box on another, shifted by 0.5 m, 20 mm deep; points `up` metres above the overlap's middle.
Frame box_on_box(double up) {
  Frame frame;
  frame.poses = {{"low", {}}, {"high", {.position = {0.5, 1.98, 0}}}};
  Pair& pair = frame.pairs.emplace_back();
  pair.a = "low";
  pair.b = "high";
  Manifold& manifold = pair.manifolds.emplace_back();
  manifold.normal = Vec3d::UnitY();
  for (const double x : {-0.5, 1.0})
    for (const double z : {-1.0, 1.0}) manifold.points.push_back({{x, 0.99 + up, z}, -0.02, ""});
  return frame;
}

std::vector<std::string> ids_of(const Frame& frame) {
  std::vector<std::string> ids;
  for (const Point& point : frame.pairs.front().manifolds.front().points) ids.push_back(point.id);
  return ids;
}

// Edges of either box are numbered in the order in which its faces first use them.
TEST(PointNames, AreTheSameOnWhicheverSurfaceAnEngineHasItsPoints) {
  const std::vector<Shape> shapes = {unit_box("low"), unit_box("high")};
  Frame middle = box_on_box(0), on_low = box_on_box(0.01), on_high = box_on_box(-0.01);
  for (Frame* const frame : {&middle, &on_low, &on_high}) name_points(shapes, *frame);
  // The upper box keeps its corners; at the lower one's side, its edges cut those of the upper one.
  EXPECT_EQ(ids_of(middle),
            (std::vector<std::string>{"b:e0 b:e8", "b:e0 b:e9", "a:e5 b:e8", "a:e5 b:e9"}));
  EXPECT_EQ(ids_of(on_low), ids_of(middle));
  EXPECT_EQ(ids_of(on_high), ids_of(middle));
}

TEST(PointNames, KeepTheIdsOfAnEngine) {
  Frame frame = box_on_box(0);
  frame.pairs.front().manifolds.front().points.front().id = "77";
  name_points({unit_box("low"), unit_box("high")}, frame);
  EXPECT_EQ(ids_of(frame), (std::vector<std::string>{"77", "", "", ""}));
}

}  // namespace
}  // namespace contactscope::trace
