#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "app/program.h"

namespace contactscope::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

TEST(CommandLine, HelpAndVersionSucceed) {
  EXPECT_EQ(run("--help").exit_code, 0);
  EXPECT_THAT(run("--help").out, HasSubstr("render"));
  EXPECT_EQ(run("--version").exit_code, 0);
  EXPECT_THAT(run("--version").out, StartsWith("contactscope "));
}

/// The options after `before` in a text: "\n  " gives a help's own, " " also those in its words.
std::set<std::string> options_in(const std::string& text, const std::string& before) {
  const std::string mark = before + "--";
  std::set<std::string> options;
  for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at + 1)) {
    const std::size_t begin = at + before.size();
    const std::size_t end = text.find_first_not_of("abcdefghijklmnopqrstuvwxyz-", begin);
    options.insert(text.substr(begin, end - begin));
  }
  return options;
}

TEST(CommandLine, TheHelpOfEveryVerbHasExamplesValuesAndExitCodes) {
  const std::string verbs = run("--help").out;
  std::istringstream lines(verbs.substr(verbs.find("Subcommands:")));
  std::vector<std::string> names;
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line) && line.starts_with("  "))
    if (line[2] != ' ') names.push_back(line.substr(2, line.find(' ', 2) - 2));
  EXPECT_GE(names.size(), 14u) << verbs;
  for (const std::string& name : names) {
    const ProgramRun help = run("help " + name);
    EXPECT_EQ(help.exit_code, 0) << name;
    EXPECT_THAT(help.out, HasSubstr("Exit codes: 0 ")) << name;
    EXPECT_THAT(help.out, HasSubstr("2 ")) << name;
    ASSERT_THAT(help.out, HasSubstr("Examples:\n  contactscope " + name)) << name;
    const std::string before = help.out.substr(0, help.out.find("Examples:"));
    const std::string examples = help.out.substr(before.size());
    const std::set<std::string> known = options_in(before, "\n  ");
    for (const std::string& option : options_in(examples, " "))
      EXPECT_THAT(known, testing::Contains(option)) << "an example of " << name;
    const std::pair<const char*, const char*> values[] = {{"--backend", "auto, egl or osmesa"},
                                                          {"--shard", "part K of N"},
                                                          {"--format", "webp"},
                                                          {"--update", "--update=all"},
                                                          {"--pictures", "kitty"}};
    for (const auto& [option, value] : values) {
      if (known.contains(option)) {
        EXPECT_THAT(before, HasSubstr(value)) << name;
      }
    }
  }
}

/// Options of `contactscope VERB ...` in a line of a document, and the verb; an empty verb if there is
/// none.
std::pair<std::string, std::set<std::string>> command_in(const std::string& line) {
  static const std::regex command("contactscope ([a-z]+) ([^`#|]*)");
  std::smatch match;
  if (!std::regex_search(line, match, command)) return {};
  return {match[1], options_in(" " + match[2].str(), " ")};
}

TEST(CommandLine, DocumentsNameOnlyOptionsOfTheirVerb) {
  std::map<std::string, std::set<std::string>> known;
  int commands = 0;
  for (const char* folder : {"/src", "/render", "/scenarios"}) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(CONTACTSCOPE_SOURCE_DIR +
                                                                           std::string(folder))) {
      if (entry.path().extension() != ".md") continue;
      std::istringstream lines(read_text(entry.path()));
      for (std::string line; std::getline(lines, line);) {
        const auto [verb, options] = command_in(line);
        if (options.empty()) continue;
        if (!known.contains(verb))
          known[verb] = options_in("\n  --help" + run("help " + verb).out, "\n  ");
        for (const std::string& option : options)
          EXPECT_THAT(known[verb], testing::Contains(option)) << entry.path() << ": " << line;
        ++commands;
      }
    }
  }
  EXPECT_GT(commands, 10);
}

