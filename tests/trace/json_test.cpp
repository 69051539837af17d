#include "trace/json.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <sstream>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "trace/sample_trace.h"

namespace contactscope::trace {
namespace {

using json = nlohmann::ordered_json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<std::string> keys_of(const json& object) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : object.items()) keys.push_back(key);
  return keys;
}

Trace read_back(const Header& header, const Frame& frame) {
  std::istringstream in(to_json_line(header) + "\n" + to_json_line(frame) + "\n");
  return read_trace(in, "memory.jsonl");
}

TEST(TraceJson, HeaderHasTheKeysOfTheFormatInItsOrder) {
  const auto line = json::parse(to_json_line(sample_header()));
  EXPECT_THAT(keys_of(line), ElementsAre("schema", "scenario", "title", "source", "scalar", "up",
                                         "frames", "shapes"));
  EXPECT_EQ(line["schema"], "contactscope.trace/1");
  EXPECT_EQ(line["frames"], 24);
  EXPECT_THAT(keys_of(line["shapes"]), ElementsAre("zebra", "apple", "pill", "ground"));
  EXPECT_THAT(keys_of(line["shapes"]["zebra"]),
              ElementsAre("type", "vertices", "faces", "edges", "center_of_mass"));
  EXPECT_THAT(keys_of(line["shapes"]["pill"]),
              ElementsAre("type", "vertices", "faces", "edges", "center_of_mass", "radius"));
  EXPECT_THAT(keys_of(line["shapes"]["ground"]["half_space"]), ElementsAre("normal", "offset"));
  EXPECT_EQ(line["shapes"]["zebra"]["faces"][0], json({0, 2, 1}));
  EXPECT_EQ(line["shapes"]["zebra"]["edges"][1], json({1, 2}));
}

TEST(TraceJson, FrameHasTheKeysOfTheFormatInItsOrder) {
  const auto line = json::parse(to_json_line(sample_frame()));
  EXPECT_THAT(keys_of(line), ElementsAre("frame", "time", "poses", "pairs", "solver"));
  EXPECT_THAT(keys_of(line["poses"]["zebra"]), ElementsAre("position", "quat_wxyz"));
  EXPECT_EQ(line["poses"]["zebra"]["quat_wxyz"], json({0.5, -0.5, 0.5, -0.5}));
  const auto& pair = line["pairs"][0];
  EXPECT_THAT(keys_of(pair),
              ElementsAre("a", "b", "label", "kind", "state", "separation", "manifolds", "sat",
                          "clip", "reduction", "gjk", "tree", "degenerate", "cache", "penetration",
                          "minkowski", "incremental", "stability"));
  EXPECT_THAT(keys_of(pair["cache"]), ElementsAre("hit", "kind", "axis", "normal", "moved"));
  EXPECT_EQ(pair["cache"]["hit"], true);
  EXPECT_THAT(keys_of(pair["manifolds"][0]),
              ElementsAre("normal", "axis", "type", "triangle", "points"));
  EXPECT_THAT(keys_of(pair["manifolds"][0]["points"][0]),
              ElementsAre("position", "separation", "id"));
  EXPECT_THAT(keys_of(pair["sat"]),
              ElementsAre("face_a", "face_b", "edge", "chosen", "preference", "edge_pairs"));
  EXPECT_THAT(keys_of(pair["sat"]["face_a"]),
              ElementsAre("face", "separation", "normal", "support"));
  EXPECT_THAT(keys_of(pair["sat"]["edge"]),
              ElementsAre("a", "b", "separation", "normal", "point_a", "point_b"));
  EXPECT_THAT(keys_of(pair["clip"]), ElementsAre("reference", "incident", "steps", "dropped"));
  EXPECT_THAT(keys_of(pair["clip"]["reference"]),
              ElementsAre("shape", "face", "normal", "polygon"));
  EXPECT_THAT(keys_of(pair["clip"]["steps"][0]), ElementsAre("plane", "polygon"));
  EXPECT_THAT(keys_of(pair["clip"]["steps"][0]["plane"]), ElementsAre("normal", "offset"));
  EXPECT_THAT(keys_of(pair["clip"]["dropped"][0]), ElementsAre("position", "reason"));
  EXPECT_THAT(keys_of(pair["reduction"]),
              ElementsAre("method", "points", "kept", "area", "best_area", "best", "choices"));
  const auto& choices = pair["reduction"]["choices"];
  EXPECT_THAT(keys_of(choices[0]), ElementsAre("rule", "direction", "measures"));
  EXPECT_THAT(keys_of(choices[0]["measures"][0]), ElementsAre("point", "value"));
  EXPECT_THAT(keys_of(choices[1]), ElementsAre("rule", "measures"));
  EXPECT_THAT(keys_of(choices[1]["measures"][0]), ElementsAre("point", "edge", "value"));
}

