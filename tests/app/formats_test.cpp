#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "app/program.h"
#include "image/encoding.h"
#include "image/png.h"
#include "support/png_text.h"

// `render --format`: the files that it writes, and their metadata.
namespace contactscope::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

class Formats : public testing::Test {
 protected:
  ProgramRun render(const std::string& options, const std::string& environment = "") {
    return run(
        "render '" + scenario_ + "' --size 160x90 --out '" + (folder_ / "out") + "' " + options,
        environment);
  }
  std::string text(const std::string& file) { return read_text(folder_ / ("out/" + file)); }
  std::set<std::string> files() { return files_below(folder_ / "out"); }

  TemporaryFolder folder_;
  std::string scenario_ = folder_.write("group/idea.toml", small_scenario());
};

TEST_F(Formats, VectorsAloneOpenNoOpenGL) {
  const ProgramRun result = render("--format svg,pdf --frames 1 --verbose");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(files(), ElementsAre("group/idea/frame_0001.pdf", "group/idea/frame_0001.svg"));
  EXPECT_THAT(result.err, AllOf(Not(HasSubstr("open OpenGL")), Not(HasSubstr("read back"))));
  EXPECT_THAT(text("group/idea/frame_0001.svg"),
              AllOf(HasSubstr("<svg"), HasSubstr("--format svg")));
  EXPECT_THAT(text("group/idea/frame_0001.pdf"), StartsWith("%PDF-"));
}

// Two prisms that overlap by 353 mm, seen along their edges: their difference is flat.
TEST_F(Formats, ThePanelOfGjkSaysThatPrismsOverlap) {
  const auto prism = [](const std::vector<std::string>& corners) {
    std::string vertices;
    for (const char* z : {"-0.2", "0.2"})
      for (const std::string& corner : corners) vertices += "[" + corner + ", " + z + "], ";
    return "type = \"hull\"\nvertices = [" + vertices + "]\n";
  };
  scenario_ = folder_.write(
      "group/idea.toml",
      "title = \"GJK\"\n[time]\nframes = 5\n[shapes.block]\n" +
          prism({"-0.6, -0.4", "0.5, -0.4", "0.7, 0", "0.2, 0.45", "-0.6, 0.3"}) +
          "[shapes.wedge]\n" + prism({"0, -0.5", "-0.55, 0.3", "0.5, 0.35"}) +
          "position = [0.45, 0.35, 0]\nrotation = { axis = [0, 0, 1], degrees = -15 }\n"
          "[pipeline]\npenetration = \"epa\"\n"
          "[[views]]\nlayers = [\"simplex\"]\npanels = [\"minkowski\"]\nstory = \"gjk_steps\"\n");
  ASSERT_EQ(
      run("render '" + scenario_ + "' --format svg --frames 4 --out '" + (folder_ / "out") + "'")
          .exit_code,
      0);
  EXPECT_NE(text("group/idea/frame_0004.svg").find(">GJK: overlap<"), std::string::npos);
}

TEST_F(Formats, AnchorsAreWrittenNextToThePicture) {
  const ProgramRun result = render("--format svg --frames 1 --anchors");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(files(),
              ElementsAre("group/idea/frame_0001.anchors.json", "group/idea/frame_0001.svg"));
  const auto all = nlohmann::json::parse(text("group/idea/frame_0001.anchors.json"));
  EXPECT_EQ(all["scenario"], "group/idea");
  EXPECT_EQ(all["frame"], 1);
  EXPECT_EQ(all["size"], nlohmann::json({160, 90}));
  EXPECT_THAT(text("group/idea/frame_0001.svg"), Not(HasSubstr("--anchors")));
  const ProgramRun strip = render("--strip 2 --anchors");
  EXPECT_EQ(strip.exit_code, 2);
  EXPECT_THAT(strip.err, HasSubstr("leave out --strip"));
}

TEST_F(Formats, SeveralAtOnceAreListed) {
  const ProgramRun result = render("--format svg,png,apng,webp --json");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(files(), ElementsAre("group/idea/frame_0000.png", "group/idea/frame_0000.svg",
                                   "group/idea/frame_0001.png", "group/idea/frame_0001.svg",
                                   "group/idea/sequence.apng", "group/idea/sequence.webp"));
  std::set<std::string> record;
  const nlohmann::json json = nlohmann::json::parse(result.out);
  for (const std::string path : json.at("group/idea"))
    record.insert(path.substr((folder_ / "out/").size()));
  EXPECT_EQ(record, files());
  EXPECT_THAT(result.err, HasSubstr("6 files of 2 pictures"));
  EXPECT_THAT(text("group/idea/sequence.webp"), AllOf(StartsWith("RIFF"), HasSubstr("ANIM")));
  // Its first picture is the PNG of the first frame.
  EXPECT_EQ(read_png(folder_ / "out/group/idea/sequence.apng"),
            read_png(folder_ / "out/group/idea/frame_0000.png"));
}