TEST(CommandLine, UsageErrorsExitWithTwoAndPrintNothingOnStandardOutput) {
  for (const char* arguments :
       {"", "fly", "--manual", "--manual vi", "render", "trace", "trace a b", "render x --size 12",
        "render x --size 10x10", "render x --frames 5:2", "render x --frames a",
        "render x --frames 0:4:0", "render x --backend vulkan", "list shapes",
        "check --update=some", "render x --jobs -1", "trace hull/face_contact --reducer best",
        "trace hull/face_contact --frames 90:99", "render hull/face_contact --view side"}) {
    const ProgramRun result = run(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    EXPECT_THAT(result.out, IsEmpty()) << arguments;
    EXPECT_THAT(result.err, testing::Not(IsEmpty())) << arguments;
  }
}

TEST(CommandLine, UsageErrorsNameTheRemedy) {
  EXPECT_THAT(run("trace hull/face_contact --reducer best").err, HasSubstr("area"));
  EXPECT_THAT(run("render hull/face_contact --view side").err, HasSubstr("main"));
  EXPECT_THAT(run("render hull/face_contact --size 5").err, HasSubstr("1280x720"));
  EXPECT_THAT(run("trace nowhere").err, HasSubstr("list scenarios"));
}

TEST(CommandLine, CompletionsAreWordsOfTheTable) {
  using testing::EndsWith;
  const auto lines = [](const std::string& words) { return run("--complete " + words).out; };
  EXPECT_THAT(lines("ren"), HasSubstr("render\tWrite pictures"));
  EXPECT_EQ(lines("--manual ''"), "man\nbash\nzsh\nfish\n");
  EXPECT_THAT(lines("render --red"), HasSubstr("\n--reducer\t"));
  EXPECT_THAT(lines("render --reducer ''"), HasSubstr("\noptimal_deepest\n"));
  EXPECT_THAT(lines("render --layers shapes,cont"), HasSubstr("\nshapes,contacts\n"));
  EXPECT_THAT(lines("render --layers ''"), EndsWith("\n:nospace\n"));
  EXPECT_THAT(lines("render --panels=summ"), HasSubstr("--panels=summary\n"));
  EXPECT_THAT(lines("render --panels = summ"), HasSubstr("\nsummary\n")) << "words of bash";
  EXPECT_THAT(lines("trace ''"), HasSubstr("\nhull/face_contact\n"));
  EXPECT_THAT(lines("trace ''"), EndsWith("\n:files\n"));
  EXPECT_EQ(lines("check --out ''"), ":folders\n");
  EXPECT_THAT(lines("study ''"), HasSubstr("tunnelling\n"));
}

TEST(CommandLine, MisspeltWordsAreNamedWithTheNearest) {
  EXPECT_THAT(run("rendr my.toml").err, HasSubstr("'rendr' is not a verb; did you mean 'render'?"));
  EXPECT_THAT(run("--quiet render").err, HasSubstr("is before the verb"));
  EXPECT_THAT(run("trace my.toml --frame 3").err,
              HasSubstr("trace has no option --frame; did you mean --frames?"));
  EXPECT_THAT(run("trace my.toml --out x").err,
              HasSubstr("trace has no option --out; it is an option of 'render'"));
  EXPECT_THAT(run("trace hul/face_contact").err, HasSubstr("did you mean hull/face_contact?"));
  EXPECT_THAT(run("study solvr").err, HasSubstr("did you mean 'solver'?"));
  EXPECT_THAT(run("render hull/face_contact --layers shape").err,
              HasSubstr("did you mean 'shapes'?"));
}

TEST(CommandLine, OtherSpellingsAndMissingWordsAreNamedInTheSameForm) {
  const std::pair<const char*, const char*> cases[] = {
      {"render my.toml -o x", "render has no option -o; did you mean --out?"},
      {"render my.toml --camera-position 1", "no option --camera-position; did you mean --camera?"},
      {"render my.toml --output x", "render has no option --output; did you mean --out?"},
      {"render my.toml --eye 4 2 4", "have commas between them; write --eye 4,2,4"},
      {"render my.toml --eye 4,a,4", "--eye '4,a,4': 'a' is not a number; write --eye X,Y,Z"},
      {"render my.toml --jobs x", "--jobs 'x' is not a whole number; it may be 0 to 256"},
      {"render my.toml --jobs -1", "--jobs is -1; it may be 0 to 256"},
      {"render my.toml --fov wide", "--fov 'wide' is not a number; it may be 1 to 150"},
      {"render my.toml --theme drak", "--theme 'drak' is not known; did you mean 'dark'?"},
      {"render my.toml --format view", "'view' is not known; did you mean 'viewer'? known: 'png'"},
      {"lint my.toml --tolerance 1mm",
       "'1mm' is not a number; it may be 0 to 1000000; write metres "
       "without the unit"},
      {"render my.toml --out", "--out needs a value; write --out DIR"},
      {"list layer", "WHAT 'layer' is not known; did you mean 'layers'?"},
      {"trace a b", "trace takes only one argument, and 'b' is one more"},
      {"trace", "trace needs SCENARIO: A file or a name"},
      {"review a", "review takes no argument, and 'a' is one more"},
      {"", "give a verb; known: 'render'"},
      {"shrink hull/face_contact --while lint.flipped_normal",
       "'flipped_normal' is not a cause of findings; did you mean 'flipped_normals'?"},
  };
  for (const auto& [arguments, message] : cases) {
    const ProgramRun result = run(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    EXPECT_THAT(result.err, StartsWith("contactscope: ")) << arguments;
    EXPECT_THAT(result.err, HasSubstr(message)) << arguments;
  }
}

TEST(CommandLine, ATriangleNeedsAMeshThatHasIt) {
  EXPECT_EQ(run("trace mesh/one_triangle --triangle 1").exit_code, 0);
  for (const char* const scenario :
       {"mesh/one_triangle --triangle 2", "hull/face_contact --triangle 0"}) {
    const ProgramRun result = run(std::string("trace ") + scenario);
    EXPECT_EQ(result.exit_code, 2) << scenario;
    EXPECT_THAT(result.err, HasSubstr("has no mesh"));
  }
}

TEST(CommandLine, AFileIsNamedWithItsEnding) {
  const TemporaryFolder folder;
  folder.write("good.toml", small_scenario());
  EXPECT_EQ(run("render '" + (folder / "good") + "' --out '" + (folder / "out") + "'").exit_code,
            0);
  EXPECT_THAT(run("render '" + (folder / "goood.toml") + "'").err, HasSubstr("did you mean"));
}

TEST(CommandLine, HelpPrintsTheKeysOfTheFormats) {
  const std::string scenario = run("help scenario").out;
  EXPECT_THAT(scenario,
              HasSubstr("\n[solver]\n  iterations: 1 to 10000; default: 10\n      sweeps"));
  EXPECT_THAT(scenario, HasSubstr("\nBox\n  half_extents: three numbers, 1e-9 to 1e9 m; required"));
  const std::string trace = run("help trace").out;
  EXPECT_THAT(trace, HasSubstr("--reducer"));
  EXPECT_THAT(trace, HasSubstr("\nManifold\n  normal: three numbers; needed\n"));
}

TEST(CommandLine, NumberBeyondADoubleIsNamedAsOne) {
  const TemporaryFolder folder;
  folder.write("big.toml", "title = \"x\"\n[shapes.a]\ntype = \"sphere\"\nradius = 1e400\n");
  EXPECT_THAT(run("trace '" + (folder / "big.toml") + "'").err, HasSubstr("up to 1.8e308"));
}

TEST(CommandLine, HelpOnAFullDiskIsTrouble) { EXPECT_EQ(run_on_full_disk("render --help"), 2); }

TEST(CommandLine, BadScenarioIsTroubleWithFileLineAndColumn) {
  const TemporaryFolder folder;
  folder.write("bad.toml", "title = \"x\"\n[shapes.a]\ntype = \"bxo\"\n");
  const ProgramRun result = run("trace '" + (folder / "bad.toml") + "'");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, StartsWith((folder / "bad.toml") + ":3:8: "));
  EXPECT_THAT(result.out, IsEmpty());
}

TEST(CommandLine, OneBadScenarioAmongGoodOnesLeavesNothingWritten) {
  const TemporaryFolder folder;
  folder.write("good.toml", small_scenario());
  folder.write("bad.toml", "title = 3\n");
  const ProgramRun result = run("render '" + (folder / "good.toml") + "' '" +
                                (folder / "bad.toml") + "' --out '" + (folder / "out") + "'");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(files_below(folder / "out"), IsEmpty());
}

TEST(CommandLine, EveryBadScenarioIsReportedInOneRun) {
  const TemporaryFolder folder;
  const std::string one = folder.write("scenarios/a/first.toml", "title = 3\n");
  const std::string two = folder.write("scenarios/a/second.toml", "titel = \"x\"\n");
  const ProgramRun result = run("trace '" + (folder / "scenarios") + "'");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr(one + ":1:"));
  EXPECT_THAT(result.err, HasSubstr(two + ":1:1: "));
}

