#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/program.h"

namespace contactscope::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string output_of(const std::string& command) {
  std::string text;
  FILE* const pipe = popen(command.c_str(), "r");
  std::array<char, 4096> buffer;
  for (std::size_t count; pipe && (count = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
    text.append(buffer.data(), count);
  if (pipe) pclose(pipe);
  return text;
}

/// report.html of a check of two scenarios, one of them changed, in headless Chromium.
class ReportPage : public testing::Test {
 protected:
  ReportPage() {
    for (const char* name : {"one", "two"})
      folder_.write(std::string("scenarios/group/") + name + ".toml", small_scenario());
    EXPECT_EQ(check("--write-missing").exit_code, 0);
    std::string moved = small_scenario();
    moved.replace(moved.find("0.495"), 5, "0.480");
    folder_.write("scenarios/group/one.toml", moved);
    EXPECT_EQ(check().exit_code, 1);
  }
  void SetUp() override {
    if (chromium().empty()) GTEST_SKIP() << "Chromium is not installed (apt-get install chromium)";
  }

  ProgramRun check(const std::string& arguments = "") const {
    return run("check --scenarios '" + (folder_ / "scenarios") + "' --snapshots '" +
                   (folder_ / "snapshots") + "' --out '" + (folder_ / "out") + "' " + arguments,
               "CI=");
  }

  /// The result of a script that runs in the page.
  nlohmann::json in_page(const std::string& script) const {
    std::string page = read_text(folder_ / "out/check/report.html");
    page.insert(page.rfind("</html>"), "<script>const answer = (() => {" + script +
                                           "})();\n"
                                           "document.documentElement.innerHTML = '<pre>' + "
                                           "encodeURIComponent(JSON.stringify(answer)) + "
                                           "'</pre>';</script>");
    const std::string file = folder_.write("out/check/driven.html", page);
    const std::string shown =
        output_of(chromium() +
                  " --headless=new --no-sandbox --disable-gpu --disable-dev-shm-usage "
                  "--user-data-dir='" +
                  (folder_ / "profile") + "' --virtual-time-budget=5000 --dump-dom 'file://" +
                  file + "' 2> /dev/null");
    const std::size_t begin = shown.find("<pre>"), end = shown.find("</pre>");
    if (begin == std::string::npos || end == std::string::npos) {
      ADD_FAILURE() << "the page did not answer: " << shown.substr(0, 2000);
      return {};
    }
    std::string text;
    for (std::size_t i = begin + 5; i < end; ++i) {
      if (shown[i] != '%') {
        text += shown[i];
        continue;
      }
      text += static_cast<char>(std::stoi(shown.substr(i + 1, 2), nullptr, 16));
      i += 2;
    }
    return nlohmann::json::parse(text);
  }

  TemporaryFolder folder_;
};

TEST_F(ReportPage, LinksPagesIn3DOfBothTraces) {
  const std::string viewer = folder_ / "viewer";
  if (run("render '" + (folder_ / "scenarios/group/one.toml") + "' --format viewer --out '" +
          viewer + "'")
          .exit_code != 0)
    GTEST_SKIP() << "built without three.js";
  const nlohmann::json links = in_page(
      "return [...document.querySelectorAll('a[href*=\"/viewer.\"]')]"
      ".map(link => link.getAttribute('href'));");
  EXPECT_EQ(links, nlohmann::json({"group/one/viewer.actual.html#frame=0",
                                   "group/one/viewer.expected.html#frame=0"}));
  const auto page = [&](const std::string& which) {
    return read_text(folder_ / ("out/check/group/one/viewer." + which + ".html"));
  };
  EXPECT_THAT(page("actual"), HasSubstr("THREE"));
  EXPECT_NE(page("actual"), page("expected"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/check/group/two/viewer.actual.html"));
  EXPECT_EQ(check("--update").exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/check/group/one/viewer.actual.html"));
}

TEST_F(ReportPage, GroupsByCauseWithContentsAndEveryComparisonMode) {
  const nlohmann::json page = in_page(R"(
    const text = selector => [...document.querySelectorAll(selector)].map(one => one.textContent);
    const ways = {};
    for (const button of document.querySelectorAll(".modes button")) {
      if (ways[button.textContent]) continue;
      button.click();
      const stage = button.closest("article").querySelector(".stage");
      ways[button.textContent] = {images: stage.querySelectorAll("img").length,
        loaded: [...stage.querySelectorAll("img")].every(image => image.src.startsWith("data:image/png;base64,")),
        range: !!button.closest("article").querySelector("input[type=range]")};
    }
    return {heads: text("h2"), contents: text("nav li a"), articles: text("article h3"), ways,
            facts: text(".facts li"), commands: text("main code")};)");
  EXPECT_THAT(page["heads"].at(0).get<std::string>(), HasSubstr("crate: moved 15 mm along -y"));
  EXPECT_EQ(page["contents"], page["articles"]);
  EXPECT_THAT(page["contents"].dump(),
              AllOf(HasSubstr("group/one/trace"), HasSubstr("group/one/frame_0001")));
  for (const char* mode : {"side by side", "slider", "onion skin", "blink"}) {
    ASSERT_TRUE(page["ways"].contains(mode)) << page["ways"];
    EXPECT_EQ(page["ways"][mode]["images"], 2) << mode;
    EXPECT_EQ(page["ways"][mode]["loaded"], true) << mode;
  }
  EXPECT_EQ(page["ways"]["slider"]["range"], true);
  EXPECT_EQ(page["ways"]["difference"]["images"], 1);
  EXPECT_EQ(page["ways"]["by layer"]["images"], 1);
  EXPECT_THAT(page["facts"].dump(), AllOf(HasSubstr("contacts"), HasSubstr("crate: moved 15 mm")));
  EXPECT_THAT(page["commands"].dump(), HasSubstr("check --accept group/one/frame_0000 --out "));
}

/// Runs a command of the page as the shell that ran the check would.
int obey(std::string command) {
  const std::string program = "contactscope ";
  const std::size_t at = command.find(program);
  command.replace(at, program.size(), "'" CONTACTSCOPE_BINARY_DIR "/contactscope' ");
  const int status = std::system(("CI= ; unset CI; " + command + " > /dev/null 2>&1").c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

constexpr const char* kPress = R"(
    const press = (key, decision) =>
      [...document.querySelectorAll("article")].find(one => one.id === key).querySelector("button." + decision).click();
    const footer = () => document.querySelector("footer");
)";

TEST_F(ReportPage, TheDifferenceIsThereByLayer) {
  const nlohmann::json page = in_page(R"(
    const ways = [...document.querySelectorAll(".modes > button")];
    ways.find(button => button.textContent === "by layer").click();
    const groups = () => [...document.querySelectorAll(".overlay > svg > g")].filter(one => one.style.display !== "none").map(one => one.getAttribute("class"));
    const before = groups(), layers = [...document.querySelectorAll(".modes > span button")];
    for (const button of layers) if (button.textContent !== "contacts") button.click();
    return {before, after: groups(), layers: layers.map(one => one.textContent)};)");
  EXPECT_THAT(page["layers"].dump(), HasSubstr("\"contacts\""));
  EXPECT_EQ(page["before"].size(), 2 * page["layers"].size());
  EXPECT_EQ(page["after"].dump(), R"(["expected contacts","actual contacts"])");
}

TEST_F(ReportPage, ACommandAcceptsWhatWasChosen) {
  const nlohmann::json page = in_page(std::string(kPress) + R"(
    const before = footer().hidden;
    press("group/one/frame_0000", "accept");
    return {before, after: footer().hidden, says: footer().querySelector("p").textContent,
            command: footer().querySelector("code").textContent};)");
  EXPECT_EQ(page["before"], true);
  EXPECT_EQ(page["after"], false);
  EXPECT_THAT(page["says"].get<std::string>(), HasSubstr("1 to accept, 0 to reject, 2 open"));
  const std::string command = page["command"];
  EXPECT_THAT(command, HasSubstr("contactscope check --accept group/one/frame_0000 --out "));
  EXPECT_EQ(obey(command), 0) << command;
  EXPECT_THAT(run("review --list --out '" + (folder_ / "out") + "'").out,
              HasSubstr("accepted          group/one/frame_0000"));
}

TEST_F(ReportPage, RejectionsGoToReview) {
  const nlohmann::json page = in_page(std::string(kPress) + R"(
    press("group/one/frame_0000", "accept");
    press("group/one/frame_0001", "accept");
    press("group/one/frame_0001", "accept");  // taken back
    document.dispatchEvent(new KeyboardEvent("keydown", {key: "j"}));
    document.dispatchEvent(new KeyboardEvent("keydown", {key: "r"}));
    return {command: footer().querySelector("code").textContent,
            marked: [...document.querySelectorAll("nav li a")].map(one => one.dataset.decided ?? "")};)");
  EXPECT_EQ(page["marked"].dump(), R"(["reject","accept",""])");
  const std::string command = page["command"];
  EXPECT_EQ(obey(command), 1) << command;
  const std::string left = run("review --list --out '" + (folder_ / "out") + "'").out;
  EXPECT_THAT(left, AllOf(HasSubstr("rejected          group/one/trace"),
                          HasSubstr("accepted          group/one/frame_0000"),
                          HasSubstr("changed           group/one/frame_0001")));
}

TEST_F(ReportPage, AllOfAScenarioIsNamedByIt) {
  const nlohmann::json page = in_page(R"(
    document.querySelector("section > .choices button.accept").click();
    return document.querySelector("footer code").textContent;)");
  EXPECT_THAT(page.get<std::string>(), HasSubstr("check --accept group/one --out "));
  EXPECT_EQ(obey(page), 0);
  EXPECT_EQ(check().exit_code, 0);
}

}  // namespace
}  // namespace contactscope::test
