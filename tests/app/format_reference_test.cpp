#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>

#include "core/input_error.h"
#include "scenario/run.h"
#include "scenario/scenario.h"
#include "support/temporary_folder.h"
#include "trace/json.h"

/// Compares the formats' references with the parser. Its errors name the known keys if a key is
/// unknown, and the known values of a key if a value is.
namespace contactscope::test {
namespace {

using testing::HasSubstr;

std::string file_text(const char* path) {
  return read_text(std::string(CONTACTSCOPE_SOURCE_DIR) + "/" + path);
}

/// The lines from a heading to the next one of the same level.
std::string section(const std::string& text, const std::string& heading) {
  const std::size_t begin = text.find("\n" + heading + "\n");
  if (begin == std::string::npos) return {};
  const std::string mark = "\n" + heading.substr(0, heading.find(' ') + 1);
  return text.substr(begin, text.find(mark, begin + 1) - begin);
}

std::string complaint(const std::string& scenario) {
  try {
    parse_scenario(scenario, "group/idea.toml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no complaint";
}

/// The words in single quotes after "known".
std::vector<std::string> known_words(const std::string& message) {
  std::vector<std::string> words;
  const std::size_t begin = message.find("known: ");
  const std::size_t here = message.find("known keys: ");
  const std::string list = message.substr(std::min({begin, here, message.size()}));
  const std::regex quoted("'([^']*)'");
  for (std::sregex_iterator word(list.begin(), list.end(), quoted), end; word != end; ++word)
    words.push_back((*word)[1]);
  return words;
}

const std::string kTwoBoxes = R"(title = "two"
[time]
frames = 2
[shapes.a]
type = "box"
half_extents = [1, 1, 1]
[shapes.b]
type = "box"
half_extents = [1, 1, 1]
motion = { dynamic = true, mass = 1 }
)";

std::string shape(const std::string& lines) {
  return "title = \"one\"\n[shapes.s]\n" + lines + "\n";
}

std::string deforming(const std::string& how) {
  return shape("type = \"mesh\"\ngrid = { size = 1, cells = 1 }\nmotion = { deform = " + how +
               " }");
}

struct Place {
  const char* heading;
  std::string scenario;  // with the unknown key qqqqqq
};

TEST(FormatReference, NamesEveryKeyThatTheParserKnows) {
  const std::string text = file_text("scenarios/README.md");
  const std::string key = "qqqqqq = 1\n";
  const std::vector<Place> places = {
      {"## The file", key + kTwoBoxes},
      {"## `[time]`",
       "title = \"x\"\n[time]\n" + key + "[shapes.a]\ntype = \"sphere\"\nradius = 1\n"},
      {"## `[shapes.NAME]`", shape("type = \"box\"\n" + key)},
      {"### Box", shape("type = \"box\"\n" + key)},
      {"### Hull", shape("type = \"hull\"\n" + key)},
      {"### Cylinder and cone", shape("type = \"cylinder\"\n" + key)},
      {"### Cylinder and cone", shape("type = \"cone\"\n" + key)},
      {"### Sphere", shape("type = \"sphere\"\n" + key)},
      {"### Capsule", shape("type = \"capsule\"\n" + key)},
      {"### Mesh", shape("type = \"mesh\"\n" + key)},
      {"### Mesh", shape("type = \"mesh\"\ngrid = { qqqqqq = 1 }")},
      {"### Plane", shape("type = \"plane\"\n" + key)},
      {"### Sdf", shape("type = \"sdf\"\n" + key)},
      {"### `rotation`", shape("type = \"sphere\"\nradius = 1\nrotation = { qqqqqq = 1 }")},
      {"### `motion`", shape("type = \"sphere\"\nradius = 1\nmotion = { qqqqqq = 1 }")},
      {"### `motion`",
       shape("type = \"sphere\"\nradius = 1\nmotion = { dynamic = true, qqqqqq = 1 }")},
      {"### `motion`",
       shape("type = \"sphere\"\nradius = 1\nmotion = { keyframes = [ { qqqqqq = 1 } ] }")},
      {"### `deform`", deforming("{ qqqqqq = 1 }")},
      {"### `deform`", deforming("{ wave = { qqqqqq = 1 } }")},
      {"### `deform`", deforming("{ twist = { qqqqqq = 1 } }")},
      {"### `deform`", deforming("{ keyframes = [ { qqqqqq = 1 } ] }")},
      {"## `[[patch]]`", "[[patch]]\n" + key},
      {"## `[[pairs]]`", kTwoBoxes + "[[pairs]]\n" + key},
      {"## `[pipeline]`", kTwoBoxes + "[pipeline]\n" + key},
      {"## `[world]`", kTwoBoxes + "[world]\n" + key},
      {"## `[solver]`", kTwoBoxes + "[solver]\n" + key},
      {"## `[[views]]`", kTwoBoxes + "[[views]]\n" + key},
      {"## `[[expect]]`", kTwoBoxes + "[[expect]]\n" + key},
      {"## `[snapshots]`", kTwoBoxes + "[snapshots]\n" + key},
      {"## `[snapshots]`", kTwoBoxes + "[snapshots]\nlimits = { qqqqqq = 1 }\n"},
  };
  for (const Place& place : places) {
    const std::string message = complaint(place.scenario);
    EXPECT_THAT(message, HasSubstr("unknown key 'qqqqqq'")) << place.heading;
    const std::vector<std::string> keys = known_words(message);
    EXPECT_GE(keys.size(), 2u) << message;
    // Keys of every shape are under the first heading, those of a type under its own.
    const std::string here = section(text, place.heading) + section(text, "## `[shapes.NAME]`");
    ASSERT_THAT(section(text, place.heading), testing::Not(testing::IsEmpty())) << place.heading;
    for (const std::string& word : keys)
      EXPECT_THAT(here, HasSubstr("`" + word + "`")) << place.heading;
  }
}

TEST(FormatReference, NamesEveryValueThatTheParserKnows) {
  const std::string text = file_text("scenarios/README.md");
  const auto setting = [&](const char* table, const char* key) {
    return kTwoBoxes + table + "\n" + key + " = \"qqqqqq\"\n";
  };
  const std::string expect = "[[expect]]\na = \"a\"\nb = \"b\"";
  const std::vector<Place> places = {
      {"## The file", "up = \"qqqqqq\"\n" + kTwoBoxes},
      {"## `[shapes.NAME]`", shape("type = \"qqqqqq\"")},
      {"### Mesh", shape("type = \"mesh\"\ngrid = { size = 1, cells = 1 }\ntree = \"qqqqqq\"")},
      {"### Sdf", shape("type = \"sdf\"\nof = { type = \"sphere\", radius = 1 }\n"
                        "interpolation = \"qqqqqq\"")},
      {"## `[pipeline]`", setting("[pipeline]", "field")},
      {"## `[pipeline]`", setting("[pipeline]", "scalar")},
      {"## `[pipeline]`", setting("[pipeline]", "manifold")},
      {"## `[pipeline]`", setting("[pipeline]", "reducer")},
      {"## `[pipeline]`", setting("[pipeline]", "preference")},
      {"## `[pipeline]`", setting("[pipeline]", "penetration")},
      {"## `[pipeline]`", setting("[pipeline]", "degenerate")},
      {"## `[pipeline]`", setting("[pipeline]", "confirm")},
      {"## `[pipeline]`", setting("[pipeline]", "query")},
      {"## `[pipeline]`", setting("[pipeline]", "bounds")},
      {"## `[pipeline]`", setting("[pipeline]", "comparison")},
      {"## `[pipeline]`", setting("[pipeline]", "axes")},
      {"## `[solver]`", setting("[solver]", "position_correction")},
      {"## `[[views]]`", setting("[[views]]", "kind")},
      {"## `[[views]]`", setting("[[views]]", "focus")},
      {"## `[[views]]`", setting("[[views]]", "story")},
      {"## `[[views]]`", kTwoBoxes + "[[views]]\nlayers = [\"qqqqqq\"]\n"},
      {"## `[[views]]`", kTwoBoxes + "[[views]]\npanels = [\"qqqqqq\"]\n"},
      {"## `[[expect]]`", setting(expect.c_str(), "state")},
      {"## `[[expect]]`", setting(expect.c_str(), "axis")},
      {"## `[[expect]]`", setting(expect.c_str(), "type")},
  };
  for (const Place& place : places) {
    const std::string message = complaint(place.scenario);
    EXPECT_THAT(message, HasSubstr("'qqqqqq'")) << place.heading;
    const std::vector<std::string> values = known_words(message);
    EXPECT_GE(values.size(), 2u) << message;
    const std::string here = section(text, place.heading);
    for (const std::string& value : values) {
      EXPECT_THAT(here,
                  testing::AnyOf(HasSubstr("`" + value + "`"), HasSubstr("`\"" + value + "\"`")))
          << message;
    }
  }
}

/// Collects every key of an object and its descendants, without members named by a file.
void collect(const nlohmann::json& json, std::set<std::string>& keys) {
  if (json.is_array()) {
    for (const nlohmann::json& item : json) collect(item, keys);
  }
  if (!json.is_object()) return;
  for (const auto& [key, value] : json.items()) {
    keys.insert(key);
    const bool by_name = key == "shapes" || key == "poses" || key == "bodies";
    if (!by_name) collect(value, keys);
    if (!by_name) continue;
    for (const nlohmann::json& item : value) collect(item, keys);
  }
}

TEST(FormatReference, NamesEveryKeyOfTheTraces) {
  const std::string text = file_text("src/trace/README.md");
  std::set<std::string> keys;
  for (const char* name : {"hull/face_contact", "mesh/collecting_triangles", "query/epa_steps",
                           "query/gjk_steps", "round/coincident_centres", "hull/temporal_coherence",
                           "incremental/building_up", "solver/pyramid", "query/gauss_map"}) {
    const Scenario scenario =
        load_scenario(std::string(CONTACTSCOPE_SOURCE_DIR) + "/scenarios/" + name + ".toml");
    Runner runner(scenario);
    collect(nlohmann::json::parse(trace::to_json_line(runner.header())), keys);
    collect(nlohmann::json::parse(trace::to_json_line(runner.frame(0))), keys);
    collect(nlohmann::json::parse(trace::to_json_line(runner.frame(2))), keys);
  }
  EXPECT_GE(keys.size(), 80u);
  for (const std::string& key : keys) EXPECT_THAT(text, HasSubstr("`" + key + "`"));
}

}  // namespace
}  // namespace contactscope::test
