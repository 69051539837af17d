#include <gmock/gmock.h>

#include <sstream>

#include "app/program.h"
#include "image/png.h"

/// Traces as other engines write them, with the facts that they have.
namespace contactscope::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// The whole trace in src/trace/README.md, with its two lines joined again.
std::string sample_of_the_reference() {
  std::istringstream in(read_text(CONTACTSCOPE_SOURCE_DIR "/src/trace/README.md"));
  std::string trace;
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with("    ") || (trace.empty() && !line.starts_with("    {\"schema\""))) {
      if (!trace.empty()) break;
      continue;
    }
    const std::string piece = line.substr(4);
    trace += (piece.starts_with("{\"frame\"") ? "\n" : "") + piece;
  }
  return trace + "\n";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(OtherEngines, TheSampleOfTheReferenceIsDrawnAlsoFromStandardInput) {
  const TemporaryFolder folder;
  const std::string file = folder.write("crate.jsonl", sample_of_the_reference());
  const std::string to = " --size 640x360 --out '";
  const ProgramRun from_file = run("render '" + file + "'" + to + (folder / "one") + "'");
  ASSERT_EQ(from_file.exit_code, 0) << from_file.err;
  const ProgramRun from_input = run("render -" + to + (folder / "two") + "'", "", file);
  ASSERT_EQ(from_input.exit_code, 0) << from_input.err;
  EXPECT_THAT(files_below(folder / "two"), ElementsAre("mine/crate/frame_0000.png"));
  EXPECT_TRUE(read_png(folder / "one/mine/crate/frame_0000.png") ==
              read_png(folder / "two/mine/crate/frame_0000.png"));
  EXPECT_THAT(run("doctor '" + file + "'").out, HasSubstr("ok  trace of mine/crate"));
}

TEST(OtherEngines, ErrorsOnStandardInputNameTheLine) {
  const TemporaryFolder folder;
  const std::string bad = folder.write(
      "bad", replaced(sample_of_the_reference(), "\"a\":\"ground\"", "\"a\":\"grund\""));
  const ProgramRun result = run("render - --out '" + (folder / "out") + "'", "", bad);
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("standard input:2:1: pairs[0].a: the header has no shape"));
  EXPECT_EQ(run("doctor -").exit_code, 2);  // an empty one
}

/// A crate falls in frame 1, and the first one is gone in frame 2.
TEST(OtherEngines, ShapesComeAndGo) {
  const std::string still = "\"position\":[0,0.98,0],\"quat_wxyz\":[1,0,0,0]}";
  const std::string trace =
      sample_of_the_reference() +
      "{\"frame\":1,\"time\":1,\"shapes\":{\"ball\":{\"type\":\"sphere\",\"vertices\":[[0,0,0]],"
      "\"radius\":0.5}},\"poses\":{\"crate\":{" +
      still + ",\"ball\":{" + still +
      "},\"pairs\":[]}\n"
      "{\"frame\":2,\"time\":2,\"poses\":{\"ball\":{" +
      still + "},\"pairs\":[]}\n";
  const TemporaryFolder folder;
  const std::string file = folder.write("falls.jsonl", trace);
  for (const char* layers : {"shapes,contacts,normals", "shapes,trail,ids"}) {
    const ProgramRun result = run("render '" + file + "' --size 320x180 --layers " + layers +
                                  " --panels none --out '" + (folder / "out") + "'");
    ASSERT_EQ(result.exit_code, 0) << result.err;
  }
  EXPECT_EQ(files_below(folder / "out").size(), 3u);

  const std::string gone = folder.write(
      "gone.jsonl", replaced(trace, "{\"position\":[0,0.98,0],\"quat_wxyz\":[1,0,0,0]}", "null"));
  EXPECT_EQ(run("doctor '" + gone + "'").exit_code, 2);
  const std::string unplaced = folder.write(
      "unplaced.jsonl",
      replaced(trace, "\"ground\":{\"position\":[0,0,0],\"quat_wxyz\":[1,0,0,0]},", ""));
  EXPECT_THAT(run("doctor '" + unplaced + "'").err,
              HasSubstr("pairs[0].a is 'ground', which has no pose in this frame"));
  const std::string twice =
      folder.write("twice.jsonl", replaced(trace, "\"ball\":{\"type\"", "\"crate\":{\"type\""));
  EXPECT_THAT(run("doctor '" + twice + "'").err, HasSubstr("there are two shapes 'crate'"));
}

