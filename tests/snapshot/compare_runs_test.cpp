#include "snapshot/compare_runs.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <sstream>

#include "scenario/run.h"
#include "support/cases.h"

namespace contactscope::snapshot {
namespace {

using Json = nlohmann::ordered_json;
using testing::HasSubstr;
using testing::SizeIs;

/// A trace of this program, as lines: two crates that fall and slide on a floor, with a solver.
struct Recorded {
  Recorded() {
    const Scenario scenario = parse_scenario(R"(title = "two crates"
[shapes.floor]
type = "box"
half_extents = [4.0, 0.2, 4.0]
position = [0.0, -0.2, 0.0]
[shapes.crate]
type = "box"
half_extents = [0.5, 0.4, 0.5]
position = [0.1, 0.399, 0.2]
motion = { dynamic = true, mass = 10, velocity = [1.0, 0.0, 0.3] }
[shapes.lid]
type = "box"
half_extents = [0.4, 0.1, 0.4]
position = [0.3, 0.898, 0.2]
motion = { dynamic = true, mass = 2 }
[time]
frames = 12
[[views]]
layers = ["shapes"]
)",
                                             "test/crates.toml");
    Runner runner(scenario);
    header = trace::to_json_line(runner.header());
    for (int frame = 0; frame < scenario.frames; ++frame)
      frames.push_back(trace::to_json_line(runner.frame(frame)));
  }

