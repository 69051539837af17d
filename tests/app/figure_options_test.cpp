#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/program.h"
#include "image/font.h"
#include "image/png.h"
#include "support/temporary_folder.h"

namespace contactscope::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const std::string kFigure = "render hull/face_contact --frames 12 ";

TEST(FigureOptions, MistakesNameTheOptionAndTheRemedy) {
  const auto fails = [](const std::string& arguments, const std::string& record) {
    const ProgramRun result = run(kFigure + arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    EXPECT_THAT(result.err, HasSubstr(record)) << arguments;
  };
  fails("--width 84", "--width '84' is not a length; write a number and mm, cm, in, pt or px");
  fails("--width 84mm --size 640x360", "--width and --size both set the width");
  fails("--width 1mm", "makes 12 pixels");
  fails("--height 50mm", "--height needs --width");
  fails("--font-size tall", "as 8pt");
  fails("--theme drak", "did you mean 'dark'?");
  fails("--background grey", "transparent, white or #RRGGBB");
  fails("--background '#14171a'", "add --theme dark");
  fails("--camera 1,2,3", "--camera=4,2,4,0,0,0,30");
  fails("--orthographic=tall", "--orthographic=1.5");
  fails("--words de", "--words 'de': there is no such file");
  fails("--words src", "src: this is a folder");
  fails("--font README.md", "this is not a TrueType font");
}

TEST(FigureOptions, ThePictureRecordsTheHeightOfAnOrthographicView) {
  for (const char* option : {"--orthographic=1.5", "--orthographic"}) {
    const TemporaryFolder folder;
    const ProgramRun drawn =
        run(kFigure + option + " --format svg --out '" + folder.path().string() + "'");
    ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
    EXPECT_THAT(read_text(folder.path() / "hull/face_contact/frame_0012.svg"),
                HasSubstr(option + std::string(" --frames 12")));
  }
}

TEST(FigureOptions, UnknownWordsAreReportedWithTheNearest) {
  const TemporaryFolder folder;
  const auto fails = [&](const std::string& entry, const std::string& record) {
    const std::string words = folder.write("de.toml", "[words]\n" + entry + "\n");
    const ProgramRun result = run(kFigure + "--words '" + words + "'");
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.err, AllOf(HasSubstr("de.toml:2:"), HasSubstr(record)));
  };
  fails("\"referenze face\" = \"Fläche\"", "did you mean 'reference face'?");
  fails("\"leans {n}\" = \"neigt sich\"", "need the same place in braces");
  fails("\"crate\" = \"Kiste {n}\"", "need the same place in braces");
}

TEST(FigureOptions, WordsOfAFileAreDrawn) {
  EXPECT_THAT(run("list words").out, HasSubstr("reference face\n"));
  const TemporaryFolder folder;
  const std::string words = folder.write("de.toml", "[words]\n\"reference face\" = \"Fläche\"\n");
  const ProgramRun drawn =
      run(kFigure + "--format svg --words '" + words + "' --out '" + folder.path().string() + "'");
  EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
  EXPECT_THAT(read_text(folder.path() / "hull/face_contact/frame_0012.svg"), HasSubstr(">Fläche<"));
}

TEST(FigureOptions, AScenarioMayReplaceWordsAndNames) {
  const TemporaryFolder folder;
  const std::string good = folder.write(
      "my/good.toml", small_scenario() + "\n[words]\n\"contact point\" = \"Kontakt\"\n");
  EXPECT_EQ(run("trace '" + good + "'").exit_code, 0);
  const std::string bad =
      folder.write("my/bad.toml", small_scenario() + "\n[words]\n\"contact pont\" = \"Kontakt\"\n");
  const ProgramRun result = run("trace '" + bad + "'");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("did you mean 'contact point'?"));
}

TEST(FigureOptions, ANameIsReplacedAsTheScenarioWritesIt) {
  const TemporaryFolder folder;
  std::string scenario = small_scenario();
  const std::string header = "[shapes.crate]";
  ASSERT_THAT(scenario, HasSubstr(header));
  scenario.replace(scenario.find(header), header.size(), "[shapes.old_crate]");
  const auto texts = [&](const std::string& name, const std::string& words) {
    const std::string path = folder.write("my/" + name + ".toml", scenario + words);
    const std::filesystem::path out = folder.path() / name;
    EXPECT_EQ(run("render '" + path + "' --frames 0 --size 1280x720 --format svg --out '" +
                  out.string() + "'")
                  .exit_code,
              0);
    return read_text(out / "my" / name / "frame_0000.svg");
  };
  EXPECT_THAT(texts("plain", ""), HasSubstr(": old crate<"));
  EXPECT_THAT(texts("german", "\n[words]\n\"old_crate\" = \"Kiste\"\n"),
              AllOf(HasSubstr(": Kiste<"), Not(HasSubstr(": old crate<"))));
}

}  // namespace
}  // namespace contactscope::test