/// Names in any language stay unchanged. A shape may be repeated, but only in the same form.
TEST(OtherEngines, NamesOfAnyLanguageAndRepeatedShapes) {
  const TemporaryFolder folder;
  std::string sample = sample_of_the_reference();
  for (const char* place : {"\"crate\":{\"type\"", "\"b\":\"crate\"", "\"crate\":{\"position\""})
    sample = replaced(sample, place, replaced(place, "crate", "ящик 箱"));
  const std::string file = folder.write("names.jsonl", sample);
  EXPECT_EQ(run("lint '" + file + "'").exit_code, 0);
  EXPECT_EQ(run("render '" + file + "' --size 320x180 --pair 'ящик 箱,ground' --out '" +
                (folder / "out") + "'")
                .exit_code,
            0);
  const std::string flipped = folder.write(
      "flipped.jsonl",
      replaced(sample, "\"normal\":[0,1,0],\"points\"", "\"normal\":[0,-1,0],\"points\""));
  EXPECT_THAT(run("lint '" + flipped + "'").out, HasSubstr("frame 0, ground-ящик 箱: "));

  const std::string ball =
      "{\"frame\":0,\"shapes\":{\"ball\":{\"type\":\"sphere\",\"vertices\":[[0,0,0]],\"radius\":";
  const std::string first = replaced(sample, "{\"frame\":0,", ball + "1}},");
  const std::string line = first.substr(first.find('\n') + 1);
  const std::string again =
      folder.write("again.jsonl", first + replaced(line, "\"frame\":0,", "\"frame\":1,"));
  EXPECT_EQ(run("doctor '" + again + "'").exit_code, 1) << "the same time twice";
  EXPECT_THAT(run("lint '" + again + "'").out, HasSubstr("[times_do_not_rise]"));
  const std::string grown =
      folder.write("grown.jsonl", first + replaced(replaced(line, "\"frame\":0,", "\"frame\":1,"),
                                                   "\"radius\":1", "\"radius\":2"));
  EXPECT_THAT(
      run("lint '" + grown + "'").err,
      HasSubstr("grown.jsonl:3:1: there are two shapes 'ball'; give each a name of its own"));
}

TEST(OtherEngines, FacesAreMadeOfConvexShapesAlone) {
  const TemporaryFolder folder;
  const std::string sample = sample_of_the_reference();
  const std::string mesh =
      folder.write("mesh.jsonl", replaced(sample, "\"type\":\"hull\"", "\"type\":\"mesh\""));
  EXPECT_THAT(run("doctor '" + mesh + "'").err,
              HasSubstr("mesh.jsonl:1:1: shape 'crate' is a mesh without 'faces'"));
  const std::string line = folder.write(
      "line.jsonl",
      replaced(sample,
               "[-1,-1,-1],[1,-1,-1],[-1,1,-1],[1,1,-1],[-1,-1,1],[1,-1,1],[-1,1,1],[1,1,1]",
               "[0,0,0],[1,0,0],[2,0,0],[3,0,0]"));
  EXPECT_THAT(run("doctor '" + line + "'").err, HasSubstr("none can be made of its 'vertices'"));
  const std::string moment =
      folder.write("moment.jsonl", replaced(sample, "\"engine\":\"mine\"", "\"poses_at\":\"now\""));
  EXPECT_THAT(run("doctor '" + moment + "'").err, HasSubstr("'before_step' or 'after_step'"));
  const std::string forces = folder.write(
      "forces.jsonl", replaced(sample, "\"engine\":\"mine\"", "\"impulses\":{\"unit\":\"N\"}"));
  EXPECT_THAT(run("doctor '" + forces + "'").err, HasSubstr("'impulses.step' is missing"));
}