  std::string header;
  std::vector<std::string> frames;
};

const Recorded& recorded() {
  static const Recorded once;
  return once;
}

RunComparison compare(const std::vector<std::string>& a, const std::vector<std::string>& b,
                      const std::string& header_of_b = recorded().header) {
  std::stringstream one(recorded().header + '\n'), other(header_of_b + '\n');
  const auto write = [](std::stringstream& to, const std::vector<std::string>& lines) {
    to.seekp(0, std::ios::end);
    for (const std::string& line : lines) to << line << '\n';
  };
  write(one, a);
  write(other, b);
  trace::TraceReader first(one, "a.jsonl"), second(other, "b.jsonl");
  Workers workers(2);
  return compare_runs(first, second, workers);
}

/// A place for a wrong value, and what a comparison has to report of it.
struct Place {
  std::string path;     // JSON pointer
  std::string subject;  // pair or shape
  std::string_view stage;
};

/// Stages by the start of a path in a pair: written here once more, by what the keys mean.
std::string_view stage_in_pair(const std::string& path) {
  const std::pair<const char*, const char*> kStages[] = {{"/cache", "cache"},
                                                         {"/sat/face", "axes"},
                                                         {"/sat/edge", "axes"},
                                                         {"/clip/reference", "faces"},
                                                         {"/clip/incident", "faces"},
                                                         {"/clip", "clipping"},
                                                         {"/reduction", "reduction"},
                                                         {"/manifolds/0/normal", "manifold"},
                                                         {"/manifolds/0/axis", "manifold"}};
  for (const auto& [start, stage] : kStages)
    if (path.starts_with(start)) return stage;
  if (path.starts_with("/manifolds/0/points/")) {
    const std::string key = path.substr(path.find('/', 20) + 1);
    if (key.starts_with("position") || key == "separation") return "points";
    if (key == "id") return "ids";
    if (key.starts_with("impulse") || key.starts_with("relative")) return "solver";
  }
  return path == "/separation" ? "answers" : "";
}

/// All places of a frame where a number that is not an index, or a text, can be changed.
std::vector<Place> places_of(const Json& frame) {
  std::vector<Place> places;
  const Json flat = frame.flatten();
  for (const auto& item : flat.items()) {
    const std::string path = item.key();
    const Json& value = item.value();
    if (!value.is_number_float() && !value.is_string()) continue;
    Place place{path, "", ""};
    const auto part = [&](std::size_t begin) {
      return path.substr(begin, path.find('/', begin) - begin);
    };
    if (path.starts_with("/poses/")) {
      place = {path, part(7), "poses"};
    } else if (path.starts_with("/solver/bodies/")) {
      place = {path, part(15), "solver"};
    } else if (path.starts_with("/totals/")) {
      place.stage = "sums";
    } else if (path.starts_with("/pairs/")) {
      const std::string number = part(7);
      const Json& pair = frame["pairs"][std::stoul(number)];
      const std::string rest = path.substr(7 + number.size());
      if (value.is_string() && !rest.ends_with("/id") && rest != "/manifolds/0/axis") continue;
      place.subject = std::string(pair["a"]) + "-" + std::string(pair["b"]);
      place.stage = stage_in_pair(rest);
    }
    if (!place.stage.empty()) places.push_back(place);
  }
  return places;
}

void change(Json& value) {
  if (value.is_string())
    value = value == "face_a" ? "face_b" : "a:f" + std::to_string(std::string(value).size());
  else
    value = 1.01 * double(value) + 0.002;
}

TEST(CompareRuns, HundredPlantedDivergencesAreFound) {
  const std::vector<std::string>& lines = recorded().frames;
  std::mt19937 random(7);
  const auto below = [&](std::size_t count) { return random() % count; };
  std::set<std::string_view> stages;
  for (int run = 0; run < test::cases(100); ++run) {
    std::vector<std::string> other = lines;
    const std::size_t at = below(lines.size());
    Json frame = Json::parse(lines[at]);
    std::vector<Place> places = places_of(frame);
    // A stage first, so that none is rare.
    std::set<std::string_view> there;
    for (const Place& place : places) there.insert(place.stage);
    const std::string_view stage = *std::next(there.begin(), std::ptrdiff_t(below(there.size())));
    std::erase_if(places, [&](const Place& place) { return place.stage != stage; });
    const Place place = places[below(places.size())];
    change(frame[Json::json_pointer(place.path)]);
    other[at] = frame.dump();
    for (std::size_t later = at + 1; later < lines.size() && run % 2 == 1; ++later) {
      frame = Json::parse(lines[later]);
      for (const Place& one : places_of(frame)) change(frame[Json::json_pointer(one.path)]);
      other[later] = frame.dump();
    }
    const RunComparison runs = compare(lines, other);
    ASSERT_TRUE(runs.parting) << place.path;
    EXPECT_EQ(runs.parting->frame, int(at)) << place.path;
    EXPECT_EQ(runs.parting->subject, place.subject) << place.path << runs.parting->chain;
    EXPECT_EQ(name_of(runs.parting->stage), place.stage) << place.path << runs.parting->chain;
    EXPECT_EQ(runs.a.empty(), place.subject.find('-') == std::string::npos);
    EXPECT_EQ(runs.equal, int(run % 2 == 1 ? at : lines.size() - 1));
    stages.insert(stage);
  }
  EXPECT_GE(stages.size(), 10u / unsigned{test::kOneIn}) << testing::PrintToString(stages);
}

TEST(CompareRuns, OrderAndRoundingAreNoDifference) {
  std::vector<std::string> other = recorded().frames;
  for (std::string& line : other) {
    Json frame = Json::parse(line), turned = Json::object();
    std::reverse(frame["pairs"].begin(), frame["pairs"].end());
    for (const char* name : {"lid", "crate", "floor"}) turned[name] = frame["poses"][name];
    frame["poses"] = turned;
    line = frame.dump();
  }
  Json frame = Json::parse(other[4]);
  double& x = frame["poses"]["lid"]["position"][0].get_ref<double&>();
  x += 1e-7;
  other[4] = frame.dump();
  const RunComparison runs = compare(recorded().frames, other);
  EXPECT_FALSE(runs.parting) << runs.parting->chain;
  EXPECT_THAT(runs.distances, SizeIs(12));
  EXPECT_EQ(runs.rounding, 0);
  EXPECT_NEAR(runs.distances[4].metres, 1e-7, 1e-9);
  EXPECT_EQ(runs.distances[4].shape, "lid");
}

TEST(CompareRuns, PairsMatchWithTheirShapesSwapped) {
  std::stringstream text(recorded().header + '\n' + recorded().frames[3] + '\n');
  trace::Trace swapped = trace::read_trace(text, "a.jsonl");
  for (trace::Pair& pair : swapped.frames[0].pairs) trace::mirror(pair);
  std::vector<std::string> other = recorded().frames;
  other[3] = trace::to_json_line(swapped.frames[0]);
  ASSERT_NE(other[3], recorded().frames[3]);
  EXPECT_FALSE(compare(recorded().frames, other).parting);
  swapped.frames[0].pairs[0].manifolds[0].normal = -swapped.frames[0].pairs[0].manifolds[0].normal;
  other[3] = trace::to_json_line(swapped.frames[0]);
  const RunComparison runs = compare(recorded().frames, other);
  ASSERT_TRUE(runs.parting);
  EXPECT_EQ(runs.parting->stage, Stage::Manifold);
  EXPECT_THAT(runs.parting->what, HasSubstr("normal flipped"));
}

TEST(CompareRuns, FramesOfOneRunAndWordsOfTheHeaderAreNoted) {
  std::vector<std::string> other = recorded().frames;
  other.erase(other.begin() + 2);
  other.pop_back();
  Json header = Json::parse(recorded().header);
  header["version"] = "2.0";
  header["scalar"] = "double";
  const RunComparison runs = compare(recorded().frames, other, header.dump());
  EXPECT_FALSE(runs.parting);
  EXPECT_EQ(runs.alone, (std::array{2, 0}));
  EXPECT_EQ(runs.equal, 10);
  EXPECT_THAT(runs.notes, testing::ElementsAre("scalar float -> double", "version (none) -> 2.0"));

  header["shapes"]["lid"]["vertices"][0][0] = -0.5;
  const RunComparison of_shapes = compare(recorded().frames, other, header.dump());
  ASSERT_TRUE(of_shapes.header);
  EXPECT_EQ(of_shapes.header->frame, -1);
  EXPECT_EQ(of_shapes.header->subject, "lid");
  EXPECT_FALSE(of_shapes.parting);
}

TEST(CompareRuns, ASettingOfTheSolverIsNamedBeforeThePairThatItChanges) {
  std::vector<std::string> other = recorded().frames;
  for (std::string& line : other) {
    Json frame = Json::parse(line);
    frame["solver"]["iterations"] = 3;
    line = frame.dump();
  }
  const RunComparison of_setting = compare(recorded().frames, other);
  ASSERT_TRUE(of_setting.setting);
  EXPECT_THAT(of_setting.setting->what, HasSubstr("iterations 10 -> 3"));
  EXPECT_EQ(of_setting.setting->chain, of_setting.setting->what);
  EXPECT_FALSE(of_setting.parting);
  Json frame = Json::parse(other[5]);
  for (Json& pair : frame["pairs"])
    if (pair["a"] == "crate" && pair["b"] == "lid")
      change(pair["manifolds"][0]["points"][0]["separation"]);
  other[5] = frame.dump();
  Json header = Json::parse(recorded().header);
  header["shapes"]["lid"]["vertices"][0][0] = -0.5;
  const RunComparison runs = compare(recorded().frames, other, header.dump());
  ASSERT_TRUE(runs.header && runs.setting && runs.parting) << "headers and frames differ";
  EXPECT_EQ(runs.setting->frame, 0);
  EXPECT_EQ(runs.parting->frame, 5);
  EXPECT_EQ(runs.parting->subject, "crate-lid");
  EXPECT_EQ(runs.parting->stage, Stage::Points);
  EXPECT_EQ(runs.a, "crate");
  EXPECT_EQ(runs.frames[1].frame, 5);
}

}  // namespace
}  // namespace contactscope::snapshot
