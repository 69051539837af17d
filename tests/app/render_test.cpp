#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "app/program.h"
#include "image/png.h"
#include "support/osmesa.h"

namespace contactscope::test {
namespace {

using testing::AllOf;
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

// Pixels, not bytes: once in some ten thousand pictures ISA-L chooses another match of equal bytes.
TEST(Render, EglAndOsmesaGiveTheSamePixelsForEveryScenario) {
  if (!test::osmesa_is_installed()) GTEST_SKIP() << "no OSMesa";
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
    EXPECT_TRUE(read_png(folder / ("egl/" + file)) == read_png(folder / ("osmesa/" + file)))
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

TEST(Render, NoneMeansNoLayersAndNoPanels) {
  const TemporaryFolder folder;
  const auto picture = [&](const std::string& options, const char* name) {
    const ProgramRun result = run("render hull/face_contact --frames 12 --verbose " + options +
                                  " --out '" + (folder / name) + "'");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    const bool panels = result.err.find("start Dear ImGui") != std::string::npos;
    EXPECT_EQ(panels, options.find("--panels none") == std::string::npos) << options;
    return read_png(folder / (std::string(name) + "/hull/face_contact/frame_0012.png"));
  };
  const auto is_white = [](const Image& image, int x, int y) {
    const std::size_t at = 3 * static_cast<std::size_t>(y * image.width + x);
    return image.rgb[at] == 255 && image.rgb[at + 1] == 255 && image.rgb[at + 2] == 255;
  };
  const auto drawn_in_view = [&](const Image& image) {
    int pixels = 0;  // between title and source, left of the column of panels
    for (int y = 80; y < 600; ++y) {
      for (int x = 30; x < 850; ++x) pixels += !is_white(image, x, y);
    }
    return pixels;
  };
  EXPECT_GT(drawn_in_view(picture("--panels none", "a")), 10000);
  EXPECT_EQ(drawn_in_view(picture("--panels none --layers none", "b")), 0);
  EXPECT_GT(drawn_in_view(picture("--layers none", "c")), 10000) << "panels have the whole picture";
  EXPECT_THAT(run("render hull/face_contact --layers none,shapes").err,
              HasSubstr("'none' excludes all others"));
}

TEST(Render, VerboseListsWhatRanAndWhatWasLeftOut) {
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

/// The default view of a trace.
std::string view_of_traces() {
  return "[[views]]\nfocus = \"shapes\"\npanels = [\"summary\"]\nlayers = [\"shapes\", "
         "\"reference_face\", \"incident_face\", \"clip_polygons\", \"contacts\", "
         "\"reduced\", \"normals\"]\n";
}

TEST(Render, TraceGivesThePicturesOfItsScenario) {
  const TemporaryFolder folder;
  const std::string scenario = folder.write("group/idea.toml", small_scenario() + view_of_traces());
  const std::string trace = folder.write("other/name.jsonl", run("trace '" + scenario + "'").out);
  const std::string size = " --size 640x360 --out '";
  ASSERT_EQ(run("render '" + scenario + "'" + size + (folder / "one") + "'").exit_code, 0);
  const ProgramRun drawn = run("render '" + trace + "'" + size + (folder / "two") + "'");
  ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
  EXPECT_THAT(files_below(folder / "two"),
              ElementsAre("group/idea/frame_0000.png", "group/idea/frame_0001.png"));
  for (const char* file : {"/group/idea/frame_0000.png", "/group/idea/frame_0001.png"})
    EXPECT_EQ(read_png(folder / "one" + file), read_png(folder / "two" + file)) << file;
}

// The faces of all pairs would hide the bodies.
TEST(Render, AHeapsTraceShowsItsBodiesAndContacts) {
  const TemporaryFolder folder;
  const auto drawn = [&](const std::string& scenario, const std::string& layers) {
    const std::string trace = folder.write(
        "heap.jsonl", run("trace 'scenarios/" + scenario + "' --frames 90 --quiet").out);
    run("render '" + trace + "' --format svg" + layers + " --out '" + folder.path().string() + "'");
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path()))
      if (entry.path().extension() == ".svg") {
        std::ifstream in(entry.path());
        const std::string picture{std::istreambuf_iterator<char>(in), {}};
        std::filesystem::remove(entry.path());
        return picture;
      }
    return std::string();
  };
  const std::string heap = "heap/boulder_in_gravel.toml";
  EXPECT_THAT(drawn(heap, ""), AllOf(HasSubstr("contact point"), Not(HasSubstr("reference face"))));
  EXPECT_THAT(drawn(heap, " --layers shapes,reference_face"), HasSubstr("reference face"));
}

TEST(Render, WhereMarksThePairsOfAHeapAndKeepsTheOthers) {
  const TemporaryFolder folder;
  const auto title_of = [&](const std::string& options) {
    EXPECT_EQ(run("render scenarios/heap/bullet_twenty.jsonl --frames 1 --format svg --out '" +
                  folder.path().string() + "'" + options)
                  .exit_code,
              0);
    std::ifstream in(folder / "heap/bullet_twenty/frame_0001.svg");
    return std::string{std::istreambuf_iterator<char>(in), {}};
  };
  const std::string all = title_of(""), marked = title_of(" --where 'overlap > 0.4 mm'");
  for (const std::string& picture : {all, marked})
    EXPECT_THAT(picture, HasSubstr("105 points, the deepest overlaps by 0.570 mm"));
  // Those of the panel `worst`: 0.570, 0.430, 0.424, 0.204 mm.
  EXPECT_THAT(marked, AllOf(HasSubstr("pairs for which the condition holds"), HasSubstr("!3"),
                            Not(HasSubstr("!4"))));
}

/// The overlaps of another pair are the largest.
TEST(Render, TheWorstIsThePairAndTheFrameThatLintNamesFirst) {
  const TemporaryFolder folder;
  std::ifstream in(CONTACTSCOPE_SOURCE_DIR "/scenarios/heap/bullet_twenty.jsonl");
  std::string text, line;
  while (std::getline(in, line)) {
    nlohmann::ordered_json frame = nlohmann::ordered_json::parse(line);
    if (frame.contains("pairs") && frame["frame"] == 1)
      for (auto& pair : frame["pairs"])
        if (pair["a"] == "tray" && pair["b"] == "box_2")
          for (auto& component : pair["manifolds"][0]["normal"])
            component = -component.get<double>();
    text += frame.dump() + "\n";
  }
  const std::string trace = folder.write("flipped.jsonl", text);
  const auto picture = [&](const std::string& options, const std::string& frame) {
    const std::string out = folder / ("out" + std::to_string(options.size()));
    EXPECT_EQ(run("render '" + trace + "' --format svg --out '" + out + "'" + options).exit_code,
              0);
    EXPECT_THAT(files_below(out), ElementsAre("heap/bullet_twenty/frame_" + frame + ".svg"));
    std::ifstream file(out + "/heap/bullet_twenty/frame_" + frame + ".svg");
    return std::string{std::istreambuf_iterator<char>(file), {}};
  };
  EXPECT_THAT(picture(" --focus worst", "0001"),
              AllOf(HasSubstr("flipped normals"), HasSubstr("!1  tray and box 2")));
  // Nothing is wrong in the frame that is chosen.
  EXPECT_THAT(picture(" --focus worst --frames 0", "0000"),
              AllOf(HasSubstr("in view: the largest overlap"), Not(HasSubstr("!1  "))));
}

TEST(Render, FramesOfATraceAreChosenByNumber) {
  const TemporaryFolder folder;
  const std::string scenario = folder.write("group/idea.toml", small_scenario());
  const std::string trace =
      folder.write("late.jsonl", run("trace '" + scenario + "' --frames 1").out);
  const std::string to = "' --size 64x64 --out '" + (folder / "out") + "'";
  EXPECT_EQ(run("render '" + trace + to + " --frames 0").exit_code, 2);
  EXPECT_EQ(run("render '" + trace + to + " --frames 1").exit_code, 0);
  EXPECT_THAT(files_below(folder / "out"), ElementsAre("group/idea/frame_0001.png"));
}

TEST(Render, TraceThatDoesNotFitTogetherIsNamedByLine) {
  const TemporaryFolder folder;
  const std::string scenario = folder.write("group/idea.toml", small_scenario());
  const std::string good = run("trace '" + scenario + "'").out;
  struct Slip {
    const char *from, *to, *record;
  };
  for (const Slip& slip :
       {Slip{"\"a\":\"slab\"", "\"a\":\"slap\"",
             ".jsonl:3:1: pairs[0].a: the header has no shape "
             "'slap'; did you mean 'slab'?"},
        Slip{"\"quat_wxyz\":[1.0,", "\"quat_wxyz\":[2.0,",
             "'quat_wxyz' has length 2; it must be 1"},
        Slip{"\"frame\":1,", "\"frame\":0,", "rising order"},
        Slip{"\"state\":\"touching\"", "\"state\":\"touched\"", "'touching' or 'separated'"}}) {
    std::string bad = good;
    const std::size_t at = bad.rfind(slip.from);
    ASSERT_NE(at, std::string::npos) << slip.from;
    const std::string file =
        folder.write("bad.jsonl", bad.replace(at, std::string(slip.from).size(), slip.to));
    const ProgramRun result = run("render '" + file + "' --out '" + (folder / "out") + "'");
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.err, HasSubstr(slip.record));
    EXPECT_EQ(run("doctor '" + file + "'").exit_code, 2);
  }
  EXPECT_THAT(files_below(folder / "out"), IsEmpty());
}

TEST(Render, RowsWithoutRoomInPanelsAreNamed) {
  const TemporaryFolder folder;
  std::string scenario = "title = \"nine\"\n";
  for (int i = 0; i < 9; ++i) {
    scenario += "[shapes.s" + std::to_string(i) +
                "]\ntype = \"sphere\"\nradius = 0.3\nposition = [" + std::to_string(0.5 * i) +
                ", 0, 0]\n";
  }
  const std::string file = folder.write(
      "group/idea.toml", scenario + "[[views]]\npanels = [\"summary\", \"contact_plane\"]\n");
  const std::string to = "render '" + file + "' --verbose --out '" + (folder / "out") + "'";
  EXPECT_THAT(run(to + " --size 1280x720").err,
              testing::ContainsRegex("left out: .* pairs of panel summary"));
  EXPECT_THAT(run(to + " --size 320x180").err, HasSubstr("panel contact_plane"));
}

TEST(Render, UnwritableFolderIsTroubleAndNamesTheFile) {
  const ProgramRun result = run("render hull/coherent_points --size 320x180 --out /proc/nowhere");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("/proc/nowhere"));
}

