#include "house/include_order.h"

#include <gmock/gmock.h>

namespace contactscope::house {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(IncludeOrder, EveryFileUsesOnlyFoldersToItsLeft) {
  const std::vector<SourceFile> files = read_house(CONTACTSCOPE_SOURCE_DIR);
  ASSERT_GT(files.size(), 20u);
  EXPECT_THAT(include_violations(files), IsEmpty());
}

TEST(IncludeOrder, EveryFolderLinksOnlyFoldersToItsLeft) {
  EXPECT_THAT(link_violations(read_house(CONTACTSCOPE_SOURCE_DIR)), IsEmpty());
}

TEST(IncludeOrder, UsingAFolderToTheRightIsCaught) {
  EXPECT_THAT(
      include_violations({{"src/core/pose.h", "#pragma once\n#include \"geometry/hull.h\"\n"},
                          {"src/geometry/hull.h", "#include \"core/pose.h\"\n"}}),
      ElementsAre("src/core/pose.h:2: core must not use geometry"));
}

TEST(IncludeOrder, SpacesAndTabsHideNoInclude) {
  EXPECT_THAT(include_violations({{"src/core/pose.h", " \t# \tinclude\t \"query/sat.h\""},
                                  {"src/query/sat.h", ""}}),
              ElementsAre("src/core/pose.h:1: core must not use query"));
}

TEST(IncludeOrder, OnlyTheProgramUsesRender) {
  const SourceFile image{"render/image/image.h", ""};
  EXPECT_THAT(include_violations({{"src/app/main.cpp", "#include \"image/image.h\""}, image}),
              IsEmpty());
  EXPECT_THAT(include_violations({{"src/study/plot.cpp", "#include \"image/image.h\""}, image}),
              ElementsAre("src/study/plot.cpp:1: study must not use image"));
}

TEST(IncludeOrder, ImageUsesNothingOfSrc) {
  EXPECT_THAT(include_violations(
                  {{"render/image/image.h", "#include \"core/vec3.h\""}, {"src/core/vec3.h", ""}}),
              ElementsAre("render/image/image.h:1: image must not use core"));
}

TEST(IncludeOrder, DrawUsesCoreTraceAndImageAlone) {
  EXPECT_THAT(include_violations({{"render/draw/a.cpp",
                                   "#include \"core/vec3.h\"\n#include \"trace/trace.h\"\n"
                                   "#include \"image/font.h\"\n#include \"geometry/hull.h\"\n"},
                                  {"src/core/vec3.h", ""},
                                  {"src/trace/trace.h", ""},
                                  {"render/image/font.h", ""},
                                  {"src/geometry/hull.h", ""}}),
              ElementsAre("render/draw/a.cpp:4: draw must not use geometry"));
}

TEST(IncludeOrder, NoArrowRunsUpInDraw) {
  const std::vector<SourceFile> files = {
      {"render/draw/scene/scene.h", "#include \"draw/layers/layer.h\""},
      {"render/draw/layers/layer.h", "#include \"draw/scene/scene.h\""},
      {"render/draw/layers/tree.cpp",
       "#include \"draw/layers/layer.h\"\n#include \"draw/layers/ids.h\""},
      {"render/draw/layers/ids.h", "#include \"draw/insets/inset.h\""},
      {"render/draw/charts/plot.h", "#include \"draw/insets/inset.h\""},
      {"render/draw/insets/inset.h",
       "#include \"draw/charts/plot.h\"\n#include \"draw/staging.h\""},
      {"render/draw/staging.h",
       "#include \"draw/insets/inset.h\"\n#include \"draw/layers/layer.h\""}};
  EXPECT_THAT(include_violations(files),
              ElementsAre("render/draw/scene/scene.h:1: scene must not use layers",
                          "render/draw/layers/tree.cpp:2: layers must not use each other",
                          "render/draw/layers/ids.h:1: layers must not use insets",
                          "render/draw/charts/plot.h:1: charts must not use insets",
                          "render/draw/insets/inset.h:2: insets must not use the top of draw"));
}

TEST(IncludeOrder, NoVerbOfAppUsesALaterOne) {
  const std::vector<SourceFile> files = {
      {"src/app/cli/verbs.h", "#include \"app/check/review.h\""},
      {"src/app/check/review.h", "#include \"app/compare/engine_runs.h\""},
      {"src/app/compare/engine_runs.h",
       "#include \"app/cli/verbs.h\"\n#include \"app/check/review.h\""}};
  EXPECT_THAT(include_violations(files),
              ElementsAre("src/app/cli/verbs.h:1: cli must not use check",
                          "src/app/check/review.h:1: check must not use compare"));
}

TEST(IncludeOrder, AnIncludeOfNoFileIsCaught) {
  EXPECT_THAT(include_violations({{"src/core/pose.h", "#include \"core/pse.h\""}}),
              ElementsAre("src/core/pose.h:1: \"core/pse.h\" is no file of src or render"));
}

TEST(IncludeOrder, AFileNextToItsUserIsFound) {
  EXPECT_THAT(
      include_violations({{"src/core/pose.cpp", "#include \"pose.h\""}, {"src/core/pose.h", ""}}),
      IsEmpty());
}

TEST(IncludeOrder, AFileOfASiblingFolderIsFoundAndChecked) {
  const std::vector<SourceFile> files = {
      {"src/adapters/engine.h",
       "#include \"../recorder/contactscope.h\"\n#include \"../core/at.h\""},
      {"src/core/at.h", "#include \"../adapters/engine.h\""},
      {"src/recorder/contactscope.h", ""}};
  EXPECT_THAT(include_violations(files),
              ElementsAre("src/adapters/engine.h:2: adapters must not use core",
                          "src/core/at.h:1: core must not use adapters"));
}

TEST(IncludeOrder, AFileOutsideTheFoldersIsCaught) {
  EXPECT_THAT(include_violations({{"src/loose.cpp", ""},
                                  {"src/CMakeLists.txt", ""},
                                  {"src/util/misc.h", ""},
                                  {"src/gl/context.h", ""}}),
              ElementsAre("src/loose.cpp: lies in no folder",
                          "src/util/misc.h: src/util is no folder of the house",
                          "src/gl/context.h: src/gl is no folder of the house"));
}

TEST(IncludeOrder, LinkingAFolderToTheRightIsCaught) {
  EXPECT_THAT(
      link_violations({{"src/core/CMakeLists.txt",
                        "contactscope_folder(core\n  SOURCES a.cpp query.cpp\n  LINK Eigen3::Eigen "
                        "contactscope::manifold)"},
                       {"render/draw/CMakeLists.txt",
                        "contactscope_folder(draw SOURCES a.cpp LINK contactscope::core "
                        "PRIVATE_LINK contactscope::scenario)"}}),
      ElementsAre("src/core/CMakeLists.txt: core must not link manifold",
                  "render/draw/CMakeLists.txt: draw must not link scenario"));
}

}  // namespace
}  // namespace contactscope::house
