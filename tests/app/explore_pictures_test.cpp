#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/program.h"
#include "image/png.h"

namespace contactscope::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

TEST(ExplorePictures, StandUnderExploreGroupAndIdea) {
  const TemporaryFolder folder;
  const ProgramRun result =
      run("explore hull/eight_points_to_four --frames 0:8:4 --size 640x360 --out '" +
          (folder / "out") + "'");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, StartsWith("reducer "));
  EXPECT_THAT(result.err, HasSubstr("3 pictures in "));
  EXPECT_THAT(files_below(folder / "out"),
              ElementsAre("explore/hull/eight_points_to_four/frame_0000.png",
                          "explore/hull/eight_points_to_four/frame_0004.png",
                          "explore/hull/eight_points_to_four/frame_0008.png"));
  const Image image = read_png(folder / "out/explore/hull/eight_points_to_four/frame_0004.png");
  EXPECT_EQ(image.width, 640);
  EXPECT_EQ(image.height, 360);
}

TEST(ExplorePictures, AreTallWhereManyReducersStandSideBySide) {
  const TemporaryFolder folder;
  const std::string arguments =
      "explore hull/eight_points_to_four --frames 4 --quiet --out '" + (folder / "out") + "'";
  const std::string picture = folder / "out/explore/hull/eight_points_to_four/frame_0004.png";
  ASSERT_EQ(run(arguments).exit_code, 0);
  EXPECT_EQ(read_png(picture).width, 1280);
  EXPECT_EQ(read_png(picture).height, 1440);
  ASSERT_EQ(run(arguments + " --reducer area").exit_code, 0);
  EXPECT_EQ(read_png(picture).height, 720);
}

TEST(ExplorePictures, RoseIsAnotherPictureOfTheSameAnswers) {
  const TemporaryFolder folder;
  const std::string arguments =
      "explore reduction/moment_rose --reducer first --size 640x360 --out '";
  const ProgramRun areas = run(arguments + (folder / "areas") + "' --json");
  const ProgramRun rose = run(arguments + (folder / "rose") + "' --rose --json");
  ASSERT_EQ(rose.exit_code, 0) << rose.err;
  const auto kept = [](const std::string& json) {
    return json.substr(json.find("\"kept\""),
                       json.find(']', json.find("\"kept\"")) - json.find("\"kept\""));
  };
  EXPECT_EQ(kept(areas.out), kept(rose.out));
  const std::string picture = "/explore/reduction/moment_rose/frame_0000.png";
  EXPECT_NE(read_png((folder / "areas") + picture).rgb, read_png((folder / "rose") + picture).rgb);
}

TEST(ExplorePictures, TrianglesOfAMeshHaveFoldersWhereSomethingIsReduced) {
  const TemporaryFolder folder;
  folder.write("g/mesh.toml",
               "title = \"Mesh\"\n[pipeline]\nmesh_manifolds = \"triangle\"\nmax_points = "
               "3\n[shapes.crate]\ntype = \"box\"\n"
               "half_extents = [0.4, 0.3, 0.4]\nposition = [0.05, 0.29, 0.07]\n"
               "[shapes.floor]\ntype = \"mesh\"\ngrid = { size = [4, 4], cells = [8, 8] }\n");
  const ProgramRun result = run("explore '" + (folder / "g/mesh.toml") +
                                "' --reducer area --size 320x180 --out '" + (folder / "out") + "'");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto files = files_below(folder / "out");
  EXPECT_GE(files.size(), 1u);
  for (const auto& file : files)
    EXPECT_THAT(file, HasSubstr("explore/g/mesh/crate-floor-triangle_"));
  EXPECT_THAT(result.err, HasSubstr("whose points every reducer keeps"));
}

TEST(ExplorePictures, SeveralPairsHaveFoldersOfTheirOwn) {
  const TemporaryFolder folder;
  folder.write("g/two.toml", small_scenario() +
                                 "[shapes.post]\ntype = \"box\"\nhalf_extents = [0.1, 0.5, 0.1]\n"
                                 "position = [0.8, 0.495, 0.0]\n");
  const ProgramRun result =
      run("explore '" + (folder / "g/two.toml") + "' --frames 1 --size 320x180 --quiet --out '" +
          (folder / "out") + "'");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(files_below(folder / "out"), ElementsAre("explore/g/two/slab-crate/frame_0001.png",
                                                       "explore/g/two/slab-post/frame_0001.png"));
}

TEST(ExplorePictures, UnwritableFolderIsTroubleAndNamed) {
  const ProgramRun result =
      run("explore hull/eight_points_to_four --frames 0 --size 320x180 --out /proc/nowhere");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("/proc/nowhere"));
}

}  // namespace
}  // namespace contactscope::test
