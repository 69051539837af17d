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

ordered_json written(const Frame& frame) {
  return ordered_json::parse(to_json_line(frame));
}

Frame frame_read(const ordered_json& line) {
  std::istringstream in(to_json_line(sample_header()) + "\n" + line.dump() + "\n");
  return read_trace(in, "run.jsonl").frames.at(0);
}

/// What reading the sample frame complains of after `change`.
template <class Change>
std::string complaint_after(Change&& change) {
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

TEST(StageJson, EveryFieldOfPenetrationComesBack) {
  Frame frame = sample_frame();
  Penetration& before = *frame.pairs[0].penetration;
  before.fallback = "sampling";
  before.portals = {{{{1, 0, 0}, {0, 1, -0.0}}}, {}};
  before.directions = {{{0, 1, 0}, -0.25}, {{0, 0, -1}, double(0.1f)}};
  const Penetration after = *frame_read(written(frame)).pairs[0].penetration;
  EXPECT_EQ(after.method + after.status + after.fallback, "epaconvergedsampling");
  EXPECT_EQ(after.iterations, 2);
  EXPECT_EQ(after.depth, double(0.005f));
  EXPECT_EQ(after.normal, Vec3d(0, -1, 0));
  EXPECT_EQ(after.point_a, Vec3d(1, 2, 3));
  EXPECT_EQ(after.point_b, Vec3d(4, 5, 6));
  EXPECT_EQ(after.polytopes, before.polytopes);
  EXPECT_EQ(after.portals, before.portals);
  EXPECT_EQ(after.directions, before.directions);
}

TEST(StageJson, TheMinkowskiDifferenceAndTheCrossingEdgesComeBack) {
  const Frame frame = sample_frame();
  const ordered_json line = written(frame);
  EXPECT_THAT(key_names(line["pairs"][0]["minkowski"]), ElementsAre("vertices", "faces"));
  EXPECT_THAT(key_names(line["pairs"][0]["sat"]["edge_pairs"][0]),
              ElementsAre("a", "b", "separation", "normal"));
  const Frame after = frame_read(line);
  EXPECT_EQ(after.pairs[0].minkowski, frame.pairs[0].minkowski);
  EXPECT_EQ(after.pairs[0].sat->edge_pairs, frame.pairs[0].sat->edge_pairs);
}

TEST(StageJson, ImpulsesStandWithTheirPoints) {
  const Frame frame = sample_frame();
  const ordered_json line = written(frame);
  const ordered_json& points = line["pairs"][0]["manifolds"][0]["points"];
  EXPECT_FALSE(points[0].contains("impulse"));
  EXPECT_THAT(key_names(points[1]["impulse"]), ElementsAre("normal", "friction", "warm_start"));
  const std::vector<Point> after = frame_read(line).pairs[0].manifolds[0].points;
  EXPECT_EQ(after[0].impulse, std::nullopt);
  EXPECT_EQ(after[1].impulse, (Impulse{0.75, {0.125, 0, 1e-300}, 0.5}));
}

TEST(StageJson, AnIncrementalManifoldComesBackWithWhatBecameOfEachPoint) {
  const Frame frame = sample_frame();
  const ordered_json line = written(frame);
  const ordered_json& json = line["pairs"][0]["incremental"];
  EXPECT_THAT(key_names(json), ElementsAre("confirm", "query", "margin_a", "margin_b", "points"));
  EXPECT_THAT(key_names(json["points"][0]), ElementsAre("position", "separation", "id", "impulse",
                                                        "on_a", "on_b", "state", "age"));
  EXPECT_THAT(key_names(json["points"][1]), ElementsAre("position", "separation", "id", "on_a",
                                                        "on_b", "state", "reason", "age"));
  const Incremental after = *frame_read(line).pairs[0].incremental;
  EXPECT_EQ(after.confirm + after.query, "distancegjk");
  EXPECT_EQ(after.margin_a, 0.01);
  EXPECT_EQ(after.margin_b, 0.02);
  ASSERT_EQ(after.points.size(), 2u);
  EXPECT_EQ(after.points[0].point.position, Vec3d(1, 2, 3));
  EXPECT_EQ(after.points[0].point.separation, -0.005);
  EXPECT_EQ(after.points[0].point.id, "a:v1 b:f2");
  EXPECT_EQ(after.points[0].point.impulse->normal, 0.25);
  EXPECT_EQ(after.points[0].on_a, Vec3d(7, 8, 9));
  EXPECT_EQ(after.points[0].on_b, Vec3d(4, 5, 6));
  EXPECT_EQ(after.points[0].state + after.points[0].reason, "new");
  EXPECT_EQ(after.points[1].state + after.points[1].reason, "brokenslid");
  EXPECT_EQ(after.points[1].point.impulse, std::nullopt);
  EXPECT_EQ(after.points[1].age, 17);
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

TEST(StageJson, TheSolverComesBackWithItsBodiesInOrder) {
  const Frame frame = sample_frame();
  const ordered_json line = written(frame);
  EXPECT_THAT(key_names(line["solver"]),
              ElementsAre("position_correction", "iterations", "substeps", "warm_start", "slop",
                          "speculative_margin", "bodies"));
  EXPECT_THAT(key_names(line["solver"]["bodies"]), ElementsAre("zebra", "apple"));
  EXPECT_THAT(key_names(line["solver"]["bodies"]["zebra"]),
              ElementsAre("mass", "center_of_mass", "velocity", "angular_velocity",
                          "kinetic_energy", "potential_energy"));
  EXPECT_EQ(frame_read(line).solver, frame.solver);
}

TEST(StageJson, RelativeVelocitiesStandWithTheirPoints) {
  Frame frame = sample_frame();
  std::vector<Point>& points = frame.pairs[0].manifolds[0].points;
  points[1].relative_velocity = RelativeVelocity{{1, -2.5, 1e-300}, {0.125, -0.0, 4}};
  const ordered_json line = written(frame);
  const ordered_json& json = line["pairs"][0]["manifolds"][0]["points"];
  EXPECT_FALSE(json[0].contains("relative_velocity"));
  EXPECT_THAT(key_names(json[1]["relative_velocity"]), ElementsAre("before", "after"));
  const std::vector<Point> after = frame_read(line).pairs[0].manifolds[0].points;
  EXPECT_EQ(after[0].relative_velocity, std::nullopt);
  EXPECT_EQ(after[1].relative_velocity, points[1].relative_velocity);
}

/// Two points that the solver took, with one name, and one that it left out.
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

TEST(StageJson, AFrameWithoutASolverHasNoKeyForIt) {
  Frame frame = sample_frame();
  frame.solver.reset();
  EXPECT_FALSE(written(frame).contains("solver"));
  EXPECT_FALSE(written(frame).contains("totals"));
  EXPECT_EQ(frame_read(written(frame)).solver, std::nullopt);
}

TEST(StageJson, AnIndexThatPointsNowhereIsRefused) {
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

TEST(StageJson, AMissingKeyIsNamedWithItsPlace) {
  const auto without = [](const char* parent, const char* key) {
    return [=](ordered_json& line) { line.at(ordered_json::json_pointer(parent)).erase(key); };
  };
  EXPECT_THAT(complaint_after(without("/pairs/0/incremental/points/1", "state")),
              HasSubstr("'pairs[0].incremental.points[1]' has no key 'state'"));
  EXPECT_THAT(complaint_after(without("/solver/bodies/apple", "mass")),
              HasSubstr("'solver.bodies.apple' has no key 'mass'"));
  EXPECT_THAT(complaint_after(without("/pairs/0/penetration", "depth")),
              HasSubstr("'pairs[0].penetration' has no key 'depth'"));
}

TEST(StageJson, WhatIsNotFiniteIsNotWritten) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [](auto&& spoil) -> std::string {
    Frame frame = sample_frame();
    spoil(frame, frame.pairs[0]);
    try {
      to_json_line(frame);
    } catch (const std::domain_error& error) {
      return error.what();
    }
    return "written";
  };
  EXPECT_THAT(refused([&](Frame&, Pair& p) { p.penetration->depth = nan; }), HasSubstr("'depth'"));
  EXPECT_THAT(refused([&](Frame&, Pair& p) { p.minkowski->vertices[1].y() = nan; }),
              HasSubstr("'vertices'"));
  EXPECT_THAT(refused([&](Frame&, Pair& p) { p.sat->edge_pairs[0].separation = nan; }),
              HasSubstr("'separation'"));
  EXPECT_THAT(refused([&](Frame&, Pair& p) { p.stability->margin = nan; }), HasSubstr("'margin'"));
  EXPECT_THAT(refused([&](Frame&, Pair& p) { p.incremental->points[0].on_b.x() = nan; }),
              HasSubstr("'on_b'"));
  EXPECT_THAT(refused([&](Frame&, Pair& p) { p.manifolds[0].points[1].impulse->warm_start = nan; }),
              HasSubstr("'warm_start'"));
  EXPECT_THAT(refused([&](Frame& f, Pair&) { f.solver->bodies[1].kinetic_energy = nan; }),
              HasSubstr("'kinetic_energy'"));
}

}  // namespace
}  // namespace contactscope::trace
