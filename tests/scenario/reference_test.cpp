#include <gmock/gmock.h>

#include <regex>
#include <set>

#include "broadphase/broad_phase.h"
#include "scenario/broken.h"
#include "scenario/run.h"
#include "scenario/scenario.h"
#include "trace/json.h"

/// The reference is built in: the reader takes keys, words and limits from it. What it cannot take from
/// there is tested here.
namespace contactscope {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// A file in which a table has the lines at '#', and its name in messages.
const std::map<std::string, std::string> kPlaces = {
    {"The file", "\ntitle = \"a\"\n#\n[shapes.s]\ntype = \"sphere\"\nradius = 1\n"},
    {"time", "title = \"a\"\n[time]\n#\n[shapes.s]\ntype = \"sphere\"\nradius = 1\n"},
    {"shapes.NAME", one_shape("type = \"sphere\"\nradius = 1\n#\n")},
    {"scatter", one_shape("type = \"sphere\"\nradius = 1\n[shapes.rock.scatter]\nlower = [0, 0, "
                          "0]\nupper = [1, 1, 1]\ncount = 2\n#\n")},
    {"Box", one_shape("type = \"box\"\nhalf_extents = [1, 1, 1]\n#\n")},
    {"Hull",
     one_shape("type = \"hull\"\nvertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]\n#\n")},
    {"Cylinder and cone",
     one_shape("type = \"cone\"\nradius = 1\nhalf_height = 1\nsegments = 8\n#\n")},
    {"Sphere", one_shape("type = \"sphere\"\nradius = 1\n#\n")},
    {"Capsule", one_shape("type = \"capsule\"\nradius = 1\nhalf_height = 1\n#\n")},
    {"Mesh", one_shape("type = \"mesh\"\ngrid = { size = 1, cells = 1 }\n#\n")},
    {"grid", one_shape("type = \"mesh\"\n[shapes.rock.grid]\nsize = 1\ncells = 1\n#\n")},
    {"Plane", one_shape("type = \"plane\"\nnormal = [0, 1, 0]\noffset = 0\n#\n")},
    {"Sdf", one_shape("type = \"sdf\"\nof = { type = \"sphere\", radius = 1 }\n#\n")},
    {"rotation", one_shape("type = \"sphere\"\nradius = 1\n[shapes.rock.rotation]\n#\n")},
    {"motion", one_shape("type = \"sphere\"\nradius = 1\n[shapes.rock.motion]\n#\n")},
    {"keyframe", one_shape("type = \"sphere\"\nradius = 1\n[[shapes.rock.motion.keyframes]]\ntime "
                           "= 0\n#\n")},
    {"deform", one_shape("type = \"mesh\"\ngrid = { size = 1, cells = 1 "
                         "}\n[shapes.rock.motion.deform]\n#\n")},
    {"wave", one_shape("type = \"mesh\"\ngrid = { size = 1, cells = 1 "
                       "}\n[shapes.rock.motion.deform.wave]\naxis = [1, 0, 0]\ndirection = [0, 1, "
                       "0]\namplitude = 1\nwavelength = 1\nspeed = 1\n#\n")},
    {"twist", one_shape("type = \"mesh\"\ngrid = { size = 1, cells = 1 "
                        "}\n[shapes.rock.motion.deform.twist]\naxis = [1, 0, 0]\n#\n")},
    {"keyframe of deform", one_shape("type = \"mesh\"\ngrid = { size = 1, cells = 1 "
                                     "}\n[[shapes.rock.motion.deform.keyframes]]\ntime = 0\n#\n")},
    {"pairs", two_boxes("[[pairs]]\na = \"crate\"\nb = \"floor\"\n#\n")},
    {"patch", "[[patch]]\nnormal = [0, 1, 0]\npoints = [[0, 0, 0, 0]]\n#\n"},
    {"pipeline", two_boxes("[pipeline]\n#\n")},
    {"world", two_boxes("[world]\n#\n")},
    {"solver", two_boxes("[solver]\n#\n")},
    {"views", two_boxes("[[views]]\n#\n")},
    {"expect", two_boxes("motion = { dynamic = true, mass = 1 }\n[pipeline]\ncontinuous = "
                         "\"speculative\"\n[[expect]]\na = \"crate\"\nb = \"floor\"\n#\n")},
    {"snapshots", two_boxes("[snapshots]\n#\n")},
    {"limits", two_boxes("[snapshots.limits]\n#\n")},
};

/// The file with `line` in a table, in place of the line with the same key.
std::string file_with(const std::string& table, const std::string& key, const std::string& line) {
  if (table == "The file" && key == "shapes") return "title = \"a\"\n" + line;
  std::string file = kPlaces.at(table);
  const std::size_t mark = file.find('#');
  const std::size_t heading = file.rfind("\n[", mark);
  const std::size_t begin = heading == std::string::npos ? 0 : heading;
  const std::string lines = std::regex_replace(file.substr(begin, mark - begin),
                                               std::regex("\n" + key + " = [^\n]*"), "");
  file.replace(begin, mark - begin, lines);
  if (table == "rotation" && (key == "degrees" || key == "radians"))
    return file.replace(file.find('#'), 1, "axis = [0, 1, 0]\n" + line);
  if (table == "views" && key == "choices")
    return file.replace(file.find('#'), 1, "kind = \"contact_plane\"\n" + line);
  return file.replace(file.find('#'), 1, line);
}

// A key that nothing reads would be accepted, and have no effect.
TEST(ScenarioReference, EveryKeyIsReadWithItsType) {
  int keys = 0;
  for (const KeyTable& table : scenario_file::key_tables()) {
    ASSERT_TRUE(kPlaces.contains(table.name)) << table.name;
    for (const Key& row : table.keys) {
      const std::string key(row.name);
      const std::string message = complaint(file_with(table.name, key, key + " = 1979-05-27"));
      EXPECT_THAT(message, ::testing::AnyOf(HasSubstr("'" + key + "'"), HasSubstr("[" + key + "]"),
                                            HasSubstr("[[" + key + "]]")))
          << table.name << ": " << message;
      EXPECT_THAT(message, Not(HasSubstr("unknown key"))) << table.name;
      ++keys;
    }
  }
  EXPECT_GT(keys, 150);
}

TEST(ScenarioReference, LimitsAndWordsOfEveryKeyAreThoseOfTheReader) {
  int limits = 0, words = 0;
  for (const KeyTable& table : scenario_file::key_tables()) {
    for (const Key& row : table.keys) {
      const std::string key(row.name);
      if (!row.words.empty() && row.type.find("or `") == std::string_view::npos) {
        EXPECT_THAT(complaint(file_with(table.name, key, key + " = \"qqqqqq\"")),
                    HasSubstr("'qqqqqq'; known: '" + std::string(row.words.front()) + "'"))
            << table.name;
        ++words;
      }
      const bool is_one_number = !row.range.empty() && row.type.starts_with(row.range);
      if (!is_one_number || key == "intersections" || row.high > 1e15) continue;
      const bool is_integer = row.high == 1e9 && key == "seed";
      const std::string beyond =
          is_integer ? "1000000001" : std::to_string(static_cast<long long>(row.high) + 1);
      EXPECT_THAT(complaint(file_with(table.name, key, key + " = " + beyond)),
                  HasSubstr("'" + key + "' is "))
          << table.name << " " << row.type;
      ++limits;
    }
  }
  EXPECT_GT(limits, 40);
  EXPECT_GT(words, 20);
}

/// The trace of three frames in which a box falls onto another one.
std::string trace_of(const std::string& tables) {
  const Scenario scenario = parse_scenario(
      "title = \"a\"\n[time]\nframes = 3\n[shapes.floor]\ntype = \"box\"\nhalf_extents = [1, 1, "
      "1]\n[shapes.crate]\ntype = \"box\"\nhalf_extents = [0.5, 0.5, 0.5]\nposition = [0, 1.49, "
      "0]\nmotion = { dynamic = true, mass = 1 }\n" +
          tables,
      "group/idea.toml");
  Runner runner(scenario);
  std::string text = trace::to_json_line(runner.header());
  for (int i = 0; i < scenario.frames; ++i) text += trace::to_json_line(runner.frame(i));
  return text;
}

TEST(ScenarioReference, DefaultsAreThoseOfTheReader) {
  std::string tables;
  int defaults = 0;
  for (const char* name : {"pipeline", "world", "solver"}) {
    tables += std::string("[") + name + "]\n";
    for (const Key& row : scenario_file::key_table(name).keys) {
      const std::string value = plain(row.otherwise);
      if (!std::regex_match(value, std::regex("\"[a-z_-]+\"|true|false|[0-9.e-]+"))) continue;
      tables += std::string(row.name) + " = " + value + "\n";
      ++defaults;
    }
  }
  EXPECT_GT(defaults, 25);
  EXPECT_EQ(trace_of(""), trace_of(tables));
  const PipelineSettings given = parse_scenario(two_boxes(tables), "group/idea.toml").pipeline;
  EXPECT_TRUE(given == parse_scenario(two_boxes(), "group/idea.toml").pipeline);
}

TEST(ScenarioReference, WordsOfMethodsAreThoseOfTheirLists) {
  const auto words_of = [](const char* table, const char* key) {
    return scenario_file::key_table(table).find(key)->words;
  };
  std::vector<std::string_view> phases, methods{"discrete"};
  for (const BroadPhaseInfo& info : broad_phases()) phases.push_back(info.name);
  for (const ImpactMethodInfo& info : impact_methods()) {
    EXPECT_EQ(static_cast<std::size_t>(info.method) + 1, methods.size());
    methods.push_back(info.name);
  }
  EXPECT_EQ(words_of("world", "broad_phase"), phases);
  EXPECT_EQ(words_of("pipeline", "continuous"), methods);
}

class ForeignKey : public ::testing::TestWithParam<Broken> {};

TEST_P(ForeignKey, IsNamedWithItsPlace) {
  EXPECT_THAT(
      complaint(GetParam().text),
      ::testing::AllOf(::testing::StartsWith(std::string("group/idea.toml:") + GetParam().location),
                       HasSubstr(GetParam().remedy)));
}

// Words of other programs, and keys at another place.
INSTANTIATE_TEST_SUITE_P(
    Meaning, ForeignKey,
    ::testing::Values(
        Broken{"MassOfAShape", one_shape("type = \"sphere\"\nradius = 1\nmass = 5"), "5:1",
               "unknown key 'mass'; write motion = { dynamic = true, mass = 5 }"},
        Broken{"VelocityOfAShape", one_shape("type = \"sphere\"\nradius = 1\nvelocity = [1, 0, 0]"),
               "5:1", "unknown key 'velocity'; write motion = { velocity = "},
        Broken{"GravityOfTheSolver", two_boxes("[solver]\ngravity = [0, -1, 0]"), "9:1",
               "unknown key 'gravity'; it belongs in [world]"},
        Broken{"AngleOfAKeyframe", two_boxes("motion = { keyframes = [{ time = 0, angle = 30 }] }"),
               "8:37", "unknown key 'angle'; write rotation = { axis = [0, 1, 0], degrees = 30 }"},
        Broken{"OneHalfExtent", one_shape("type = \"box\"\nhalf_extents = 0.5"), "4:16",
               "'half_extents' is one number; give 3, as [0.5, ..]"},
        Broken{"ContactPointsOfAView", two_boxes("[[views]]\nlayers = [\"contact_points\"]"),
               "9:11", "unknown layer 'contact_points'; did you mean 'contacts'?"},
        Broken{"CubeOfAShape", one_shape("type = \"cube\""), "3:8",
               "unknown type 'cube'; did you mean 'box'?"},
        Broken{"TimestepOfTheFile", two_boxes("[time]\ntimestep = 0.1"), "9:1",
               "unknown key 'timestep'; did you mean 'dt'?"}),
    name_of_test);

}  // namespace
}  // namespace contactscope