TEST(CommandLine, BadScenariosAreFindingsOfACheckThatRunsTheOthers) {
  const TemporaryFolder folder;
  folder.write("scenarios/a/first.toml", "title = 3\n");
  folder.write("scenarios/a/good.toml", small_scenario());
  folder.write("scenarios/a/second.toml", "titel = \"x\"\n");
  folder.write("snapshots/a/second/trace.jsonl", "");
  const std::string root = folder / "scenarios";
  const std::string check = "check --facts-only --scenarios '" + root + "' --snapshots '" +
                            (folder / "snapshots") + "' --out '" + (folder / "out") + "' ";
  for (const char* arguments : {"--write-missing", "--update", ""}) {
    const ProgramRun result = run(check + arguments, "CI=");
    EXPECT_EQ(result.exit_code, 2) << arguments;
    EXPECT_THAT(result.out, HasSubstr("unreadable  " + root + "/a/first.toml:1:")) << arguments;
    EXPECT_THAT(result.out, HasSubstr(root + "/a/second.toml:1:1: ")) << arguments;
    const bool is_first = std::string(arguments) == "--write-missing";
    EXPECT_THAT(result.err, HasSubstr(is_first ? "3 scenarios: 0 the same, 2 fail"
                                               : "3 scenarios: 1 the same, 2 fail"))
        << arguments;
    EXPECT_THAT(result.err, HasSubstr("2 unreadable scenarios)")) << arguments;
  }
  EXPECT_TRUE(std::filesystem::exists(folder / "snapshots/a/second/trace.jsonl"));
  EXPECT_TRUE(std::filesystem::exists(folder / "out/check/report.html"));
}

