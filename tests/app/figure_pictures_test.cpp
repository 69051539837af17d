#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <filesystem>

#include "app/program.h"
#include "image/png.h"
#include "support/temporary_folder.h"

namespace contactscope::test {
namespace {

using testing::HasSubstr;
using testing::Not;

const std::string kFrame = "hull/face_contact/frame_0012.png";

/// Renders one frame with these options.
struct FigurePicture {
  TemporaryFolder folder;
  ProgramRun result;
  std::string path = folder / kFrame;

  explicit FigurePicture(const std::string& options)
      : result(run("render hull/face_contact --frames 12 --out '" + folder.path().string() + "' " +
                   options)) {
    EXPECT_EQ(result.exit_code, 0) << result.err;
  }
  Image image() const { return read_png(path); }
};

TEST(FigurePictures, AColumnOfAPaperIsAsWideAsItIs) {
  // 84 mm at 100 pixels an inch.
  const Image image = FigurePicture("--width 84mm --font-size 8pt --dpi 100").image();
  EXPECT_EQ(image.width, 331);
  EXPECT_GT(image.height, image.width) << "panels below the view";
  const FigurePicture low("--width 84mm --height 60mm --dpi 100 --panels summary,contact_plane");
  EXPECT_EQ(low.image().height, 236);
  EXPECT_THAT(low.result.err, HasSubstr("no room for contact_plane; make --height larger"));
}

TEST(FigurePictures, ATransparentGroundHasAlpha) {
  const FigurePicture opaque("--size 320x180 --bare"),
      clear("--size 320x180 --bare --background transparent");
  constexpr std::size_t kColorType = 25;  // of a PNG: 2 RGB, 6 RGBA
  EXPECT_EQ(read_text(opaque.path)[kColorType], 2);
  EXPECT_EQ(read_text(clear.path)[kColorType], 6);
}

TEST(FigurePictures, BareIsWithoutTitleLegendAndFooterAlike) {
  EXPECT_EQ(FigurePicture("--size 320x180 --bare").image(),
            FigurePicture("--size 320x180 --no-title --no-legend --no-footer").image());
}

TEST(FigurePictures, ThemesAndCamerasChangeThePicture) {
  const Image plain = FigurePicture("--size 320x180").image();
  const Image dark = FigurePicture("--size 320x180 --theme dark").image();
  EXPECT_EQ(int(plain.rgb[0]), 255);
  EXPECT_EQ(int(dark.rgb[0]), 0x14);
  EXPECT_EQ(FigurePicture("--size 320x180 --camera 4,2,4,0,0,0,30").image(),
            FigurePicture("--size 320x180 --eye 4,2,4 --target 0,0,0 --fov 30").image());
  EXPECT_NE(FigurePicture("--size 320x180 --orthographic").image(), plain);
}

std::string scenario_titled(const std::string& title) {
  std::string text = small_scenario();
  const std::size_t at = text.find("title");
  return text.replace(at, text.find('\n', at) - at, "title = \"" + title + "\"");
}

TEST(FigurePictures, CharactersThatNoFontHasAreReported) {
  const TemporaryFolder folder;
  const std::string file = folder.write("my/box.toml", scenario_titled("箱"));
  const ProgramRun result =
      run("render '" + file + "' --size 160x90 --out '" + (folder / "out") + "'");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("no font has the character 箱 (U+7BB1)"));
  EXPECT_THAT(result.err, HasSubstr("--font FILE"));
}

TEST(FigurePictures, AnEmptyTitleIsAllowed) {
  const TemporaryFolder folder;
  const std::string file = folder.write("my/box.toml", scenario_titled(""));
  const ProgramRun result =
      run("render '" + file + "' --size 160x90 --out '" + (folder / "out") + "'");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const std::string trace = folder.write("my/box.jsonl", run("trace '" + file + "'").out);
  EXPECT_EQ(run("render '" + trace + "' --panels none --layers shapes --size 160x90 --out '" +
                (folder / "of_trace") + "'")
                .exit_code,
            0);
  ASSERT_EQ(run("render '" + file + "' --panels none --layers shapes --size 160x90 --out '" +
                (folder / "out") + "'")
                .exit_code,
            0);
  EXPECT_EQ(read_png(folder / "of_trace/my/box/frame_0001.png"),
            read_png(folder / "out/my/box/frame_0001.png"));
}

/// Each half of the page has one run's contact points.
TEST(DiffVerb, DrawsBothRunsWhereTheyPart) {
  const TemporaryFolder folder;
  const auto trace = [&](const std::string& reducer) {
    const std::string arguments = "trace hull/eight_points_to_four --frames 8 --reducer " + reducer;
    return "'" + folder.write(reducer + ".jsonl", run(arguments).out) + "'";
  };
  const std::string area = trace("area"), first = trace("first");
  const std::string file = folder / "parting.png";
  EXPECT_EQ(run("diff " + area + " " + area + " --picture '" + file + "'").exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(file));  // they do not part
  EXPECT_EQ(run("diff " + area + " " + first + " --picture '" + file + "'").exit_code, 1);
  const Image picture = read_png(file);
  ASSERT_EQ(picture.width, 1280);
  std::array<int, 2> orange{};
  std::array<long, 2> column{};
  for (std::size_t i = 0; i < picture.rgb.size() / 3; ++i) {
    if (picture.rgb[3 * i] < picture.rgb[3 * i + 2] + 150) continue;
    const long x = static_cast<long>(i) % picture.width, half = picture.width / 2;
    const std::size_t side = x < half ? 0 : 1;
    ++orange[side];
    column[side] += x % half;
  }
  EXPECT_GT(orange[0], 300);
  EXPECT_GT(orange[1], 300);
  // One camera, but other points.
  EXPECT_GT(std::abs(column[0] / orange[0] - column[1] / orange[1]), 2);
}

}  // namespace
}  // namespace contactscope::test
