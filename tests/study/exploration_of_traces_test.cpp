#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "study/exploration.h"

namespace contactscope {
namespace {

using testing::SizeIs;

/// A crate at rest whose engine records four points in two manifolds, one degree from each other.
trace::Frame recorded_in_two(int number) {
  trace::Frame frame;
  frame.frame = number;
  frame.poses = {{"floor", {}}, {"crate", {}}};
  trace::Pair& pair = frame.pairs.emplace_back();
  pair.a = "floor";
  pair.b = "crate";
  for (const double x : {-1.0, 1.0}) {
    trace::Manifold& manifold = pair.manifolds.emplace_back();
    manifold.normal = Vec3d(0.009 * x, 1, 0).normalized();
    for (const double z : {-1.0, 1.0})
      manifold.points.push_back({{x, 0, z}, -0.01, x < 0 ? "left" : "right"});
  }
  // The order of the two may change.
  if (number % 2 == 1) std::swap(pair.manifolds[0], pair.manifolds[1]);
  return frame;
}

TEST(ExploreTrace, ManifoldsOfOneContactAreReducedTogether) {
  trace::Trace trace;
  trace.header.scenario = "mine/crate";
  trace.header.scalar = "double";
  trace.header.up = "y";
  for (const char* name : {"floor", "crate"}) {
    trace.header.shapes.emplace_back();
    trace.header.shapes.back().name = name;
  }
  trace.frames = {recorded_in_two(0), recorded_in_two(1), recorded_in_two(2)};
  const auto explorations = explore(trace, {.reducers = {"area"}, .measure_time = false});
  ASSERT_THAT(explorations, SizeIs(3));
  for (const trace::Exploration& one : explorations) {
    EXPECT_THAT(one.points, SizeIs(4));
    EXPECT_NEAR((one.normal - Vec3d::UnitY()).norm(), 0, 1e-12);
    EXPECT_NEAR(one.best_area, 4, 1e-12);
    EXPECT_EQ(one.reducers.at(0).ids_changed, 0);
  }
}

}  // namespace
}  // namespace contactscope