TEST(CommandLine, TwoScenariosOfOneNameAreRefusedAndOneNamedTwiceIsTakenOnce) {
  const TemporaryFolder folder;
  const std::string one = folder.write("a/group/idea.toml", small_scenario());
  const std::string two = folder.write("b/group/idea.toml", small_scenario());
  const std::string out = "' --out '" + (folder / "out") + "' --size 64x64 --quiet";
  const ProgramRun clash = run("render '" + one + "' '" + two + out);
  EXPECT_EQ(clash.exit_code, 2);
  EXPECT_THAT(clash.err, HasSubstr("group/idea is also that of " + one));
  EXPECT_THAT(files_below(folder / "out"), IsEmpty());
  EXPECT_EQ(run("trace '" + one + "'").exit_code, 0);
}

TEST(CommandLine, BadBackendVariableStopsOnlyVerbsThatDraw) {
  const ProgramRun drawing = run("render hull/coherent_points", "CONTACTSCOPE_BACKEND=vulkan");
  EXPECT_EQ(drawing.exit_code, 2);
  EXPECT_THAT(drawing.err, HasSubstr("$CONTACTSCOPE_BACKEND"));
  EXPECT_EQ(run("trace hull/coherent_points", "CONTACTSCOPE_BACKEND=vulkan").exit_code, 0);
}

TEST(List, MissingFolderIsTrouble) {
  const ProgramRun result = run("list scenarios --scenarios nowhere");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("--scenarios DIR"));
}

TEST(List, NamesEveryKind) {
  const ProgramRun all = run("list");
  EXPECT_EQ(all.exit_code, 0);
  for (const char* name :
       {"hull/face_contact", "area", "none", "reference_face", "contact_plane"}) {
    EXPECT_THAT(all.out, HasSubstr(name));
  }
  const ProgramRun layers = run("list layers");
  EXPECT_THAT(layers.out, HasSubstr("clip_polygons"));
  EXPECT_THAT(layers.out, testing::Not(HasSubstr("hull/face_contact")));
  EXPECT_THAT(run("list reducers --json").out, StartsWith("{\"reducers\":["));
}

