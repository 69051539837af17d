#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/program.h"
#include "app/terminal.h"

namespace contactscope::test {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr const char* kPrompt = "a c r s w q? ";

/// A report about a scenario whose box was moved: its trace and two pictures.
class ReviewTest : public testing::Test {
 protected:
  ReviewTest() {
    folder_.write("scenarios/group/idea.toml", small_scenario());
    EXPECT_EQ(check("--update").exit_code, 0);
    std::string moved = small_scenario();
    moved.replace(moved.find("0.495"), 5, "0.480");
    folder_.write("scenarios/group/idea.toml", moved);
    EXPECT_EQ(check().exit_code, 1);
  }

  ProgramRun check(const std::string& arguments = "",
                   const std::string& environment = "CI=") const {
    return run("check --scenarios '" + (folder_ / "scenarios") + "' --snapshots '" +
                   (folder_ / "snapshots") + "' " + out() + arguments,
               environment);
  }
  std::string out() const { return "--out '" + (folder_ / "out") + "' "; }
  TerminalRun review(const std::string& keys) const {
    return run_on_terminal("review " + out(), keys, kPrompt);
  }
  std::string left() const { return run("review --list " + out()).out; }

  TemporaryFolder folder_;
};

TEST_F(ReviewTest, EachKeyDoesItsThing) {
  const TerminalRun first = review("rsa");
  EXPECT_EQ(first.exit_code, 1);
  EXPECT_THAT(first.shown, HasSubstr("[1/3] group/idea/trace"));
  EXPECT_THAT(first.shown, HasSubstr("accepted group/idea/frame_000"));
  EXPECT_THAT(left(), HasSubstr("rejected          group/idea/trace"));
  const TerminalRun second = review("wa");
  EXPECT_THAT(second.shown, HasSubstr("[1/1]")) << "what was rejected is not asked again";
  EXPECT_THAT(second.shown, HasSubstr("\xE2\x96\x80")) << "the picture, in half blocks";
  EXPECT_EQ(second.exit_code, 1) << "a rejected trace fails";
  const ProgramRun after = check();
  EXPECT_THAT(after.err, HasSubstr("(1 changed,"));
  EXPECT_EQ(check("--accept group/idea/trace").exit_code, 0);
  EXPECT_EQ(check().exit_code, 0);
}

TEST_F(ReviewTest, ACauseIsAcceptedAtOnceAndQuittingKeepsTheRest) {
  EXPECT_EQ(review("q").exit_code, 1);
  const TerminalRun all = review("c");
  EXPECT_EQ(all.exit_code, 0);
  EXPECT_THAT(all.shown, HasSubstr("1 scenario: 0 the same, 0 fail, 3 accepted"));
  EXPECT_EQ(check().exit_code, 0);
  EXPECT_THAT(review("").shown, HasSubstr("there is nothing to review"));
}

TEST_F(ReviewTest, CtrlCEndsItAndKeepsWhatWasDone) {
  const TerminalRun stopped = review("r\003");
  EXPECT_EQ(stopped.exit_code, 130) << stopped.shown;
  EXPECT_THAT(left(), HasSubstr("rejected          group/idea/trace"));
}

TEST_F(ReviewTest, AnotherScenarioThatWasEditedIsNotPartOfACause) {
  folder_.write("scenarios/group/other.toml", small_scenario());
  check("--write-missing");
  std::string moved = small_scenario();
  moved.replace(moved.find("0.495"), 5, "0.470");
  folder_.write("scenarios/group/other.toml", moved);
  const ProgramRun result = check();
  EXPECT_THAT(result.out, HasSubstr("group/idea frame 0, crate: moved 15 mm along -y"));
  EXPECT_THAT(result.out, HasSubstr("group/other frame 0, crate: moved 25 mm along -y"));
  EXPECT_THAT(result.out, Not(HasSubstr("the same cause in")));
  review("cq");
  EXPECT_THAT(check().err, HasSubstr("2 scenarios: 1 the same, 1 fails"));
}

TEST_F(ReviewTest, AKnownBugGoesOnFailing) {
  const ProgramRun kept = check("--accept group/idea/frame_0000 --as bad_31 --note 'it is back'");
  EXPECT_EQ(kept.exit_code, 0);
  EXPECT_THAT(kept.out,
              HasSubstr("kept group/idea/frame_0000 as bad_31, so that check recognizes it"));
  EXPECT_THAT(left(), HasSubstr("rejected          group/idea/frame_0000"));
  check("--update");
  const ProgramRun back = check("--github");
  EXPECT_EQ(back.exit_code, 1);
  EXPECT_THAT(back.out, HasSubstr("known bad   group/idea frame 0: it is back"));
  EXPECT_THAT(back.err, HasSubstr("fix the bug that came back, or remove "));
  EXPECT_THAT(back.out + back.err, Not(HasSubstr("--accept")));
}

TEST_F(ReviewTest, APictureOfAnotherDriverIsAcceptedByItsPlainName) {
  EXPECT_EQ(check("--accept group/idea/frame_0000 --as osmesa").exit_code, 0);
  std::string moved = small_scenario();
  moved.replace(moved.find("0.495"), 5, "0.470");
  folder_.write("scenarios/group/idea.toml", moved);
  EXPECT_EQ(check().exit_code, 1);
  EXPECT_THAT(left(), HasSubstr("group/idea/frame_0000.osmesa")) << "the nearest is shown";
  const ProgramRun accepted = check("--accept group/idea/frame_0000");
  EXPECT_THAT(accepted.out, HasSubstr("updated group/idea/frame_0000.osmesa"));
  EXPECT_THAT(check("--accept group/idea/trace --as osmesa").err, HasSubstr("is not a picture"));
}

TEST_F(ReviewTest, AnUnmetExpectationHasARemedyInEveryOutput) {
  folder_.write("scenarios/group/idea.toml",
                small_scenario() + "[[expect]]\na = \"slab\"\nb = \"crate\"\npoints = 3\n");
  check("--update");
  const std::string junit = folder_ / "junit.xml", summary = folder_ / "summary.md";
  const ProgramRun result = check("--github --junit '" + junit + "' --markdown '" + summary + "'");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.out,
              testing::ContainsRegex("::error file=[^,]*group/idea\\.toml,line=[0-9]+,"));
  for (const std::string& record : {result.out + result.err, read_text(junit), read_text(summary),
                                    read_text(folder_ / "out/check/report.html")}) {
    EXPECT_THAT(record, HasSubstr("fix the expectation in its scenario"));
    EXPECT_THAT(record, Not(HasSubstr("--accept group")));
  }
}

