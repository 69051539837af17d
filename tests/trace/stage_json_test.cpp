#include <limits>
#include <sstream>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "core/input_error.h"
#include "trace/json.h"
#include "trace/sample_trace.h"

namespace contactscope::trace {
namespace {

using nlohmann::ordered_json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<std::string> key_names(const ordered_json& object) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : object.items()) keys.push_back(key);
  return keys;
}

ordered_json written(const Frame& frame) { return ordered_json::parse(to_json_line(frame)); }

Frame frame_read(const ordered_json& line) {
  std::istringstream in(to_json_line(sample_header()) + "\n" + line.dump() + "\n");
  return read_trace(in, "run.jsonl").frames.at(0);
}

/// The error of reading the sample frame after `change`.
template <class Change> std::string complaint_after(Change&& change) {
  ordered_json line = written(sample_frame());
  change(line);
  try {
    frame_read(line);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no complaint";
}

TEST(StageJson, PenetrationHasTheKeysOfItsMethod) {
  Frame frame = sample_frame();
  EXPECT_THAT(key_names(written(frame)["pairs"][0]["penetration"]),
              ElementsAre("method", "status", "iterations", "depth", "normal", "point_a", "point_b",
                          "polytopes"));
  EXPECT_THAT(key_names(written(frame)["pairs"][0]["penetration"]["polytopes"][0]),
              ElementsAre("vertices", "faces", "nearest", "distance"));
  Penetration& penetration = *frame.pairs[0].penetration;
  penetration.polytopes.clear();
  penetration.fallback = "sat";
  penetration.portals = {{{{1, 0, 0}, {0, 1, -0.0}}}};
  EXPECT_THAT(key_names(written(frame)["pairs"][0]["penetration"]),
              ElementsAre("method", "status", "fallback", "iterations", "depth", "normal",
                          "point_a", "point_b", "portals"));
  penetration.portals.clear();
  penetration.directions = {{{0, 1, 0}, -0.25}, {{0, 0, -1}, 0.125}};
  EXPECT_THAT(key_names(written(frame)["pairs"][0]["penetration"]["directions"][1]),
              ElementsAre("normal", "separation"));
}

TEST(StageJson, StabilityComesBackWithAnAxisOnlyWhereItTurnsAboutOne) {
  Frame frame = sample_frame();
  EXPECT_THAT(
      key_names(written(frame)["pairs"][0]["stability"]),
      ElementsAre("shape", "center_of_mass", "projection", "support", "margin", "verdict", "axis"));
  const Stability after = *frame_read(written(frame)).pairs[0].stability;
  EXPECT_EQ(after.shape + after.verdict, "zebraturns about a line");
  EXPECT_EQ(after.center_of_mass, Vec3d(0, 1, 0));
  EXPECT_EQ(after.projection, Vec3d(0, 0.5, 0));
  EXPECT_EQ(after.support, frame.pairs[0].stability->support);
  EXPECT_EQ(after.margin, -0.25);
  ASSERT_TRUE(after.axis.has_value());
  EXPECT_EQ((*after.axis)[0], Vec3d(0, 0, 0));
  EXPECT_EQ((*after.axis)[1], Vec3d(1, 0, 0));
  frame.pairs[0].stability->axis.reset();
  EXPECT_FALSE(written(frame)["pairs"][0]["stability"].contains("axis"));
  EXPECT_FALSE(frame_read(written(frame)).pairs[0].stability->axis.has_value());
}

/// Two points with one name that the solver used, and one that it left out.
Frame frame_with_three_points() {
  Frame frame = sample_frame();
  for (Pair& pair : frame.pairs) pair.manifolds.clear();
  Manifold manifold;
  manifold.points = {{{0, 0, 0}, -0.5, "a:v1", Impulse{2, {9, 9, 9}, 0}},
                     {{0, 0, 0}, 0.25, "a:v1", Impulse{0.75, {0, 0, 0}, 0}},
                     {{0, 0, 0}, -3, "a:v2", {}}};
  frame.pairs[0].manifolds = {manifold};
  frame.solver->bodies[1].kinetic_energy = 0.25;
  return frame;
}

TEST(StageJson, TotalsAreOfPointsWithAnImpulseAndOfAllBodies) {
  Frame frame = frame_with_three_points();
  frame.totals = totals_of(frame);
  const ordered_json line = written(frame);
  EXPECT_EQ(line["totals"].dump(), R"({"penetration":0.5,"normal_impulse":2.75,"points":2,"ids":1,)"
                                   R"("kinetic_energy":0.75,"potential_energy":-9.81})");
  EXPECT_EQ(frame_read(line).totals, frame.totals);
}

TEST(StageJson, WithoutASolverTotalsAreOfAllPointsAndAPairHasNamesOfItsOwn) {
  Frame frame = frame_with_three_points();
  frame.solver.reset();
  frame.pairs[1].manifolds = frame.pairs[0].manifolds;
  const Totals totals = totals_of(frame);
  EXPECT_EQ(totals.penetration, 3);
  EXPECT_EQ(totals.points, 6);
  EXPECT_EQ(totals.ids, 4);
  EXPECT_EQ(totals.kinetic_energy, 0);
}

TEST(StageJson, AnIndexOutOfRangeIsRefused) {
  const auto at = [](const char* pointer, const ordered_json& value) {
    return [=](ordered_json& line) { line.at(ordered_json::json_pointer(pointer)) = value; };
  };
  EXPECT_THAT(complaint_after(at("/pairs/0/minkowski/faces/0/2", 3)),
              HasSubstr("'pairs[0].minkowski.faces[0][2]' is 3, but there are 3 vertices"));
  EXPECT_THAT(complaint_after(at("/pairs/0/penetration/polytopes/0/faces/1/0", 4)),
              HasSubstr("is 4, but there are 4 vertices"));
  EXPECT_THAT(complaint_after(at("/pairs/0/penetration/polytopes/0/faces/1", {0, 1})),
              HasSubstr("must have 3 indices"));
  EXPECT_THAT(complaint_after(at("/pairs/0/penetration/polytopes/0/nearest", 2)),
              HasSubstr("is 2, but there are 2 faces of the polytope"));
  EXPECT_THAT(complaint_after(at("/pairs/0/stability/axis", {{0, 0, 0}})),
              HasSubstr("'pairs[0].stability.axis' must have two points"));
}

}  // namespace
}  // namespace contactscope::trace