TEST(TraceJson, AReductionWithoutStepsOrABestPolygonHasNoKeyForThem) {
  Frame frame = sample_frame();
  frame.pairs[0].reduction->best.clear();
  frame.pairs[0].reduction->choices.clear();
  const auto line = json::parse(to_json_line(frame));
  EXPECT_THAT(keys_of(line["pairs"][0]["reduction"]),
              ElementsAre("method", "points", "kept", "area", "best_area"));
}

TEST(TraceJson, AMissOfASeparatingAxisHasNeitherANormalNorAWayMoved) {
  Frame frame = sample_frame();
  frame.pairs[0].cache = Cache{false, "separating_axis", "edge_edge", {}, {}};
  const auto line = json::parse(to_json_line(frame));
  EXPECT_THAT(keys_of(line["pairs"][0]["cache"]), ElementsAre("hit", "kind", "axis"));
}

TEST(TraceJson, TriangleIsNullWithoutOne) {
  const auto line = json::parse(to_json_line(sample_frame()));
  EXPECT_TRUE(line["pairs"][0]["manifolds"][0]["triangle"].is_null());
  EXPECT_EQ(line["pairs"][0]["manifolds"][1]["triangle"], 17);
}

TEST(TraceJson, AStageThatDidNotRunHasNoKey) {
  const auto line = json::parse(to_json_line(sample_frame()));
  EXPECT_THAT(keys_of(line["pairs"][1]),
              ElementsAre("a", "b", "kind", "state", "separation", "manifolds"));
  EXPECT_TRUE(line["pairs"][1]["manifolds"].is_array());
  Frame frame = sample_frame();
  frame.pairs[0].sat->edge.reset();
  const auto without_edge = json::parse(to_json_line(frame));
  EXPECT_FALSE(without_edge["pairs"][0]["sat"].contains("edge"));
}

TEST(TraceJson, EachIsOneLine) {
  Header header = sample_header();
  header.title = "two\nlines";
  EXPECT_EQ(to_json_line(header).find('\n'), std::string::npos);
  EXPECT_EQ(to_json_line(sample_frame()).find('\n'), std::string::npos);
}

TEST(TraceJson, ReadingAndWritingAgainGivesTheSameLines) {
  const Trace trace = read_back(sample_header(), sample_frame());
  ASSERT_EQ(trace.frames.size(), 1u);
  EXPECT_EQ(to_json_line(trace.header), to_json_line(sample_header()));
  EXPECT_EQ(to_json_line(trace.frames[0]), to_json_line(sample_frame()));
}

