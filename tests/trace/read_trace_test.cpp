#include <algorithm>
#include <sstream>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "core/input_error.h"
#include "support/cases.h"
#include "support/damaged_text.h"
#include "trace/json.h"
#include "trace/read_trace.h"
#include "trace/sample_trace.h"

namespace contactscope::trace {
namespace {

using nlohmann::ordered_json;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// what() of the InputError that reading `text` throws.
std::string complaint(const std::string& text) {
  std::istringstream in(text);
  try {
    read_trace(in, "run.jsonl");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no complaint";
}

std::string header_line() { return to_json_line(sample_header()) + "\n"; }

/// The sample frame with the value at a JSON pointer replaced.
std::string frame_with(const char* pointer, const ordered_json& value) {
  ordered_json frame = ordered_json::parse(to_json_line(sample_frame()));
  frame.at(ordered_json::json_pointer(pointer)) = value;
  return header_line() + frame.dump();
}

std::string frame_without(const char* parent, const char* key) {
  ordered_json frame = ordered_json::parse(to_json_line(sample_frame()));
  frame.at(ordered_json::json_pointer(parent)).erase(key);
  return header_line() + frame.dump();
}

TEST(ReadTrace, AllProblemsOfAHeaderAreNamedAtOnceWithTheirValues) {
  const std::string message = complaint(
      R"({"schema":"contactscope.trace/1","scenario":"a/b","title":3,"shapes":{"crate":{"type":"hull"},)"
      R"("wall":{"vertices":[[0,0,0]],"faces":[[0,1,2]]}}})");
  std::istringstream lines(message);
  std::vector<std::string> problems;
  for (std::string line; std::getline(lines, line);) problems.push_back(line);
  ASSERT_EQ(problems.size(), 5u) << message;
  for (const std::string& problem : problems) EXPECT_THAT(problem, StartsWith("run.jsonl:1:1: "));
  EXPECT_THAT(message, HasSubstr("'title' is of type number; a string is needed"));
  EXPECT_THAT(message,
              HasSubstr("the line has no key 'scalar'; a trace needs it: \"float\" or \"double\""));
  EXPECT_THAT(message, HasSubstr("no key 'up'; a trace needs it: \"y\" or \"z\""));
  EXPECT_THAT(message, HasSubstr("'shapes.crate' has no key 'vertices'; a trace needs it: list"));
  EXPECT_THAT(message, HasSubstr("'shapes.wall.faces[0][1]' is 1, but there are 1 vertices"));
}

TEST(ReadTrace, WrongWordsOfAHeaderAreAllNamedWithWhatIsAllowed) {
  const std::string message = complaint(
      R"({"schema":"contactscope.trace/1","scenario":"a/b","scalar":"single","up":"Y","shapes":{)"
      R"("crate":{"type":"cube","half_extents":[1,1,1]},"ball":{"type":"ball","radius":1},)"
      R"("rock":{"type":"potato","vertices":[[0,0,0]]}}})");
  for (const char* problem :
       {"run.jsonl:1:1: 'scalar' is 'single'; did you mean 'float'? it may be 'float' or 'double'",
        "run.jsonl:1:1: 'up' is 'Y'; did you mean 'y'? it may be 'y' or 'z'",
        "run.jsonl:1:1: 'shapes.crate.type' is 'cube'; did you mean 'box'? it may be 'box', ",
        "run.jsonl:1:1: 'shapes.ball.type' is 'ball'; did you mean 'sphere'? it may be 'box', ",
        "run.jsonl:1:1: 'shapes.rock.type' is 'potato'; it may be 'box', 'hull', "})
    EXPECT_THAT(message, HasSubstr(problem));
  EXPECT_EQ(std::ranges::count(message, '\n'), 4) << message;
}

TEST(ReadTrace, AKeyThatIsThereInsteadOfTheMissingOneIsNamed) {
  const std::string header =
      R"({"schema":"contactscope.trace/1","scenario":"a/b","scalar":"float","up":"y","shapes":{)";
  const std::string box = complaint(header + R"("box":{"type":"box","halfExtents":[1,1,1]}}})");
  EXPECT_THAT(box, HasSubstr("'shapes.box' has no key 'vertices'; by 'halfExtents' did you mean "
                             "'half_extents'? a trace needs it: list of points"));
  EXPECT_THAT(complaint(header + R"("rock":{"Vertices":[[0,0,0]],"colour":3}}})"),
              HasSubstr("no key 'vertices'; by 'Vertices' did you mean 'vertices'? a trace needs"));
  ordered_json frame = ordered_json::parse(to_json_line(sample_frame()));
  frame["contacts"] = frame["pairs"];
  frame.erase("pairs");
  EXPECT_THAT(complaint(header_line() + frame.dump()),
              HasSubstr("no key 'pairs'; by 'contacts' did you mean 'pairs'? a trace needs it"));
  frame["pairs"] = frame["contacts"];
  frame["poses"]["zebra"] = {{"position", {0, 0, 0}}, {"quaternion", {1, 0, 0, 0}}};
  EXPECT_THAT(complaint(header_line() + frame.dump()),
              HasSubstr("no key 'quat_wxyz'; by 'quaternion' did you mean 'quat_wxyz'? a trace"));
  frame["poses"]["zebra"] = {{"position", {0, 0, 0}}, {"quat_xyzw", {0, 0, 0, 1}}};
  EXPECT_THAT(
      complaint(header_line() + frame.dump()),
      HasSubstr("by 'quat_xyzw' did you mean 'quat_wxyz'? write w first; a trace needs it"));
  frame["poses"].erase("zebra");
  ordered_json& point = frame["pairs"][0]["manifolds"][0]["points"][0];
  point.erase("separation");
  point["depth"] = 0.01;
  EXPECT_THAT(complaint(header_line() + frame.dump()),
              HasSubstr("by 'depth' did you mean 'separation'? write separation = -depth, which"));
  frame["bodies"] = frame["poses"];
  frame.erase("poses");
  EXPECT_THAT(complaint(header_line() + frame.dump()),
              HasSubstr("no key 'poses'; by 'bodies' did you mean 'poses'? a trace needs it"));
}

TEST(ReadTrace, ABoxWithHalfExtentsAndASphereWithARadiusNeedNoVertices) {
  std::istringstream in(
      R"({"schema":"contactscope.trace/1","scenario":"a/b","scalar":"float","up":"y","shapes":{)"
      R"("box":{"type":"box","half_extents":[1,2,3]},"ball":{"type":"sphere","radius":0.5},)"
      R"("floor":{"type":"plane","half_space":{"normal":[0,1,0],"offset":0}}}})");
  const Header header = TraceReader(in, "run.jsonl").header();
  ASSERT_EQ(header.shapes.size(), 3u);
  ASSERT_EQ(header.shapes[0].vertices.size(), 8u);
  for (const Vec3d& vertex : header.shapes[0].vertices)
    EXPECT_EQ(vertex.cwiseAbs(), Vec3d(1, 2, 3));
  EXPECT_NE(header.shapes[0].vertices[0], header.shapes[0].vertices[7]);
  EXPECT_EQ(header.shapes[1].vertices, std::vector<Vec3d>{Vec3d::Zero()});
  EXPECT_TRUE(header.shapes[2].vertices.empty());
}

TEST(ReadTrace, BrokenJsonIsNamedByLineAndColumn) {
  EXPECT_THAT(complaint(header_line() + "{\"frame\":0,,}"), StartsWith("run.jsonl:2:12: "));
  EXPECT_THAT(complaint("garbage"), StartsWith("run.jsonl:1:1: this line is not valid JSON"));
  EXPECT_THAT(complaint(to_json_line(sample_header()).substr(0, 40)),
              StartsWith("run.jsonl:1:41: "));
  EXPECT_THAT(complaint(header_line() + "\xff\xfe"), StartsWith("run.jsonl:2:1: "));
  EXPECT_THAT(complaint(std::string(100000, '[')), StartsWith("run.jsonl:1:100001: "));
  EXPECT_THAT(complaint("{\"schema\": 1e999}"), StartsWith("run.jsonl:1:1: "));
}

TEST(ReadTrace, InvalidJsonIsReported) {
  const auto frame = [](const std::string& time) {
    return header_line() + "{\"frame\":0,\"time\":" + time + "}\n";
  };
  for (const char* number : {"NaN", "nan", "-nan", "Infinity", "-inf"})
    EXPECT_THAT(complaint(frame(number)), HasSubstr("no nan and no infinity")) << number;
  EXPECT_THAT(complaint(frame("-,1")), HasSubstr("if it is cut off"));
  EXPECT_THAT(complaint(frame("1e999")), HasSubstr("too large for a double: '1e999'"));
  EXPECT_THAT(complaint(header_line() + "{\"na\xefme\":0}\n"), HasSubstr("is not UTF-8"));
  EXPECT_THAT(complaint("\x1f\x8b\x08\x01\x02"), HasSubstr("compressed"));
  EXPECT_THAT(complaint("\xff\xfe{"), HasSubstr("UTF-16"));
  EXPECT_THAT(complaint(header_line() + header_line()), HasSubstr(":2:1: this is a second header"));
}

/// The fast parser rejects some valid spellings of JSON; they must be read all the same.
TEST(ReadTrace, RareSpellingsOfJsonAreRead) {
  const std::string frame = to_json_line(sample_frame());
  const auto with = [&](const std::string& more) {
    std::istringstream in("\xef\xbb\xbf" + header_line() + "{" + more + frame.substr(1));
    Trace trace = read_trace(in, "run.jsonl");
    trace.frames.at(0).line = 0;
    return trace.frames.at(0);
  };
  EXPECT_EQ(to_json_line(with("")), frame);
  EXPECT_EQ(to_json_line(with("\"more\":123456789012345678901234567890,")), frame);
  EXPECT_EQ(to_json_line(with("\"more\":\"\\ud83d\\ude00\",")), frame);
  EXPECT_EQ(to_json_line(with("\"frame\":99999,\"poses\":[],")), frame) << "the last one holds";
  EXPECT_THAT(complaint(header_line() + "{\"more\":\"\\udc00\"," + frame.substr(1)),
              HasSubstr(":2:15: this line is not valid JSON"));
}

TEST(ReadTrace, ListsInListsWithoutEndAreRefused) {
  for (const int depth : {1100, 100000, 2000000}) {
    const std::string lists = std::string(static_cast<std::size_t>(depth), '[') +
                              std::string(static_cast<std::size_t>(depth), ']');
    EXPECT_THAT(
        complaint(header_line() + "{\"more\":" + lists + ",\"number\":18446744073709551616}"),
        HasSubstr("run.jsonl:2:1: lists and objects are nested more than 1000 deep"));
  }
  EXPECT_THAT(complaint(header_line() + "{\"more\":\"" + std::string(2000, '[') +
                        "\\\"[\",\"number\":18446744073709551616}"),
              HasSubstr("has no key 'frame'"));
}

/// A process that dies leaves half a line: everything before it is read.
TEST(TraceReader, EndsWhereTheLastLineIsCutOff) {
  const std::string frame = to_json_line(sample_frame());
  const std::string whole = header_line() + frame + "\n";
  for (const std::size_t left :
       {std::size_t(1), std::size_t(10), frame.size() / 2, frame.size() - 1}) {
    std::istringstream in(whole + frame.substr(0, left));
    TraceReader reader(in, "run.jsonl");
    EXPECT_TRUE(reader.next().has_value());
    EXPECT_FALSE(reader.torn().has_value());
    EXPECT_FALSE(reader.next().has_value());
    ASSERT_TRUE(reader.torn().has_value()) << left;
    EXPECT_EQ(reader.torn()->line, 3);
    EXPECT_EQ(reader.torn()->column, static_cast<int>(left) + 1);
    EXPECT_FALSE(reader.next().has_value());
  }
  EXPECT_THAT(complaint(whole + frame.substr(0, 10)), StartsWith("run.jsonl:3:11: "));
  // A line with an end was completely written.
  std::istringstream in(whole + frame.substr(0, 10) + "\n");
  TraceReader reader(in, "run.jsonl");
  EXPECT_TRUE(reader.next().has_value());
  EXPECT_THROW(reader.next(), InputError);
}

TEST(TraceReader, ReadsAgainFromTheFirstFrameAndPassesOverOthers) {
  Frame frame = sample_frame();
  std::string text = header_line();
  for (const int number : {4, 5, 6}) {
    frame.frame = number;
    text += "\n" + to_json_line(frame) + "\n";
  }
  std::istringstream in(text);
  TraceReader reader(in, "run.jsonl");
  while (reader.next()) continue;
  reader.rewind();
  EXPECT_TRUE(reader.skip());
  EXPECT_EQ(reader.next()->frame, 5);
  EXPECT_EQ(reader.next()->line, 7);
  EXPECT_FALSE(reader.skip());
}

TEST(ReadTrace, AnEmptyFileNeedsAHeader) {
  EXPECT_THAT(complaint(""), HasSubstr("run.jsonl: the trace is empty"));
  EXPECT_THAT(complaint("\n  \n"), HasSubstr("contactscope.trace/1"));
}

TEST(ReadTrace, AnotherSchemaIsRefused) {
  ordered_json header = ordered_json::parse(to_json_line(sample_header()));
  header["schema"] = "contactscope.trace/2";
  EXPECT_THAT(complaint(header.dump()),
              HasSubstr("'schema' is 'contactscope.trace/2'; only 'contactscope.trace/1' can be "
                        "read: update contactscope"));
  EXPECT_THAT(complaint(to_json_line(sample_frame())), HasSubstr("has no key 'schema'"));
}

TEST(ReadTrace, AMissingKeyIsNamedWithItsPlace) {
  EXPECT_THAT(complaint(frame_without("/pairs/0/manifolds/1", "normal")),
              HasSubstr("run.jsonl:2:1: 'pairs[0].manifolds[1]' has no key 'normal'"));
  EXPECT_THAT(complaint(frame_without("", "poses")), HasSubstr("has no key 'poses'"));
}

/// Facts that follow from others may be omitted.
TEST(ReadTrace, DerivedValuesAreFilledIn) {
  std::istringstream in(
      R"({"schema":"contactscope.trace/1","scenario":"mine/stack","scalar":"float","up":"y","engine":"Mine","version":"2.1",)"
      R"("poses_at":"after_step","shapes":{"floor":{"type":"plane","vertices":[],"half_space":{"normal":[0,1,0],"offset":0}},)"
      R"("crate":{"type":"box","vertices":[[0,0,0],[1,0,0],[0,1,0],[0,0,1]]}}})"
      "\n"
      R"({"frame":7,"time":0.1,"poses":{},"pairs":[{"a":"floor","b":"crate","manifolds":[{"normal":[0,1,0],"points":[)"
      R"({"position":[0,0,0],"separation":-0.25,"on_a":[0,0,0],"on_b":[0,-0.25,0]},{"position":[1,0,0],"separation":0.5,"active":false}]}]},)"
      R"({"a":"crate","b":"floor","manifolds":[]}]})");
  const Trace trace = read_trace(in, "run.jsonl");
  EXPECT_EQ(trace.header.engine, "Mine");
  EXPECT_EQ(trace.header.version, "2.1");
  EXPECT_EQ(trace.header.poses_at, "after_step");
  EXPECT_EQ(trace.header.frames, 8);
  const Pair& touching = trace.frames.at(0).pairs.at(0);
  EXPECT_EQ(touching.kind, "plane-hull");
  EXPECT_EQ(touching.state, "touching");
  EXPECT_EQ(touching.separation, -0.25);
  EXPECT_EQ(touching.manifolds.at(0).axis, "");
  EXPECT_EQ(touching.manifolds[0].points.at(0).on_b.value(), Vec3d(0, -0.25, 0));
  EXPECT_TRUE(touching.manifolds[0].points[0].active);
  EXPECT_FALSE(touching.manifolds[0].points.at(1).active);
  const Pair& separated = trace.frames[0].pairs.at(1);
  EXPECT_EQ(separated.kind, "hull-plane");
  EXPECT_EQ(separated.state, "separated");
  EXPECT_EQ(separated.separation, 0);
}

TEST(ReadTrace, AWrongTypeIsNamedWithItsPlace) {
  EXPECT_THAT(complaint(frame_with("/pairs/0/sat/face_b/separation", "deep")),
              HasSubstr("'pairs[0].sat.face_b.separation' is of type string; a number"));
  EXPECT_THAT(complaint(frame_with("/frame", 1.5)), HasSubstr("'frame' is of type number"));
  EXPECT_THAT(complaint(frame_with("/frame", 18446744073709551615u)),
              HasSubstr("'frame' is out of range"));
  EXPECT_THAT(complaint(frame_with("/frame", -5000000000)), HasSubstr("'frame' is out of range"));
  EXPECT_THAT(complaint(frame_with("/pairs", ordered_json::object())),
              HasSubstr("'pairs' is of type object; an array"));
  EXPECT_THAT(complaint(frame_with("/poses/zebra", 3)), HasSubstr("'poses.zebra' is of type"));
  EXPECT_THAT(complaint(frame_with("/poses/zebra/quat_wxyz", {1, 0, 0})),
              HasSubstr("needs four numbers"));
  EXPECT_THAT(complaint(frame_with("/pairs/0/manifolds/0/normal", {0, 1})),
              HasSubstr("must have three numbers"));
  EXPECT_THAT(complaint(header_line() + "[]"), HasSubstr("the line is of type array"));
}

TEST(ReadTrace, AnIndexOutOfRangeIsRefused) {
  EXPECT_THAT(complaint(frame_with("/pairs/0/reduction/kept/0", 2)),
              HasSubstr("'pairs[0].reduction.kept[0]' is 2, but there are 2 points"));
  ordered_json header = ordered_json::parse(to_json_line(sample_header()));
  header["shapes"]["apple"]["faces"][0][0] = 4;
  EXPECT_THAT(complaint(header.dump()), HasSubstr("is 4, but there are 4 vertices"));
  header["shapes"]["apple"]["faces"][0][0] = -1;
  EXPECT_THAT(complaint(header.dump()), HasSubstr("is -1, but there are 4 vertices"));
}

TEST(ReadTrace, AnIndexOfTheBestPolygonOrOfAChoiceIsCheckedToo) {
  EXPECT_THAT(complaint(frame_with("/pairs/0/reduction/best/1", 2)),
              HasSubstr("'pairs[0].reduction.best[1]' is 2, but there are 2 points"));
  EXPECT_THAT(complaint(frame_with("/pairs/0/reduction/best", "all")),
              HasSubstr("'pairs[0].reduction.best' is of type string; an array"));
  const std::string measure = "/pairs/0/reduction/choices/1/measures/0";
  const std::string place = "'pairs[0].reduction.choices[1].measures[0].";
  EXPECT_THAT(complaint(frame_with((measure + "/point").c_str(), -1)),
              HasSubstr(place + "point' is -1, but there are 2 points"));
  EXPECT_THAT(complaint(frame_with((measure + "/edge/0").c_str(), 7)),
              HasSubstr(place + "edge[0]' is 7, but there are 2 points"));
  EXPECT_THAT(complaint(frame_with((measure + "/edge").c_str(), {1, 0, 1})),
              HasSubstr(place + "edge' must have 2 indices"));
  EXPECT_THAT(complaint(frame_with((measure + "/value").c_str(), "much")),
              HasSubstr(place + "value' is of type string; a number"));
  EXPECT_THAT(complaint(frame_without("/pairs/0/reduction/choices/0", "rule")),
              HasSubstr("'pairs[0].reduction.choices[0]' has no key 'rule'"));
  EXPECT_THAT(complaint(frame_without("/pairs/0/reduction/choices/0", "measures")),
              HasSubstr("'pairs[0].reduction.choices[0]' has no key 'measures'"));
}

TEST(ReadTrace, ATraceWithUnknownKeysIsRead) {
  ordered_json frame = ordered_json::parse(to_json_line(sample_frame()));
  frame["engine"] = "another";
  frame["pairs"][0]["epa"] = {{"iterations", 7}};
  std::istringstream in(header_line() + frame.dump());
  const Trace trace = read_trace(in, "run.jsonl");
  ASSERT_EQ(trace.frames.size(), 1u);
  EXPECT_EQ(to_json_line(trace.frames[0]), to_json_line(sample_frame()));
}

TEST(ReadTrace, EdgesThatAreNotGivenRunAlongTheFaces) {
  ordered_json header = ordered_json::parse(to_json_line(sample_header()));
  header["shapes"]["zebra"].erase("edges");
  std::istringstream in(header.dump() + "\n\n" + to_json_line(sample_frame()) + "\r\n");
  const Trace trace = read_trace(in, "run.jsonl");
  EXPECT_EQ(trace.header.shapes.at(0).edges.size(), 6u);  // of the tetrahedron
  EXPECT_EQ(trace.frames.size(), 1u);
}

TEST(ReadTrace, ARuleThatMeasuresAgainstEdgesNeedsThem) {
  EXPECT_THAT(complaint(frame_without("/pairs/0/reduction/choices/1/measures/0", "edge")),
              HasSubstr("'pairs[0].reduction.choices[1].measures[0]' has no key 'edge'"));
}

TEST(ReadTrace, FramesKeepTheirOrder) {
  Frame frame = sample_frame();
  std::string text = header_line();
  for (const int number : {7, 3, 5}) {
    frame.frame = number;
    text += to_json_line(frame) + "\n";
  }
  std::istringstream in(text);
  const Trace trace = read_trace(in, "run.jsonl");
  ASSERT_EQ(trace.frames.size(), 3u);
  EXPECT_EQ(trace.frames[0].frame, 7);
  EXPECT_EQ(trace.frames[1].frame, 3);
  EXPECT_EQ(trace.frames[2].frame, 5);
}

TEST(ReadTrace, SlowDamagedTextIsATraceOrRefusedInLinesWithTheirPlace) {
  const std::string text = header_line() + to_json_line(sample_frame()) + "\n";
  test::Random random(19);
  int refused = 0;
  const int texts = test::cases(10'000);
  for (int i = 0; i < texts; ++i) {
    const std::string message = complaint(test::damaged(text, text, random));
    if (message == "no complaint") continue;
    ++refused;
    EXPECT_LT(message.size(), 3'000u) << message;
    std::istringstream lines(message);  // several for a header
    for (std::string line; std::getline(lines, line);) {
      EXPECT_THAT(line, StartsWith("run.jsonl:"));
      EXPECT_TRUE(std::ranges::none_of(line, [](char c) { return c >= 0 && c < ' '; })) << line;
    }
  }
  EXPECT_GT(refused, texts / 4);
  EXPECT_LT(refused, texts);
}

}  // namespace
}  // namespace contactscope::trace
