#include "app/cli/sequence.h"

#include <gmock/gmock.h>

#include "support/temporary_folder.h"
#include "trace/json.h"

/// Traces that are too long for memory.
namespace contactscope::app {
namespace {

using testing::ElementsAre;
using testing::ElementsAreArray;

/// A ball at rest on a plane, deepest in one frame. Every second frame number is missing.
std::string long_trace(int frames, int deepest) {
  trace::Header header{"mine/long", "", "", "double", "y", 0, {}};
  trace::Shape ground{"ground", "plane", {}, {}, {}, Vec3d::Zero(), 0, trace::HalfSpace{}};
  trace::Shape ball{"ball", "sphere", {Vec3d::Zero()}, {}, {}, Vec3d::Zero(), 1};
  header.shapes = {ground, ball};
  std::string text = trace::to_json_line(header) + "\n";
  for (int f = 0; f < frames; ++f) {
    const double depth = f == deepest ? 0.1 : 0.001;
    trace::Frame frame;
    frame.frame = 2 * f;
    frame.time = f / 60.0;
    Pose<double> resting;
    resting.position = Vec3d(0, 1 - depth, 0);
    frame.poses = {{"ground", Pose<double>{}}, {"ball", resting}};
    trace::Pair pair;
    pair.a = "ground";
    pair.b = "ball";
    trace::Manifold manifold;
    manifold.normal = Vec3d::UnitY();
    trace::Point point;
    point.position = Vec3d(0, -depth, 0);
    point.separation = -depth;
    manifold.points = {point};
    pair.manifolds = {manifold};
    pair.kind = "sphere-plane";
    pair.state = "touching";
    pair.separation = -depth;
    frame.pairs = {pair};
    text += trace::to_json_line(frame) + "\n";
  }
  return text;
}

TEST(Sequence, AShortTraceIsHeldWhole) {
  const TemporaryFolder folder;
  Sequence sequence = read_sequence(folder.write("run.jsonl", long_trace(40, 17)), Hold::Sample);
  EXPECT_EQ(sequence.frames.size(), 40u);
  EXPECT_EQ(sequence.file, nullptr);
  std::vector<int> shown;
  sequence.each({0, 4, 78}, [&](std::size_t i) { shown.push_back(sequence.frames[i].frame); });
  EXPECT_THAT(shown, ElementsAre(0, 4, 78));
}

/// As many frames of a long trace are held as the budget allows, including the first, the last and
/// the deepest; all others can be shown.
TEST(Sequence, ALongTraceIsSampled) {
  const TemporaryFolder folder;
  constexpr int kFrames = 1001;
  const std::string text = long_trace(kFrames, 333);
  const std::string path = folder.write("run.jsonl", text);
  const std::size_t budget = text.size() / 10;
  Sequence sequence = read_sequence(path, Hold::Sample, budget);
  EXPECT_EQ(sequence.every, 16u);
  ASSERT_EQ(sequence.frames.size(), 63u);
  EXPECT_EQ(sequence.frames.front().frame, 0);
  EXPECT_EQ(sequence.frames.back().frame, 2 * (kFrames - 1));
  EXPECT_EQ(sequence.header.frames, 2 * kFrames - 1);
  const std::vector<int> held = mapped(sequence.frames, &trace::Frame::frame);
  EXPECT_THAT(held, testing::Contains(666));
  EXPECT_TRUE(std::ranges::is_sorted(held));

  std::vector<int> shown;
  std::vector<std::size_t> places;
  sequence.each({0, 2, 666, 668, 1998, 2000}, [&](std::size_t i) {
    shown.push_back(sequence.frames[i].frame);
    places.push_back(i);
  });
  EXPECT_THAT(shown, ElementsAre(0, 2, 666, 668, 1998, 2000));
  EXPECT_THAT(places, ElementsAre(0u, 0u, 20u, 20u, 62u, 62u));
  // The frame before is read for those that were not shown last.
  std::vector<int> before;
  const auto note = [&](std::size_t i) {
    before.push_back(sequence.recent(sequence.frames[i].frame - 2)->frame);
  };
  sequence.each({2, 666, 668}, note, true);
  EXPECT_THAT(before, ElementsAre(0, 664, 666));
  EXPECT_THAT(mapped(sequence.frames, &trace::Frame::frame), ElementsAreArray(held));
}

/// Forces on a over a hundredth of a second, which equal impulses on b.
TEST(Sequence, ImpulsesAreConvertedToNewtonSecondsOnB) {
  const TemporaryFolder folder;
  std::string text = long_trace(1, 0);
  const std::string point = "\"separation\":-0.1,";
  text.insert(text.rfind(point) + point.size(),
              "\"impulse\":{\"normal\":-200,\"friction\":[10,0,-20],\"warm_start\":-50},");
  const std::string shapes = "\"shapes\"";
  text.insert(text.find(shapes), "\"impulses\":{\"unit\":\"N\",\"on\":\"a\",\"step\":0.01},");
  const Sequence sequence = read_sequence(folder.write("run.jsonl", text), Hold::Whole);
  const trace::Impulse record =
      sequence.frames.at(0).pairs.at(0).manifolds.at(0).points.at(0).impulse.value();
  EXPECT_EQ(record, (trace::Impulse{2, {-0.1, 0, 0.2}, 0.5}));
  EXPECT_FALSE(sequence.header.impulses);  // a rewritten trace repeats no unit
}

TEST(Sequence, PointsWithoutIdsAreGivenSomeWhetherHeldOrReadAgain) {
  const TemporaryFolder folder;
  const std::string text = long_trace(100, 33);
  const std::string path = folder.write("run.jsonl", text);
  for (const std::size_t budget : {text.size(), text.size() / 10}) {
    Sequence sequence = read_sequence(path, Hold::Sample, budget);
    int shown = 0;
    sequence.each({0, 2, 100}, [&](std::size_t i) {
      const trace::Pair& pair = sequence.frames[i].pairs.at(0);
      EXPECT_EQ(pair.manifolds.at(0).points.at(0).id, "a:f0 b:v0");
      ++shown;
    });
    EXPECT_EQ(shown, 3);
  }
}

}  // namespace
}  // namespace contactscope::app
