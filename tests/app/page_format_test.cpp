#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "app/program.h"

// `render --format html`: one file of all frames.
namespace contactscope::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// What a page holds for its script.
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

TEST(PageFormat, HasPanelsBesideTheView) {
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

}  // namespace
}  // namespace contactscope::test
