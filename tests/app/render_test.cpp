#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/program.h"
#include "image/png.h"

namespace contactscope::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

TEST(Render, WritesASequenceUnderGroupAndIdea) {
  const TemporaryFolder folder;
  const ProgramRun result =
      run("render hull/eight_points_to_four --frames 0:8:4 --size 320x180 --out '" +
          (folder / "out") + "'");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, IsEmpty());
  EXPECT_THAT(files_below(folder / "out"), ElementsAre("hull/eight_points_to_four/frame_0000.png",
                                                       "hull/eight_points_to_four/frame_0004.png",
                                                       "hull/eight_points_to_four/frame_0008.png"));
  const Image image = read_png(folder / "out/hull/eight_points_to_four/frame_0004.png");
  EXPECT_EQ(image.width, 320);
  EXPECT_EQ(image.height, 180);
}

TEST(Render, EglAndOsmesaGiveTheSameFilesForEveryScenario) {
  const TemporaryFolder folder;
  for (const char* backend : {"egl", "osmesa"}) {
    const ProgramRun result = run("render scenarios --frames 0:0 --size 640x360 --backend " +
                                  std::string(backend) + " --out '" + (folder / backend) + "'");
    ASSERT_EQ(result.exit_code, 0) << result.err;
  }
  const std::set<std::string> files = files_below(folder / "egl");
  EXPECT_GE(files.size(), 10u);
  EXPECT_EQ(files, files_below(folder / "osmesa"));
  for (const std::string& file : files) {
    EXPECT_TRUE(read_text(folder / ("egl/" + file)) == read_text(folder / ("osmesa/" + file)))
        << file;
  }
}

TEST(Render, FrameOfASequenceIsTheSameRenderedAlone) {
  // Dear ImGui remembers earlier frames, and one camera serves the sequence: neither may show.
  const TemporaryFolder folder;
  const std::string file = "/hull/face_contact/frame_0012.png";
  ASSERT_EQ(run("render hull/face_contact --out '" + (folder / "all") + "'").exit_code, 0);
  ASSERT_EQ(run("render hull/face_contact --frames 12 --out '" + (folder / "one") + "'").exit_code,
            0);
  EXPECT_TRUE(read_text(folder / ("all" + file)) == read_text(folder / ("one" + file)));
}

TEST(Render, VerboseSaysWhatRanAndWhatWasLeftOut) {
  const TemporaryFolder folder;
  const ProgramRun plain =
      run("render hull/coherent_points --verbose --size 320x180 --out '" + (folder / "out") + "'");
  for (const char* text : {"pipeline", "illustrate", "paint", "read back", "encode", "open OpenGL",
                           "left out: hull/coherent_points: Dear ImGui"}) {
    EXPECT_THAT(plain.err, HasSubstr(text));
  }
  EXPECT_THAT(plain.err, Not(HasSubstr("start Dear ImGui")));
  const ProgramRun panels =
      run("render hull/face_contact --frames 0 --verbose --size 640x360 --out '" +
          (folder / "out") + "'");
  EXPECT_THAT(panels.err, HasSubstr("start Dear ImGui"));
}

TEST(Render, UnwritableFolderIsTroubleAndNamesTheFile) {
  const ProgramRun result = run("render hull/coherent_points --size 320x180 --out /proc/nowhere");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("/proc/nowhere"));
}

TEST(Render, RequestToStopLeavesWholeFilesOnly) {
  const TemporaryFolder folder;
  std::string scenario = small_scenario();
  scenario.replace(scenario.find("frames = 2"), 10, "frames = 20000");
  folder.write("long.toml", scenario);
  const std::string stop = "timeout --signal=TERM --preserve-status 2";
  const ProgramRun result =
      run("render '" + (folder / "long.toml") + "' --size 320x180 --out '" + (folder / "out") + "'",
          stop);
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("interrupted"));
  const std::set<std::string> files = files_below(folder / "out");
  EXPECT_GE(files.size(), 1u);
  EXPECT_LT(files.size(), 20000u);
  for (const std::string& file : files) {
    EXPECT_THAT(file, testing::EndsWith(".png"));
    EXPECT_NO_THROW(read_png(folder / ("out/" + file))) << file;
  }
}

TEST(Render, BackendComesFromTheEnvironmentToo) {
  const TemporaryFolder folder;
  const ProgramRun result =
      run("render hull/coherent_points --verbose --size 320x180 --out '" + (folder / "out") + "'",
          "CONTACTSCOPE_BACKEND=osmesa");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("OpenGL through OSMesa"));
}

TEST(Doctor, FullDiskIsTrouble) {
  EXPECT_EQ(run_on_full_disk("doctor"), 2);
}

}  // namespace
}  // namespace contactscope::test