// A row that loses its scene fails here. Rows without a scene are gaps: the number only falls.
TEST(List, EveryClaimOfTheSourcesIsShownByWhatExists) {
  constexpr int kGaps = 0;
  std::set<std::string> studies;
  const auto listed = nlohmann::json::parse(run("list studies --json").out);
  for (const auto& study : listed["studies"]) studies.insert("study " + std::string(study["name"]));
  const std::string source = CONTACTSCOPE_SOURCE_DIR "/";
  int gaps = 0, shown = 0;
  for (const std::string what : {"gregorius", "catto", "survey", "lecture", "project", "course"}) {
    const auto rows = nlohmann::json::parse(run("list " + what + " --json").out)[what];
    EXPECT_GE(rows.size(), 16u) << what;
    for (const auto& row : rows) {
      const std::string summary = row["summary"];
      const std::size_t begin = summary.rfind("  [") + 3;
      const std::string entries = summary.substr(begin, summary.size() - begin - 1);
      if (entries == "nothing") {
        ++gaps;
        continue;
      }
      std::istringstream parts(entries);
      for (std::string entry; std::getline(parts >> std::ws, entry, ',');) {
        ++shown;
        if (studies.contains(entry.substr(0, entry.find(':')))) continue;
        if (entry.find('.') != std::string::npos) {
          EXPECT_TRUE(std::filesystem::exists(source + entry)) << row;
          continue;
        }
        const std::size_t colon = std::min(entry.find(':'), entry.size());
        const std::string name = source + "scenarios/" + entry.substr(0, colon);
        if (std::filesystem::exists(name + ".jsonl")) continue;
        ASSERT_TRUE(std::filesystem::exists(name + ".toml")) << row;
        if (colon == entry.size()) continue;
        const std::string frame = entry.substr(colon + 1);
        const std::string picture = "frame_" + std::string(4 - frame.size(), '0') + frame + ".png";
        using Stored = std::filesystem::recursive_directory_iterator;
        EXPECT_TRUE(
            std::any_of(Stored(source + "snapshots/" + entry.substr(0, colon)), Stored(),
                        [&](const auto& file) { return file.path().filename() == picture; }))
            << "not stored: " << row;
      }
    }
  }
  EXPECT_LE(gaps, kGaps);
  EXPECT_GT(shown, 200);
}

TEST(List, SlowAPageShowsTheScenesOfADocumentInItsOrder) {
  const TemporaryFolder out;
  const ProgramRun made =
      run("list lecture --format html --snapshots '" CONTACTSCOPE_SOURCE_DIR "/snapshots' --out '" +
          out.path().string() + "'");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const std::string page = read_text(out.path() / "lecture.html");
  const auto rows = nlohmann::json::parse(run("list lecture --json").out)["lecture"];
  std::size_t at = 0;
  for (const auto& row : rows) {
    at = page.find("<b>" + std::string(row["name"]) + "</b>", at);
    ASSERT_NE(at, std::string::npos) << row;
  }
  const std::regex shown("class=\"p (p[0-9]+)\"");
  std::set<std::string> pictures;
  for (std::sregex_iterator one(page.begin(), page.end(), shown), end; one != end; ++one) {
    pictures.insert((*one)[1]);
    EXPECT_THAT(page, HasSubstr("." + std::string((*one)[1]) +
                                "{background-image:url(data:image/webp;base64,UklGR"));
  }
  EXPECT_GT(pictures.size(), rows.size() / 2);
  for (const char* network : {"<script", "src=", "href=", "http"})
    EXPECT_THAT(page, testing::Not(HasSubstr(network)));
}

TEST(List, ADocumentOfTheSourcesCanBeNamedAfterThem) {
  for (const std::string name : {"gregorius", "catto", "survey", "lecture", "project"}) {
    const ProgramRun after = run("list sources " + name);
    EXPECT_EQ(after.exit_code, 0) << after.err;
    EXPECT_EQ(after.out, run("list " + name).out);
    EXPECT_LT(after.out.size(), run("list sources").out.size() / 2);
  }
  const ProgramRun unknown = run("list sources gregorus");
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("did you mean 'gregorius'"));
  const ProgramRun elsewhere = run("list layers catto");
  EXPECT_EQ(elsewhere.exit_code, 2);
  EXPECT_THAT(elsewhere.err, HasSubstr("write list sources catto"));
  EXPECT_EQ(run("list sources catto survey").exit_code, 2);
}

TEST(List, OnlyTheSourcesAndTheCourseArePages) {
  for (const char* wrong : {"list --format html", "list layers --format html",
                            "list sources --format svg", "list sources --format html,svg"}) {
    const ProgramRun refused = run(wrong);
    EXPECT_EQ(refused.exit_code, 2) << wrong;
    EXPECT_THAT(refused.err, HasSubstr("write list sources --format html")) << wrong;
  }
}

}  // namespace
}  // namespace contactscope::test