// The line above could agree with itself and still have lost a field that the writer forgets.
TEST(TraceJson, EveryFieldComesBack) {
  const Trace trace = read_back(sample_header(), sample_frame());
  const Header header = sample_header();
  EXPECT_EQ(trace.header.scenario, header.scenario);
  EXPECT_EQ(trace.header.title, header.title);
  EXPECT_EQ(trace.header.source, header.source);
  EXPECT_EQ(trace.header.scalar, header.scalar);
  EXPECT_EQ(trace.header.up, header.up);
  EXPECT_EQ(trace.header.frames, header.frames);
  ASSERT_EQ(trace.header.shapes.size(), 4u);
  EXPECT_EQ(trace.header.shapes[0].name, "zebra");
  EXPECT_EQ(trace.header.shapes[1].type, "box");
  EXPECT_EQ(trace.header.shapes[0].vertices, header.shapes[0].vertices);
  EXPECT_EQ(trace.header.shapes[0].faces, header.shapes[0].faces);
  EXPECT_EQ(trace.header.shapes[0].edges, header.shapes[0].edges);
  EXPECT_EQ(trace.header.shapes[0].center_of_mass, header.shapes[0].center_of_mass);
  EXPECT_EQ(trace.header.shapes[0].radius, 0);
  EXPECT_EQ(trace.header.shapes[0].half_space, std::nullopt);
  EXPECT_EQ(trace.header.shapes[2].radius, double(0.1f));
  EXPECT_EQ(trace.header.shapes[3].half_space->normal, Vec3d(0.6, 0, -0.8));
  EXPECT_EQ(trace.header.shapes[3].half_space->offset, -0.25);

  const Frame frame = sample_frame();
  const Frame& read = trace.frames.at(0);
  EXPECT_EQ(read.frame, 12);
  EXPECT_EQ(read.time, frame.time);
  ASSERT_EQ(read.poses.size(), 2u);
  EXPECT_EQ(read.poses[0].first, "zebra");
  EXPECT_EQ(read.poses[0].second.position, frame.poses[0].second.position);
  EXPECT_EQ(read.poses[0].second.rotation.coeffs(), frame.poses[0].second.rotation.coeffs());
  ASSERT_EQ(read.pairs.size(), 2u);
  const Pair& pair = read.pairs[0];
  EXPECT_EQ(pair.a + pair.b + pair.label + pair.kind + pair.state,
            "zebraapplepreference onhull-hulltouching");
  EXPECT_EQ(pair.separation, frame.pairs[0].separation);
  ASSERT_EQ(pair.manifolds.size(), 2u);
  EXPECT_EQ(pair.manifolds[0].normal, Vec3d(0, -1, 0));
  EXPECT_EQ(pair.manifolds[0].axis, "face_b");
  EXPECT_EQ(pair.manifolds[0].type, "face-face");
  EXPECT_EQ(pair.manifolds[1].type, "");
  EXPECT_EQ(pair.degenerate->geometry, "coincident centres");
  EXPECT_EQ(pair.degenerate->answer, "skip");
  EXPECT_EQ(read.pairs[1].degenerate, std::nullopt);
  EXPECT_EQ(pair.gjk->status, "separated");
  EXPECT_EQ(pair.gjk->iterations, 3);
  EXPECT_EQ(pair.gjk->distance, 0.25);
  EXPECT_EQ(pair.gjk->point_a, Vec3d(1, 2, 3));
  EXPECT_EQ(pair.gjk->point_b, Vec3d(4, 5, 6));
  EXPECT_EQ(pair.gjk->steps, frame.pairs[0].gjk->steps);
  EXPECT_EQ(pair.tree->shape, "apple");
  EXPECT_EQ(pair.tree->box, frame.pairs[0].tree->box);
  EXPECT_EQ(pair.tree->visits, frame.pairs[0].tree->visits);
  EXPECT_THAT(pair.tree->candidates, ElementsAre(4, 17));
  EXPECT_TRUE(pair.cache->hit);
  EXPECT_EQ(pair.cache->kind, "features");
  EXPECT_EQ(pair.cache->axis, "face_b");
  EXPECT_EQ(*pair.cache->normal, Vec3d(0, -1, 0));
  EXPECT_EQ(pair.cache->moved, double(0.0125f));
  EXPECT_FALSE(read.pairs[1].cache.has_value());
  EXPECT_EQ(pair.manifolds[0].triangle, std::nullopt);
  EXPECT_EQ(pair.manifolds[1].triangle, 17);
  EXPECT_EQ(pair.manifolds[0].points.at(0).id, "a:e3 b:e7");
  EXPECT_EQ(pair.manifolds[0].points.at(0).position, Vec3d(0.1, 0.2, 0.3));
  EXPECT_EQ(pair.manifolds[0].points.at(0).separation, -0.005);
  EXPECT_EQ(pair.sat->face_a->face, 1);
  EXPECT_EQ(pair.sat->face_a->support, Vec3d(6, 7, 8));
  EXPECT_EQ(pair.sat->face_b->separation, -0.25);
  EXPECT_EQ(pair.sat->face_b->normal, Vec3d(1, 0, 0));
  EXPECT_EQ(pair.sat->edge->a, 3);
  EXPECT_EQ(pair.sat->edge->b, 4);
  EXPECT_EQ(pair.sat->edge->separation, -0.125);
  EXPECT_EQ(pair.sat->edge->normal, Vec3d(0, 0, 1));
  EXPECT_EQ(pair.sat->edge->point_a, Vec3d(1, 2, 3));
  EXPECT_EQ(pair.sat->edge->point_b, Vec3d(4, 5, 6));
  EXPECT_EQ(pair.sat->chosen + pair.sat->preference, "face_brelative");
  EXPECT_EQ(pair.clip->reference.shape, "apple");
  EXPECT_EQ(pair.clip->reference.face, 2);
  EXPECT_EQ(pair.clip->incident.normal, Vec3d(0, -1, 0));
  EXPECT_EQ(pair.clip->incident.polygon, frame.pairs[0].clip->incident.polygon);
  ASSERT_EQ(pair.clip->steps.size(), 2u);
  EXPECT_EQ(pair.clip->steps[0].normal, Vec3d(1, 0, 0));
  EXPECT_EQ(pair.clip->steps[0].polygon, frame.pairs[0].clip->steps[0].polygon);
  EXPECT_EQ(pair.clip->steps[1].offset, -0.75);
  EXPECT_EQ(pair.clip->dropped.at(0).position, Vec3d(3, 2, 1));
  EXPECT_EQ(pair.clip->dropped.at(0).reason, "above the reference face");
  EXPECT_EQ(pair.reduction->method, "area");
  EXPECT_EQ(pair.reduction->points.size(), 2u);
  EXPECT_THAT(pair.reduction->kept, ElementsAre(1, 0));
  EXPECT_EQ(pair.reduction->area, 0.0625);
  EXPECT_EQ(pair.reduction->best_area, 0.125);
  EXPECT_THAT(pair.reduction->best, ElementsAre(0, 1));
  ASSERT_EQ(pair.reduction->choices.size(), 2u);
  const Choice& support = pair.reduction->choices[0];
  EXPECT_EQ(support.rule, "support");
  EXPECT_EQ(support.direction, Vec3d(0.6, 0, 0.8));
  ASSERT_EQ(support.measures.size(), 2u);
  EXPECT_EQ(support.measures[1].point, 1);
  EXPECT_EQ(support.measures[1].edge, kNoEdge);
  EXPECT_EQ(support.measures[1].value, double(0.1f));
  const Choice& outside = pair.reduction->choices[1];
  EXPECT_EQ(outside.rule, "outside");
  EXPECT_EQ(outside.direction, Vec3d(0, 0, 0));
  EXPECT_EQ(outside.measures.at(0).edge, (std::array<int, 2>{1, 0}));
  EXPECT_EQ(outside.measures.at(0).value, -1e-300);
  EXPECT_FALSE(read.pairs[1].sat || read.pairs[1].clip || read.pairs[1].reduction);
}