TEST_F(ReviewTest, AnUnreadableScenarioIsInEveryReport) {
  folder_.write("scenarios/group/bad.toml", "title = \"x\"\n titel = 3\n");
  const std::string junit = folder_ / "junit.xml", summary = folder_ / "summary.md";
  const ProgramRun result = check("--github --junit '" + junit + "' --markdown '" + summary + "'");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.out, testing::ContainsRegex("::error file=[^,]*group/bad\\.toml,line=2,"));
  EXPECT_THAT(read_text(junit), testing::ContainsRegex("<testcase [^>]*name=\"bad\""));
  for (const std::string& record : {result.out + result.err, read_text(junit), read_text(summary),
                                    read_text(folder_ / "out/check/report.html")})
    EXPECT_THAT(record, HasSubstr("unknown key 'titel'"));
}

TEST_F(ReviewTest, WithoutATerminalItNamesTheAlternatives) {
  const ProgramRun result = run("review " + out(), "CI=");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("review --list"));
  EXPECT_EQ(run("review --list " + out()).exit_code, 1);
  EXPECT_EQ(run("review --out '" + (folder_ / "nowhere") + "'").exit_code, 2);
}

TEST_F(ReviewTest, ACandidateThatIsStaleIsRefused) {
  folder_.write("snapshots/group/idea/trace.jsonl", "somebody else's");
  const ProgramRun result = check("--accept group/idea");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("group/idea/trace is stale"));
  EXPECT_THAT(result.err, HasSubstr("2 findings accepted, 1 refused"));
}

TEST_F(ReviewTest, ShowPrintsOneFindingAndItsPictures) {
  const ProgramRun plain = run("show group/idea/frame_0001 " + out());
  EXPECT_EQ(plain.exit_code, 0) << plain.err;
  EXPECT_THAT(plain.out, HasSubstr("its facts changed, and with them"));
  EXPECT_THAT(plain.out, HasSubstr("check/group/idea/frame_0001.difference.png"));
  EXPECT_THAT(run("show group/idea/frame_0001 --pictures kitty " + out()).out,
              HasSubstr("\033_Gf=100,a=T,m="));
  EXPECT_THAT(run("show group/idea/frame_0001 --pictures blocks " + out()).out,
              HasSubstr("\xE2\x96\x80"));
  EXPECT_EQ(run("show group/idea/frame_0009 " + out()).exit_code, 2);
}