TEST_F(Formats, AFileOfOneFrameHasItsName) {
  ASSERT_EQ(render("--format webp,apng --frames 1").exit_code, 0);
  EXPECT_THAT(files(), ElementsAre("group/idea/frame_0001.apng", "group/idea/frame_0001.webp"));
  EXPECT_THAT(text("group/idea/frame_0001.webp"), Not(HasSubstr("ANIM")));
}

TEST_F(Formats, APngContainsTheCommandThatMadeIt) {
  ASSERT_EQ(render("--layers shapes,contacts --frames 1 --quiet --jobs 1").exit_code, 0);
  const PngText said = texts_of_png(folder_ / "out/group/idea/frame_0001.png");
  const std::map<std::string, std::string> all(said.begin(), said.end());
  EXPECT_THAT(all.at("Software"), StartsWith("contactscope "));
  EXPECT_EQ(all.at("Scenario"), "group/idea");
  EXPECT_EQ(all.at("Frame"), "1");
  EXPECT_EQ(all.at("View"), "main");
  EXPECT_EQ(all.at("Scenario SHA-256"), sha256(small_scenario()));
  EXPECT_EQ(all.at("Command"), "contactscope render " + scenario_ +
                                   " --size 160x90 --layers shapes,contacts --frames 1");
  const std::string before = text("group/idea/frame_0001.png");
  ASSERT_EQ(run(all.at("Command").substr(13) + " --out '" + (folder_ / "again") + "'").exit_code,
            0);
  EXPECT_TRUE(read_text(folder_ / "again/group/idea/frame_0001.png") == before);
}

TEST_F(Formats, UnknownFormatsAreRefusedWithTheKnownOnes) {
  const ProgramRun result = render("--format gif");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, AllOf(HasSubstr("--format 'gif'"), HasSubstr("png"), HasSubstr("svg"),
                                HasSubstr("apng"), HasSubstr("webp")));
  EXPECT_THAT(files(), IsEmpty());
}

TEST_F(Formats, AStripIsOnePictureInEachFormat) {
  const ProgramRun result =
      run("render hull/clip_step_by_step --strip 4 --columns 2 --size 640x480 "
          "--format png,svg --json --out '" +
          (folder_ / "out") + "'");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(files(),
              ElementsAre("hull/clip_step_by_step/strip.png", "hull/clip_step_by_step/strip.svg"));
  const Image image = read_png(folder_ / "out/hull/clip_step_by_step/strip.png");
  EXPECT_EQ(image.width, 640);
  EXPECT_EQ(image.height, 480);
  const PngText said = texts_of_png(folder_ / "out/hull/clip_step_by_step/strip.png");
  EXPECT_THAT(said, testing::Contains(std::pair<std::string, std::string>("Frames", "0, 2, 3, 5")));
}

TEST_F(Formats, ASheetHasAllScenariosOfAGroup) {
  folder_.write("group/other.toml", small_scenario());
  const ProgramRun result = run("render '" + (folder_ / "group") +
                                "' --sheet --format svg --out '" + (folder_ / "out") + "'");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(files(), ElementsAre("group/sheet.svg"));
  EXPECT_THAT(text("group/sheet.svg"), AllOf(HasSubstr("group/idea"), HasSubstr("group/other")));
}

TEST_F(Formats, ConflictingOptionsAreRefused) {
  for (const auto& [options, record] :
       {std::pair{"--strip 0", "2 to 64"},
        {"--strip 4 --format apng", "--strip is one picture, and --format apng"},
        {"--sheet --format apng,png", "--sheet is one picture"},
        {"--strip 4 --sheet", "leave out one"},
        {"--columns 2", "--strip or --sheet"},
        {"--strip 2 --columns 0", "1 to 64"}}) {
    const ProgramRun result = render(options);
    EXPECT_EQ(result.exit_code, 2) << options;
    EXPECT_THAT(result.err, HasSubstr(record)) << options;
  }
  EXPECT_THAT(files(), IsEmpty());
}

}  // namespace
}  // namespace contactscope::test
