#include "snapshot/compare_trace.h"

#include <gmock/gmock.h>

#include "snapshot/sample_trace.h"

namespace contactscope::snapshot {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// One pair of two cubes of 1 m at the origin, with a decision.
trace::Frame decided(const trace::Decision& decision) {
  trace::Frame frame;
  frame.frame = 12;
  frame.poses = {{"floor", {}}, {"crate", {}}};
  trace::Pair& pair = frame.pairs.emplace_back();
  pair.a = "floor";
  pair.b = "crate";
  pair.decisions = {decision};
  return frame;
}

trace::Header cubes(const std::string& scalar) {
  trace::Header header;
  header.scalar = scalar;
  for (const char* name : {"floor", "crate"}) {
    trace::Shape shape;
    shape.name = name;
    shape.vertices = {{0.5, 0.5, 0.5}, {-0.5, -0.5, -0.5}};
    header.shapes.push_back(shape);
  }
  return header;
}

TEST(Brittle, AMarginWithinRoundingIsReported) {
  const trace::Frame frame = decided({"axis", "face_a", "edge_edge", 2e-7, {}, {}});
  EXPECT_THAT(brittle_decisions(cubes("float"), frame),
              ElementsAre("frame 12, floor-crate: axis: face_a over edge_edge by 200 nm, which is "
                          "within rounding: another machine may choose differently"));
  EXPECT_THAT(brittle_decisions(cubes("double"), frame), IsEmpty());
}

TEST(Brittle, AMarginBeyondItIsNot) {
  EXPECT_THAT(
      brittle_decisions(cubes("float"), decided({"axis", "face_a", "face_b", 1e-4, {}, {}})),
      IsEmpty());
  EXPECT_THAT(brittle_decisions(cubes("float"),
                                decided({"incident_face", "face 1", "face 2", {}, {}, 0.1})),
              IsEmpty());
}

TEST(Brittle, AFaceThatMakesNoContactMayBeAnyOne) {
  trace::Frame frame = decided({"face_a", "face 2", "face 5", 0, {}, {}});
  EXPECT_THAT(brittle_decisions(cubes("float"), frame), IsEmpty());
  frame.pairs[0].decisions.push_back({"axis", "face_a", "face_b", 0.1, {}, {}});
  EXPECT_EQ(brittle_decisions(cubes("float"), frame).size(), 1u);
}

TEST(Brittle, AreasAndAnglesCountAsWell) {
  EXPECT_EQ(brittle_decisions(cubes("float"),
                              decided({"points", "points 0 1", "points 1 2", {}, 1e-9, {}}))
                .size(),
            1u);
  EXPECT_EQ(
      brittle_decisions(cubes("float"), decided({"incident_face", "face 1", "face 2", {}, {}, 0}))
          .size(),
      1u);
}

TEST(Brittle, OnlyStoredFramesAreLookedAtAndDecisionsAreNotKept) {
  std::vector<trace::Frame> frames(3, decided({"axis", "face_a", "edge_edge", 0, {}, {}}));
  for (std::size_t i = 0; i < 3; ++i) frames[i].frame = static_cast<int>(i);
  const TakenDecisions taken = take_decisions({0, 2}, {}, cubes("float"), frames);
  EXPECT_EQ(taken.brittle.size(), 2u);
  ASSERT_EQ(taken.margins.size(), 2u);
  EXPECT_EQ(taken.margins.at({2, "floor-crate"}).front().took, "face_a");
  for (const trace::Frame& frame : frames) EXPECT_THAT(frame.pairs[0].decisions, IsEmpty());
}

}  // namespace
}  // namespace contactscope::snapshot
