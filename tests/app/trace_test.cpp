#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "app/program.h"
#include "trace/json.h"

namespace contactscope::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

TEST(Trace, PrintsAHeaderAndALineForEachFrame) {
  const ProgramRun result = run("trace hull/face_contact");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, IsEmpty());
  std::istringstream in(result.out);
  const trace::Trace read = trace::read_trace(in, "output");
  EXPECT_EQ(read.header.scenario, "hull/face_contact");
  EXPECT_EQ(read.header.frames, 24);
  ASSERT_EQ(read.frames.size(), 24u);
  ASSERT_EQ(read.frames[12].pairs.size(), 1u);
  const trace::Pair& pair = read.frames[12].pairs[0];
  EXPECT_EQ(pair.state, "touching");
  EXPECT_TRUE(pair.sat);
  ASSERT_TRUE(pair.clip);
  EXPECT_EQ(pair.clip->steps.size(), 4u);
}

TEST(Trace, FramesSelectsAndReducerOverrides) {
  const ProgramRun result = run("trace hull/eight_points_to_four --frames 4:8:4 --reducer none");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  std::istringstream in(result.out);
  const trace::Trace read = trace::read_trace(in, "output");
  ASSERT_EQ(read.frames.size(), 2u);
  EXPECT_EQ(read.frames[0].frame, 4);
  EXPECT_EQ(read.frames[1].frame, 8);
  EXPECT_EQ(read.frames[0].pairs[0].manifolds[0].points.size(), 8u);
}

TEST(Trace, OpensNoOpenGlLibrary) {
  // The loader reports every library that it opens.
  const ProgramRun result = run("trace hull/face_contact", "LD_DEBUG=files");
  ASSERT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("libc.so"));  // the report is there
  for (const char* library : {"libEGL", "libOSMesa", "libGL", "libGLX", "swrast"}) {
    EXPECT_THAT(result.err, Not(HasSubstr(library)));
  }
}

TEST(Trace, WorksWhereEveryRouteToOpenGlIsBroken) {
  const TemporaryFolder folder;
  for (const char* library : {"libEGL.so.1", "libOSMesa.so.8"}) {
    folder.write(library, "no library\n");
  }
  const std::string broken = "LD_LIBRARY_PATH='" + folder.path().string() + "'";
  EXPECT_EQ(run("trace hull/face_contact", broken).exit_code, 0);

  const ProgramRun render =
      run("render hull/coherent_points --out '" + (folder / "out") + "'", broken);
  EXPECT_EQ(render.exit_code, 2);
  for (const char* route : {"EGL", "OSMesa", "libegl1", "libosmesa6"}) {
    EXPECT_THAT(render.err, HasSubstr(route));
  }
  EXPECT_THAT(files_below(folder / "out"), IsEmpty());
  EXPECT_EQ(run("doctor", broken).exit_code, 2);
}

TEST(Trace, FullDiskIsTroubleForEveryVerbThatPrints) {
  for (const char* verb : {"trace hull/face_contact", "list", "list --json"}) {
    EXPECT_EQ(run_on_full_disk(verb), 2) << verb;
  }
}

}  // namespace
}  // namespace contactscope::test