/// A writer's slips that no other check would find.
TEST(OtherEngines, SlipsAreNamedWithTheirRemedy) {
  const TemporaryFolder folder;
  const std::string sample = sample_of_the_reference();
  const std::string cube = "\"type\":\"hull\",\"vertices\"";
  const std::string faces =
      "\"type\":\"box\",\"faces\":[[0,4,6,2],[1,3,7,5],[0,1,5,4],[2,6,7,3],[0,2,3,1],[4,5,7,6]],"
      "\"vertices\"";
  struct Slip {
    std::string from, to, record;
  };
  EXPECT_EQ(
      run("doctor '" + folder.write("good.jsonl", replaced(sample, cube, faces)) + "'").exit_code,
      0);
  for (const Slip& slip :
       {Slip{cube, replaced(faces, "[2,6,7,3]", "[3,7,6,2]"),
             "'crate': face 3 is wound inside out"},
        Slip{cube,
             "\"type\":\"box\",\"faces\":[[2,6,4,0],[5,7,3,1],[4,5,1,0],[3,7,6,2],[1,3,2,0],[6,7,5,"
             "4]],"
             "\"vertices\"",
             "'crate': all faces are wound inside out"},
        Slip{"\"b\":\"crate\",", "\"b\":\"crate\",\"kind\":\"box-plane\",",
             "pairs[0].kind is 'box-plane'"},
        Slip{"\"normal\":[0,1,0],\"points\"", "\"normal\":[0,1,0],\"axis\":\"faceA\",\"points\"",
             "manifolds[0].axis is 'faceA'"},
        Slip{"{\"frame\":0,", "{\"frame\":7,", ""},
        Slip{"\"engine\":\"mine\"", "\"frames\":0,\"engine\":\"mine\"", ""}}) {
    const std::string file = folder.write("bad.jsonl", replaced(sample, slip.from, slip.to));
    const ProgramRun result = run("doctor '" + file + "'");
    EXPECT_EQ(result.exit_code, slip.record.empty() ? 0 : 2) << slip.to;
    EXPECT_THAT(result.err, HasSubstr(slip.record));
  }
  const std::string seven =
      replaced(sample, "\"engine\":\"mine\"", "\"frames\":7,\"engine\":\"mine\"");
  const std::string late =
      folder.write("late.jsonl", replaced(seven, "{\"frame\":0,", "{\"frame\":7,"));
  EXPECT_THAT(run("doctor '" + late + "'").err,
              HasSubstr("the header says that there are 7 'frames'"));
}

/// Two crates next to each other on the ground.
std::string two_crates() {
  std::string trace = sample_of_the_reference();
  const std::size_t at = trace.find("\"crate\":{\"type\"");
  const std::string crate = trace.substr(at + 8, trace.find("}}}", at) + 1 - at - 8);
  trace = replaced(trace, "\"crate\":{\"type\"", "\"other\":" + crate + ",\"crate\":{\"type\"");
  const std::string pose = "\"quat_wxyz\":[1,0,0,0]}";
  return replaced(trace, "\"crate\":{\"position\"",
                  "\"other\":{\"position\":[4,1,0]," + pose + ",\"crate\":{\"position\"");
}

TEST(OtherEngines, APairAloneLooksLikeATraceWithoutTheRest) {
  const TemporaryFolder folder;
  const std::string both = folder.write("both.jsonl", two_crates());
  const auto draw = [&](const std::string& file, const std::string& to, const std::string& more) {
    const ProgramRun result =
        run("render '" + file + "' --size 320x180 --out '" + (folder / to) + "' " + more);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return read_png(folder / (to + "/mine/crate/frame_0000.png"));
  };
  const Image whole = draw(both, "whole", "");
  const Image pair = draw(both, "pair", "--pair crate,ground");
  const Image shapes = draw(both, "shapes", "--shapes crate,ground");
  EXPECT_TRUE(whole != pair);
  EXPECT_TRUE(pair == shapes);
  EXPECT_TRUE(pair == draw(folder.write("one.jsonl", sample_of_the_reference()), "one", ""));
  EXPECT_TRUE(whole != draw(both, "camera", "--eye 8,3,5 --target 0,0,0 --fov 30"));
  const ProgramRun unknown =
      run("render '" + both + "' --pair crate,grund --out '" + (folder / "out") + "'");
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("did you mean 'ground'"));
}