TEST_F(ReviewTest, AFileOfDecisionsIsDone) {
  const std::string file = folder_.write(
      "decisions.json", R"({"accept": ["group/idea/frame_0000"], "reject": ["group/idea/trace"]})");
  const ProgramRun done = run("review --from '" + file + "' " + out(), "CI=");
  EXPECT_EQ(done.exit_code, 1) << "a rejected trace fails";
  EXPECT_THAT(done.err, HasSubstr("1 finding accepted, 1 rejected, 0 refused"));
  EXPECT_THAT(left(), HasSubstr("rejected          group/idea/trace"));
  EXPECT_THAT(left(), HasSubstr("accepted          group/idea/frame_0000"));
  const std::string all = folder_.write("all.json", R"({"accept": ["group/idea"]})");
  EXPECT_EQ(run("review --from - " + out(), "CI=", all).exit_code, 0);
  EXPECT_EQ(check().exit_code, 0);
}

TEST_F(ReviewTest, AFileThatDecidesNothingIsRefused) {
  const auto record = [&](const std::string& text) {
    const std::string file = folder_.write("decisions.json", text);
    const ProgramRun result = run("review --from '" + file + "' " + out(), "CI=");
    EXPECT_EQ(result.exit_code, 2);
    return result.err;
  };
  EXPECT_THAT(record("{"), HasSubstr("as report.html saves it"));
  EXPECT_THAT(record(R"({"take": []})"), HasSubstr("'take' is no decision"));
  EXPECT_THAT(record(R"({"accept": ["group/idee"]})"), HasSubstr("is not in the last report"));
  EXPECT_THAT(record(R"({"accept": ["group/idea"], "reject": ["group/idea/trace"]})"),
              HasSubstr("group/idea/trace is both accepted and rejected"));
  EXPECT_THAT(run("review --from nowhere.json " + out(), "CI=").err, HasSubstr("no such file"));
  EXPECT_THAT(run("review --from x.json " + out(), "CI=true").err, HasSubstr("unset CI"));
}

TEST_F(ReviewTest, GithubJunitAndMarkdownHaveTheFindings) {
  const ProgramRun result = check("--github --junit '" + (folder_ / "junit.xml") +
                                  "' --markdown '" + (folder_ / "summary.md") + "'");
  EXPECT_THAT(result.out, HasSubstr("::error file="));
  EXPECT_THAT(result.out, HasSubstr("title=group/idea/trace::group/idea frame 0, crate: moved"));
  const std::string junit = read_text(folder_ / "junit.xml");
  EXPECT_THAT(junit, HasSubstr("<testsuite name=\"group\" tests=\"1\" failures=\"1\">"));
  EXPECT_THAT(junit, HasSubstr("<failure type=\"changed\" message=\"group/idea frame 0, crate"));
  // Jenkins wants each on a line of its own, without text before or after.
  std::istringstream lines(junit);
  std::vector<std::string> attached;
  for (std::string line; std::getline(lines, line);) {
    if (line.find("ATTACHMENT") == std::string::npos) continue;
    ASSERT_THAT(line, testing::MatchesRegex("\\[\\[ATTACHMENT\\|/[^|]*\\]\\]"));
    attached.push_back(line.substr(13, line.size() - 15));
  }
  ASSERT_EQ(attached.size(), 7u) << "three of each picture, and the trace";
  EXPECT_THAT(attached[0], HasSubstr("frame_0000.expected.png"));
  for (const std::string& file : attached) EXPECT_TRUE(std::filesystem::exists(file)) << file;
  const std::string summary = read_text(folder_ / "summary.md");
  EXPECT_THAT(summary, HasSubstr("1 scenario: 0 the same, 1 fails"));
  EXPECT_THAT(summary, HasSubstr("](data:image/png;base64,"));
  EXPECT_THAT(summary, HasSubstr("contactscope check --accept group/idea"));
}

TEST_F(ReviewTest, ThePageHasItsPicturesAndAcceptCommands) {
  const std::string page = read_text(folder_ / "out/check/report.html");
  EXPECT_THAT(page, Not(HasSubstr("@REPORT@")));
  EXPECT_THAT(page, HasSubstr("data:image/png;base64,"));
  EXPECT_THAT(page, HasSubstr("contactscope check --accept group/idea/frame_0000"));
  EXPECT_EQ(check("--accept '*'").exit_code, 0);
  EXPECT_THAT(read_text(folder_ / "out/check/report.html"), HasSubstr("0 fail"));
}

}  // namespace
}  // namespace contactscope::test
