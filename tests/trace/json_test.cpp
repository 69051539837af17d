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
#include "trace/walk_facts.h"

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

TEST(TraceJson, NumbersReadBackToTheSameBits) {
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
  Frame frame;
  Minkowski& facts = frame.pairs.emplace_back().minkowski.emplace();
  for (const double value : values) facts.vertices.push_back({value, 0, 0});
  const Trace trace = read_back(sample_header(), frame);
  for (std::size_t i = 0; i < values.size(); ++i) {
    ASSERT_EQ(
        std::bit_cast<std::uint64_t>(trace.frames.at(0).pairs.at(0).minkowski->vertices.at(i).x()),
        std::bit_cast<std::uint64_t>(values[i]));
  }
}

TEST(TraceJson, SlowNonFiniteIsNotWritten) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity()}) {
    Trace trace = filled_trace();
    const auto refuse = [&](double& number, Kind) {
      const double good = std::exchange(number, bad);
      EXPECT_THROW((void)(to_json_line(trace.header) + to_json_line(trace.frames[0])),
                   std::domain_error);
      number = good;
    };
    each_number(trace.header, refuse);
    each_number(trace.frames[0], refuse);
  }
  Frame frame = sample_frame();
  frame.pairs[0].separation = std::numeric_limits<double>::infinity();
  try {
    to_json_line(frame);
    FAIL() << "an infinite separation was written";
  } catch (const std::domain_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("'separation'"));
  }
}

}  // namespace
}  // namespace contactscope::trace
