#include "page/page.h"

#include <gmock/gmock.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "draw/crate_on_slab.h"

namespace contactscope::page {
namespace {

using draw::crate_sample::CrateOnSlab;
using testing::HasSubstr;
using testing::Not;

/// Two frames; the crate has moved in the second one.
CrateOnSlab moving() {
  CrateOnSlab scene;
  scene.header.title = "A crate <on> \"a\" slab & more";
  scene.header.frames = 2;
  scene.view.layers = {Layer::Shapes, Layer::Contacts, Layer::Ids};
  scene.frames.push_back(scene.frames[0]);
  scene.frames[1].frame = 7;
  scene.frames[1].poses[1].second.position.x() += 0.1;
  return scene;
}

std::string page_of(const CrateOnSlab& scene) {
  const draw::Staging staging = scene.staged();
  PictureOrigin origin;
  origin.version = "1.2.3";
  origin.scenario = "mine/crate";
  origin.title = scene.header.title;
  origin.command = "contactscope render mine/crate --format html";
  Page page(staging, origin);
  for (const trace::Frame& frame : scene.frames) page.add(frame, draw::illustrate(staging, frame));
  return page.html();
}

nlohmann::json data_of(const std::string& html) {
  constexpr std::string_view kOpening = "<script type=\"application/json\" id=\"data\">";
  const std::size_t begin = html.find(kOpening) + kOpening.size();
  return nlohmann::json::parse(html.substr(begin, html.find("</script>", begin) - begin));
}

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t times = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1))
    ++times;
  return times;
}

TEST(Page, HasEveryFrameWithGroupsThatAreInTheFileOnce) {
  const std::string html = page_of(moving());
  const nlohmann::json data = data_of(html);
  ASSERT_EQ(data["frames"].size(), 2u);
  EXPECT_EQ(data["frames"][0]["frame"], 0);
  EXPECT_EQ(data["frames"][1]["frame"], 7);
  std::set<int> numbers;
  for (const auto& frame : data["frames"]) {
    EXPECT_GE(frame["view"].size(), 4u);
    std::set<int> own;
    for (const int number : frame["view"]) EXPECT_TRUE(own.insert(number).second);
    numbers.merge(own);
  }
  for (const int number : numbers)
    EXPECT_EQ(count(html, "<g id=\"g" + std::to_string(number) + "\""), 1u) << number;
  EXPECT_EQ(count(html, "<g id="), numbers.size());
  // The slab does not move: both frames share its parts.
  EXPECT_LT(numbers.size(), data["frames"][0]["view"].size() + data["frames"][1]["view"].size());
}

TEST(Page, ListsTheLayersInDrawingOrder) {
  const nlohmann::json data = data_of(page_of(moving()));
  std::vector<std::string> names;
  for (const auto& layer : data["layers"]) names.push_back(layer["name"]);
  EXPECT_THAT(names, testing::ElementsAre("shapes", "contacts", "ids", "shape_names"));
}

TEST(Page, HasTitleSourceAndCommandAsText) {
  const std::string html = page_of(moving());
  EXPECT_THAT(html,
              HasSubstr("<h1 id=\"title\">A crate &lt;on&gt; &quot;a&quot; slab &amp; more</h1>"));
  EXPECT_THAT(html, HasSubstr("<p id=\"source\">none</p>"));
  EXPECT_THAT(html, HasSubstr("<code>contactscope render mine/crate --format html</code>"));
  // The picture itself does not repeat them.
  EXPECT_THAT(html, Not(HasSubstr("data-layer=\"title\"")));
  EXPECT_THAT(html, Not(HasSubstr("data-layer=\"legend\"")));
  EXPECT_FALSE(data_of(html)["legend"].empty());
}

// The legend has few rows: a label in the view explains an entry without a row, and stays there.
TEST(Page, LabelsThatTheLegendHasNoRowForStayInTheView) {
  CrateOnSlab scene = moving();
  const draw::Staging staging = scene.staged();
  draw::Drawing drawing = draw::illustrate(staging, scene.frames[0]);
  drawing.begin(draw::kLegendPart);
  draw::Text label;
  label.text = "named here";
  label.at = {300, 300};
  drawing.primitives.push_back(label);
  PictureOrigin origin;
  origin.scenario = "mine/crate";
  Page page(staging, origin);
  page.add(scene.frames[0], drawing);
  const std::string html = page.html();
  EXPECT_THAT(html, HasSubstr("data-layer=\"labels\""));
  EXPECT_THAT(html, HasSubstr(">named here</text>"));
  const nlohmann::json data = data_of(html);
  for (const auto& entry : data["legend"]) EXPECT_NE(entry["text"], "named here");
}

TEST(Page, FetchesNothingAndLeavesNothingUnfilled) {
  std::string html = page_of(moving());
  const std::string name_space = "http://www.w3.org/2000/svg";
  for (std::size_t at = html.find(name_space); at != std::string::npos; at = html.find(name_space))
    html.erase(at, name_space.size());
  EXPECT_THAT(html, Not(HasSubstr("http:")));
  EXPECT_THAT(html, Not(HasSubstr("https:")));
  EXPECT_THAT(html, Not(HasSubstr("<link")));
  EXPECT_THAT(html, Not(HasSubstr(" src=")));
  EXPECT_THAT(html, Not(testing::ContainsRegex("@[A-Z_]+@")));
}

TEST(Page, IsTheSameEachTime) { EXPECT_EQ(page_of(moving()), page_of(moving())); }

TEST(Page, ATitleThatWouldEndTheScriptDoesNot) {
  CrateOnSlab scene = moving();
  scene.header.title = "</script><b>";
  const std::string html = page_of(scene);
  EXPECT_EQ(count(html, "</script>"), 2u);
  EXPECT_EQ(data_of(html)["frames"][0]["title"], "</script><b>");
}

TEST(Page, ScriptIsJavaScript) {
  if (std::system("node --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "there is no node";
  EXPECT_EQ(std::system("node --check '" CONTACTSCOPE_PAGE_DIR "/page.js'"), 0);
}

}  // namespace
}  // namespace contactscope::page
