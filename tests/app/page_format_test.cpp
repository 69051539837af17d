#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "app/program.h"

// `render --format html`: one file of all frames.
namespace contactscope::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// The data of a page's script.
nlohmann::json page_data(const std::string& html) {
  constexpr std::string_view kOpening = "<script type=\"application/json\" id=\"data\">";
  const std::size_t begin = html.find(kOpening) + kOpening.size();
  return nlohmann::json::parse(html.substr(begin, html.find("</script>", begin) - begin));
}

TEST(PageFormat, IsOneSmallFileOfAllFramesThatFetchesNothing) {
  const TemporaryFolder folder;
  const std::string arguments =
      "render hull/clip_step_by_step --format html --quiet --out '" + (folder / "out") + "'";
  const ProgramRun result = run(arguments);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(files_below(folder / "out"), ElementsAre("hull/clip_step_by_step/sequence.html"));
  const std::string html = read_text(folder / "out/hull/clip_step_by_step/sequence.html");
  EXPECT_LT(html.size(), 300'000u);
  EXPECT_THAT(html, Not(HasSubstr("https:")));
  std::string others = html;
  const std::string name_space = "http://www.w3.org/2000/svg";
  for (std::size_t at = others.find(name_space); at != std::string::npos;
       at = others.find(name_space))
    others.erase(at, name_space.size());
  EXPECT_THAT(others, Not(HasSubstr("http:")));

  const nlohmann::json data = page_data(html);
  EXPECT_EQ(data["frames"].size(), 6u);
  std::vector<std::string> layers;
  for (const auto& layer : data["layers"]) layers.push_back(layer["name"]);
  EXPECT_THAT(layers, testing::IsSupersetOf({"shapes", "reference_face", "side_planes",
                                             "clip_polygons", "incident_face", "contacts"}));
  const auto& last = data["frames"].back();
  const auto contacts = std::ranges::count_if(
      last["points"], [](const nlohmann::json& point) { return point.contains("row"); });
  EXPECT_EQ(contacts, 4);
  EXPECT_EQ(last["points"][0]["rows"][0][0], "overlap");

  ASSERT_EQ(run(arguments).exit_code, 0);
  EXPECT_EQ(read_text(folder / "out/hull/clip_step_by_step/sequence.html"), html);
}

TEST(PageFormat, HasPanelsNextToTheView) {
  const TemporaryFolder folder;
  const ProgramRun result =
      run("render hull/face_contact --format html --frames 0:12:6 --quiet --out '" +
          (folder / "out") + "'");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const nlohmann::json data = page_data(read_text(folder / "out/hull/face_contact/sequence.html"));
  EXPECT_TRUE(data["panels"].get<bool>());
  std::vector<int> numbers;
  for (const auto& frame : data["frames"]) {
    numbers.push_back(frame["frame"]);
    EXPECT_GE(frame["panels"].size(), 1u);
  }
  EXPECT_THAT(numbers, ElementsAre(0, 6, 12));
}

/// A small scenario whose title, label and shape name contain `text`, including TOML's escapes.
std::string scenario_that_says(const std::string& text) {
  std::string scenario = small_scenario();
  scenario.replace(scenario.find("A box on a slab"), 15, text);
  scenario.replace(scenario.find("[shapes.crate]"), 14, "[shapes.\"" + text + "\"]");
  return scenario + "[[pairs]]\na = \"slab\"\nb = \"" + text + "\"\nlabel = \"" + text +
         "\"\n[[views]]\nlayers = [\"shapes\", \"contacts\", \"names\"]\n";
}

TEST(PageFormat, NoTextOfAScenarioIsMarkup) {
  const TemporaryFolder folder;
  const auto page_of = [&](const std::string& text) {
    const std::string file = folder.write("nasty/idea.toml", scenario_that_says(text));
    const ProgramRun result =
        run("render '" + file + "' --format html --quiet --out '" + (folder / "out") + "'");
    EXPECT_EQ(result.exit_code, 0) << text << result.err;
    return read_text(folder / "out/nasty/idea/sequence.html");
  };
  const auto markup = [](const std::string& html) {
    return std::ranges::count(html, '<') + std::ranges::count(html, '>');
  };
  const std::string plain = page_of("crate");
  for (const char* text :
       {"<!--<script>", "</script><script>document.title='run'</script>", "]]><svg onload='x'>",
        "&lt;b&gt;", "\\u003cscript>", "<img src=x onerror='x'>"}) {
    const std::string html = page_of(text);
    EXPECT_EQ(markup(html), markup(plain)) << text;
    const std::string said = nlohmann::json::parse("\"" + std::string(text) + "\"");
    EXPECT_THAT(page_data(html).dump(), HasSubstr(nlohmann::json(said).dump().substr(1, 8)));
  }
}

// A script that the label opens would leave the page without its own.
TEST(PageFormat, ABrowserDrawsWhateverALabelSays) {
  if (chromium().empty()) GTEST_SKIP() << "Chromium is not installed (apt-get install chromium)";
  const TemporaryFolder folder;
  const std::string file = folder.write("nasty/idea.toml", scenario_that_says("<!--<script>"));
  ASSERT_EQ(
      run("render '" + file + "' --format html --quiet --out '" + (folder / "out") + "'").exit_code,
      0);
  const std::string command =
      "timeout 60 " + chromium() + " --headless=new --no-sandbox --disable-gpu --user-data-dir='" +
      (folder / "profile") + "' --dump-dom 'file://" + (folder / "out/nasty/idea/sequence.html") +
      "' > '" + (folder / "seen.html") + "' 2> /dev/null";
  ASSERT_EQ(std::system(command.c_str()), 0);
  const std::string seen = read_text(folder / "seen.html");
  EXPECT_THAT(seen, HasSubstr("<h1 id=\"title\">&lt;!--&lt;script&gt;</h1>"));
  EXPECT_THAT(seen, HasSubstr("<g id=\"g0\" data-layer=\"shapes\""));
}

}  // namespace
}  // namespace contactscope::test