TEST(OtherEngines, ViewsComeFromAFileOfViewsOnly) {
  const TemporaryFolder folder;
  const std::string file = folder.write("both.jsonl", two_crates());
  const std::string views = folder.write("views.toml",
                                         "[[views]]\nname = \"far\"\neye = [9, 4, 9]\n"
                                         "[[views]]\nname = \"near\"\neye = [3, 2, 3]\n");
  const std::string to = "' --size 320x180 --out '" + (folder / "out") + "'";
  ASSERT_EQ(run("render '" + file + "' --view '" + views + to).exit_code, 0);
  EXPECT_EQ(files_below(folder / "out").size(), 2u);
  ASSERT_EQ(run("render '" + file + "' --view '" + views + ":near" + to).exit_code, 0);
  const ProgramRun unknown = run("render '" + file + "' --view '" + views + ":nearer" + to);
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("it has far, near"));
}

TEST(OtherEngines, LayersWithoutDataAreReported) {
  const TemporaryFolder folder;
  const std::string file = folder.write("crate.jsonl", sample_of_the_reference());
  const ProgramRun result = run(
      "render '" + file + "' --size 320x180 --layers shapes,contacts,sat_axes,impulses --out '" +
      (folder / "out") + "'");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("nothing to draw in layers sat_axes, impulses"));
}

/// The contacts of an engine can be a baseline, as those of a scenario can.
TEST(OtherEngines, TracesAreStoredAndChecked) {
  const TemporaryFolder folder;
  const std::string file = folder.write("crate.jsonl", sample_of_the_reference());
  const std::string check =
      "check --snapshots '" + (folder / "stored") + "' --out '" + (folder / "out") + "' ";
  ASSERT_EQ(run(check + "--update '" + file + "'", "CI=").exit_code, 0);
  EXPECT_THAT(files_below(folder / "stored"),
              ElementsAre("mine/crate/frame_0000.png", "mine/crate/trace.jsonl"));
  EXPECT_EQ(run(check + "'" + file + "'").exit_code, 0);
  const std::string moved = folder.write(
      "moved.jsonl", replaced(sample_of_the_reference(), "[1,-0.02,-1]", "[0.9,-0.02,-1]"));
  const ProgramRun result = run(check + "'" + moved + "'");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.out, HasSubstr("point 1 moved 100 mm along -x"));
  // A check of all scenarios does not remove it.
  const std::string all = folder.write("all/one.toml", small_scenario());
  EXPECT_THAT(run(check + "--scenarios '" + (folder / "all") + "'").out,
              testing::Not(HasSubstr("mine/crate")));
}

/// Reducers on the manifold of an engine that keeps six points of a face.
TEST(OtherEngines, ReducersAreTriedOnTheirPoints) {
  const TemporaryFolder folder;
  const std::string six = replaced(sample_of_the_reference(), "{\"position\":[-1,-0.02,-1]",
                                   "{\"position\":[0,-0.02,-1],\"separation\":-0.02},"
                                   "{\"position\":[0,-0.02,1],\"separation\":-0.02},"
                                   "{\"position\":[-1,-0.02,-1]");
  const std::string file = folder.write("crate.jsonl", six);
  const ProgramRun result = run("explore '" + file + "' --table");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("optimal"));
  EXPECT_THAT(result.err, HasSubstr("1 manifold of at most 6 points"));
  EXPECT_EQ(run("explore '" + file + "' --table --reducer bets").exit_code, 2);
}

}  // namespace
}  // namespace contactscope::test