TEST(Render, RequestToStopLeavesWholeFilesOnly) {
  const TemporaryFolder folder;
  std::string scenario = small_scenario();
  scenario.replace(scenario.find("frames = 2"), 10, "frames = 8000");
  folder.write("long.toml", scenario);
  const std::string stop = "timeout --signal=TERM --preserve-status 2";
  const ProgramRun result =
      run("render '" + (folder / "long.toml") + "' --size 320x180 --out '" + (folder / "out") + "'",
          stop);
  EXPECT_EQ(result.exit_code, 143) << "as of a program that SIGTERM ended";
  EXPECT_THAT(result.err, HasSubstr("interrupted"));
  const std::set<std::string> files = files_below(folder / "out");
  EXPECT_GE(files.size(), 1u);
  EXPECT_LT(files.size(), 8000u);
  for (const std::string& file : files) {
    EXPECT_THAT(file, testing::EndsWith(".png"));
    EXPECT_NO_THROW(read_png(folder / ("out/" + file))) << file;
  }
}

TEST(Render, BackendComesFromTheEnvironmentToo) {
  if (!test::osmesa_is_installed()) GTEST_SKIP() << "no OSMesa";
  const TemporaryFolder folder;
  const ProgramRun result =
      run("render hull/coherent_points --verbose --size 320x180 --out '" + (folder / "out") + "'",
          "CONTACTSCOPE_BACKEND=osmesa");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("OpenGL through OSMesa"));
}

TEST(Doctor, FullDiskIsTrouble) { EXPECT_EQ(run_on_full_disk("doctor"), 2); }

}  // namespace
}  // namespace contactscope::test
