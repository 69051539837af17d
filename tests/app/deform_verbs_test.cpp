// Meshes that deform, through the program.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/program.h"
#include "image/png.h"

namespace contactscope::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

const char* const kWavyFloor = R"(title = "A wavy floor"
source = "none"
[time]
frames = 3
dt = 0.25
[shapes.floor]
type = "mesh"
grid = { size = 2, cells = 2 }
motion.deform = { wave = { axis = [1, 0, 0], direction = [0, 1, 0], amplitude = 0.1, wavelength = 2, speed = 1 } }
[shapes.ball]
type = "sphere"
radius = 0.5
position = [0, 0.45, 0]
)";

TEST(DeformVerbs, ATraceGivesThePicturesOfItsScenario) {
  const TemporaryFolder folder;
  // The default view of a trace.
  const std::string view = "[[views]]\nfocus = \"shapes\"\npanels = [\"summary\"]\n";
  const std::string scenario = folder.write("group/idea.toml", kWavyFloor + view);
  const std::string trace = folder.write("trace.jsonl", run("trace '" + scenario + "'").out);
  const std::string size = " --size 320x180 --layers shapes --out '";
  ASSERT_EQ(run("render '" + scenario + "'" + size + (folder / "one") + "'").exit_code, 0);
  ASSERT_EQ(run("render '" + trace + "'" + size + (folder / "other") + "'").exit_code, 0);
  const auto picture = [&](const char* out, const char* frame) {
    return read_png(folder / (std::string(out) + "/group/idea/" + frame));
  };
  EXPECT_TRUE(picture("one", "frame_0002.png") == picture("other", "frame_0002.png"));
  EXPECT_FALSE(picture("one", "frame_0002.png") == picture("one", "frame_0000.png"));
}

TEST(DeformVerbs, ATraceWithoutAllVerticesIsNamedByLine) {
  const TemporaryFolder folder;
  const std::string scenario = folder.write("group/idea.toml", kWavyFloor);
  std::string bad = run("trace '" + scenario + "'").out;
  const std::size_t deformed = bad.rfind("\"deformed\"");
  ASSERT_NE(deformed, std::string::npos);
  const std::size_t first = bad.find("[[", deformed) + 1;
  bad.erase(first, bad.find("],", first) + 2 - first);  // one vertex
  const std::string file = folder.write("bad.jsonl", bad);
  const ProgramRun result = run("render '" + file + "' --out '" + (folder / "out") + "'");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err,
              HasSubstr("bad.jsonl:4:1: deformed.floor has 8 'vertices', and the header's shape 9; "
                        "give each of them its place in this frame"));
  EXPECT_THAT(files_below(folder / "out"), IsEmpty());
}

TEST(DeformVerbs, ExploreRefusesThemWithAReason) {
  const TemporaryFolder folder;
  const std::string scenario = folder.write("group/idea.toml", kWavyFloor);
  const ProgramRun result = run("explore '" + scenario + "' --table");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("'floor' has no such measure, because it deforms; leave out "
                                    "its 'deform'"));
}

}  // namespace
}  // namespace contactscope::test
