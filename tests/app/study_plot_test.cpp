#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "app/program.h"
#include "image/png.h"

namespace contactscope::test {
namespace {

TEST(StudyPlot, IsANonemptyPictureOfTheRequestedSize) {
  const TemporaryFolder folder;
  const ProgramRun result =
      run("study reducers --cases 20 --size 640x360 --quiet --out '" + (folder / "out") + "'");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(files_below(folder / "out/study/reducers"),
              testing::ElementsAre(
                  "plot.png", "plot_deepest.png", "plot_flat.png", "plot_wrench.png", "results.csv",
                  "results.json", "results_deepest.csv", "results_deepest.json", "results_flat.csv",
                  "results_flat.json", "results_wrench.csv", "results_wrench.json"));
  for (const char* name : {"plot.png", "plot_deepest.png", "plot_flat.png", "plot_wrench.png"}) {
    const Image image = read_png(folder / ("out/study/reducers/" + std::string(name)));
    EXPECT_EQ(image.width, 640);
    EXPECT_EQ(image.height, 360);
    const auto white = std::ranges::count(image.rgb, std::uint8_t{255});
    EXPECT_GT(white, static_cast<long>(image.rgb.size() / 2)) << name;
    EXPECT_LT(white, static_cast<long>(image.rgb.size() - image.rgb.size() / 20)) << name;
  }
}

}  // namespace
}  // namespace contactscope::test
