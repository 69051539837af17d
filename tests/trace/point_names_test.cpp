#include "trace/point_names.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>

#include "trace/find.h"
#include "trace/json.h"

namespace contactscope::trace {
namespace {

/// Points that have the id that the pipeline gave them once their ids were taken away and made up anew.
struct Agreement {
  int same = 0, of = 0;
};

/// By kind of pair and axis.
using Agreements = std::map<std::string, Agreement>;

/// What other engines do not tell.
void take_ids_away(Frame& frame) {
  for (Pair& pair : frame.pairs)
    for (Manifold& manifold : pair.manifolds) {
      manifold.axis.clear();
      for (Point& point : manifold.points) point.id.clear();
    }
}

/// Of a frame and its copy with ids made up.
void compare(const Frame& ours, const Frame& made_up, Agreements& all) {
  for (std::size_t p = 0; p < ours.pairs.size(); ++p) {
    const Pair& pair = ours.pairs[p];
    // A field has no features; a confirmed point keeps the id of the frame in which it was found.
    if (pair.kind.find("sdf") != std::string::npos || pair.incremental) continue;
    for (std::size_t m = 0; m < pair.manifolds.size(); ++m) {
      const Manifold& manifold = pair.manifolds[m];
      Agreement& agreement = all[pair.kind + " " + manifold.axis];
      for (std::size_t i = 0; i < manifold.points.size(); ++i) {
        ++agreement.of;
        agreement.same += made_up.pairs[p].manifolds[m].points[i].id == manifold.points[i].id;
      }
    }
  }
}

TEST(PointNames, SlowAgreeWithThePipelineInNinetyNineOfAHundred) {
  Agreements all;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(CONTACTSCOPE_SOURCE_DIR "/snapshots")) {
    if (entry.path().extension() != ".jsonl") continue;
    std::ifstream file(entry.path());
    const Trace trace = read_trace(file, entry.path());
    std::vector<Shape> shapes = trace.header.shapes;
    for (const Frame& frame : trace.frames) {
      shapes.insert(shapes.end(), frame.shapes.begin(), frame.shapes.end());
      Frame named = frame;
      take_ids_away(named);
      name_points(shapes, named);
      compare(frame, named, all);
    }
  }
  Agreement sum;
  std::string others;
  for (const auto& [kind, agreement] : all) {
    sum.same += agreement.same;
    sum.of += agreement.of;
    if (agreement.same < agreement.of)
      others += "\n" + kind + ": " + std::to_string(agreement.same) + " of " +
                std::to_string(agreement.of);
  }
  EXPECT_GE(sum.of, 4000);
  EXPECT_GE(sum.same, 0.99 * sum.of) << sum.same << " of " << sum.of << others;
}

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

/// A box on another, half a metre to the side, 20 mm deep; points this far up from the middle of the overlap.
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

// Edges of either box count as its faces first run along them.
TEST(PointNames, AreTheSameOnWhicheverSurfaceAnEngineHasItsPoints) {
  const std::vector<Shape> shapes = {unit_box("low"), unit_box("high")};
  Frame middle = box_on_box(0), on_low = box_on_box(0.01), on_high = box_on_box(-0.01);
  for (Frame* const frame : {&middle, &on_low, &on_high}) name_points(shapes, *frame);
  // Corners of the upper box have stayed; at the side of the lower one its edges cut those of the upper.
  EXPECT_EQ(ids_of(middle),
            (std::vector<std::string>{"b:e0 b:e8", "b:e0 b:e9", "a:e5 b:e8", "a:e5 b:e9"}));
  EXPECT_EQ(ids_of(on_low), ids_of(middle));
  EXPECT_EQ(ids_of(on_high), ids_of(middle));
}

TEST(PointNames, LeaveWhatAnEngineTells) {
  Frame frame = box_on_box(0);
  frame.pairs.front().manifolds.front().points.front().id = "77";
  name_points({unit_box("low"), unit_box("high")}, frame);
  EXPECT_EQ(ids_of(frame), (std::vector<std::string>{"77", "", "", ""}));
}

}  // namespace
}  // namespace contactscope::trace