TEST(TraceJson, SlowNumbersReadBackToTheSameBits) {
  std::vector<double> values = {0.0,
                                -0.0,
                                0.1,
                                double(0.1f),
                                -double(0.005f),
                                1e-300,
                                5e-324,
                                1e300,
                                std::numeric_limits<double>::max(),
                                std::numeric_limits<double>::epsilon(),
                                9007199254740993.0,
                                1e16,
                                -3.0};
  std::mt19937_64 random(2026);
  while (values.size() < 5000) {
    const double value = std::bit_cast<double>(random());
    if (std::isfinite(value)) values.push_back(value);
  }
  for (const double value : values) {
    Frame frame;
    frame.time = value;
    const Trace trace = read_back(sample_header(), frame);
    ASSERT_EQ(std::bit_cast<std::uint64_t>(trace.frames.at(0).time),
              std::bit_cast<std::uint64_t>(value))
        << to_json_line(frame);
  }
}

TEST(TraceJson, WhatIsNotFiniteIsNotWritten) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  Frame frame = sample_frame();
  frame.pairs[0].manifolds[0].points[0].position.z() = nan;
  EXPECT_THROW(to_json_line(frame), std::domain_error);
  frame = sample_frame();
  frame.pairs[0].separation = -infinity;
  try {
    to_json_line(frame);
    FAIL() << "an infinite separation was written";
  } catch (const std::domain_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("'separation'"));
  }
  frame = sample_frame();
  frame.poses[0].second.rotation.x() = nan;
  EXPECT_THROW(to_json_line(frame), std::domain_error);
  frame = sample_frame();
  frame.pairs[0].clip->steps[0].offset = infinity;
  EXPECT_THROW(to_json_line(frame), std::domain_error);
  frame = sample_frame();
  frame.pairs[0].reduction->choices[1].measures[0].value = nan;
  EXPECT_THROW(to_json_line(frame), std::domain_error);
  frame = sample_frame();
  frame.pairs[0].reduction->choices[0].direction.y() = -infinity;
  EXPECT_THROW(to_json_line(frame), std::domain_error);
  Header header = sample_header();
  header.shapes[0].vertices[0].x() = infinity;
  EXPECT_THROW(to_json_line(header), std::domain_error);
}

}  // namespace
}  // namespace contactscope::trace
