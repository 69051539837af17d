#include <contactscope/trace.h>
#include <contactscope/version.h>
#include <gmock/gmock.h>

#include <limits>

#include "support/temporary_folder.h"

namespace contactscope {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

const std::vector<NamedShape> kShapes = {{"ground", Plane{}}, {"crate", Box{{0.5, 0.5, 0.5}}}};

Frame frame_at(int number, double height) {
  Frame frame{number, number / 60.0};
  frame.poses = {{"ground", {}}, {"crate", {{0, height, 0}, {}}}};
  Manifold manifold{{0, 1, 0}};
  manifold.points = {{{0.5, 0, 0.5}, height - 0.5, "corner"}};
  frame.pairs = {{"ground", "crate", {manifold}}};
  return frame;
}

TEST(PackageTrace, AWrittenTraceReadsBack) {
  TraceInfo info;
  info.scenario = "mine/crate";
  info.title = "A crate";
  info.scalar = Scalar::Float;
  info.up = "z";
  info.engine = "mine";
  info.version = "3";
  const Trace made(info, kShapes, {frame_at(0, 0.5), frame_at(7, 0.48)});
  const TemporaryFolder folder;
  write_trace(folder / "below/run.jsonl", made);
  EXPECT_THAT(read_text(folder / "below/run.jsonl"),
              StartsWith(std::string("{\"schema\":\"") + trace_schema() + "\""));
  const Trace read = read_trace(folder / "below/run.jsonl");
  EXPECT_EQ(to_json_lines(read), to_json_lines(made));
  EXPECT_EQ(read.info().title, "A crate");
  EXPECT_EQ(read.info().scalar, Scalar::Float);
  EXPECT_EQ(read.info().engine, "mine");
  EXPECT_THAT(read.shapes(), ElementsAre("ground", "crate"));
  ASSERT_EQ(read.frame_count(), 2);
  const Frame frame = read.frame(1);
  EXPECT_EQ(frame.number, 7);
  ASSERT_EQ(frame.poses.size(), 2u);
  EXPECT_EQ(frame.poses[1].pose.position, (Vec3{0, 0.48, 0}));
  ASSERT_EQ(frame.pairs.size(), 1u);
  ASSERT_EQ(frame.pairs[0].manifolds.size(), 1u);
  EXPECT_EQ(frame.pairs[0].manifolds[0].points[0].id, "corner");
}

TEST(PackageTrace, FileThatIsCutOffIsReadUpToThere) {
  const std::string whole = to_json_lines(Trace({}, kShapes, {frame_at(0, 0.5), frame_at(1, 0.4)}));
  EXPECT_EQ(parse_trace(whole).cut_off_in(), 0);
  const Trace torn = parse_trace(whole.substr(0, whole.size() - 20));
  EXPECT_EQ(torn.frame_count(), 1);
  EXPECT_EQ(torn.cut_off_in(), 3);
}

TEST(PackageTrace, WrongFileIsRefusedWithItsPlace) {
  const TemporaryFolder folder;
  const Trace made({}, kShapes, {frame_at(0, 0.5)});
  const std::string path =
      folder.write("torn.jsonl", to_json_lines(made) +
                                     "{\"frame\":\"one\",\"time\":0,\"poses\":{},\"pairs\":[]}\n");
  try {
    read_trace(path);
    FAIL() << "it was read";
  } catch (const InputError& error) {
    EXPECT_EQ(error.file(), path);
    EXPECT_EQ(error.line(), 3);
    EXPECT_EQ(error.column(), 1);
    EXPECT_THAT(error.what(), StartsWith(path + ":3:1: "));
  }
}

TEST(PackageTrace, TheRemedyIsSeparate) {
  try {
    parse_trace("{\"schema\":\"contactscope.trace/9\"}\n", "old.jsonl");
    FAIL() << "it was read";
  } catch (const InputError& error) {
    EXPECT_EQ(error.file(), "old.jsonl");
    EXPECT_EQ(error.line(), 1);
    EXPECT_FALSE(error.remedy().empty()) << error.what();
    EXPECT_THAT(error.what(), testing::EndsWith(error.remedy()));
  }
}

TEST(PackageTrace, InconsistentFramesAreRefused) {
  Frame strange = frame_at(0, 0.5);
  strange.pairs[0].b = "crte";
  try {
    const Trace made({}, kShapes, {strange});
    FAIL() << "it was made";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("did you mean 'crate'?"));
  }
  Frame turned = frame_at(0, 0.5);
  turned.pairs[0].manifolds[0].normal = {0, 2, 0};
  EXPECT_THROW(Trace({}, kShapes, {turned}), InputError);
  EXPECT_THROW(Trace({}, kShapes, {frame_at(3, 0.5), frame_at(2, 0.5)}), InputError);
  EXPECT_THROW(Trace({}, kShapes, {frame_at(0, std::numeric_limits<double>::infinity())}),
               std::domain_error);
}

TEST(PackageTrace, VersionIsThatOfTheHeaders) {
  EXPECT_EQ(std::string(version()), std::to_string(CONTACTSCOPE_VERSION_MAJOR) + "." +
                                        std::to_string(CONTACTSCOPE_VERSION_MINOR) + "." +
                                        std::to_string(CONTACTSCOPE_VERSION_PATCH));
}

}  // namespace
}  // namespace contactscope
