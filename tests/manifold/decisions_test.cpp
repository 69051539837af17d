#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "manifold/dispatch.h"
#include "manifold/placed_shapes.h"
#include "support/builders.h"

namespace contactscope {
namespace {

using test::about;
using test::kDegree;
using test::PairCase;
using test::PlacedShapes;
using testing::StartsWith;

PlacedShapes shapes_of(const PairCase<double>& pair) {
  return {pair.a, pair.pose_a, pair.b, pair.pose_b};
}

trace::Pair decided(const PairCase<double>& pair, const CollideOptions& options = {}) {
  trace::Stages stages;
  stages.decisions = true;
  return test::record_of<double>(shapes_of(pair), options, stages);
}

const trace::Decision* decision(const trace::Pair& pair, const std::string& stage) {
  const auto found = std::ranges::find(pair.decisions, stage, &trace::Decision::stage);
  return found == pair.decisions.end() ? nullptr : &*found;
}

CollideOptions reduced_by(const char* reducer) {
  CollideOptions options;
  options.reducer = find_reducer(reducer);
  return options;
}

TEST(Decisions, AreRecordedOnlyOnRequest) {
  const PairCase<double> pair = test::stacked_cubes(20 * kDegree, 0.01);
  EXPECT_TRUE(test::record_of<double>(shapes_of(pair)).decisions.empty());
  EXPECT_FALSE(decided(pair).decisions.empty());
  EXPECT_FALSE(test::record_of<double>(shapes_of(pair)).sat->tolerance);
}

TEST(Decisions, LevelCubesAreFarFromAnEdgeByWhatTheFirstFaceIsPreferred) {
  const trace::Pair pair = decided(test::stacked_cubes(20 * kDegree, 0.01));
  const trace::Decision* const axis = decision(pair, "axis");
  ASSERT_NE(axis, nullptr);
  EXPECT_EQ(axis->took, "face_a");
  EXPECT_EQ(axis->over, "face_b");
  // Both faces are 1 cm deep: the second one would have to win by 0.2 % of the radius.
  EXPECT_NEAR(*axis->margin, 0.002 * std::sqrt(0.75), 1e-9);
  EXPECT_NEAR(*pair.sat->tolerance, *axis->margin, 1e-9);
  const trace::Decision* const contact = decision(pair, "contact");
  ASSERT_NE(contact, nullptr);
  EXPECT_EQ(contact->took, "touching");
  EXPECT_NEAR(*contact->margin, 0.01, 1e-12);
  const trace::Decision* const face = decision(pair, "face_a");
  ASSERT_NE(face, nullptr);
  EXPECT_EQ(face->took, "face 2");
  EXPECT_GT(*face->margin, 0.5);
  const trace::Decision* const incident = decision(pair, "incident_face");
  ASSERT_NE(incident, nullptr);
  EXPECT_NEAR(*incident->margin_cosine, 1, 1e-12);  // the neighbouring faces are upright
}

TEST(Decisions, AMarginIsTheChangeAfterWhichTheAxisIsAnother) {
  // Tilt until the edges win: just before, the margin of the face is the remaining distance.
  const auto at = [](double tilt) {
    PairCase<double> pair = test::stacked_cubes(30 * kDegree, 0.02);
    pair.pose_b.rotation = about(Vec3d::UnitX(), tilt * kDegree) * pair.pose_b.rotation;
    CollideOptions options;
    options.preference = Preference::None;
    return decided(pair, options);
  };
  double below = 0.1, above = 0.2;
  const std::string first = decision(at(below), "axis")->took;
  while (above < 30 && decision(at(above), "axis")->took == first) {
    below = above;
    above += 0.1;
  }
  ASSERT_NE(decision(at(above), "axis")->took, first);
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (below + above);
    (decision(at(middle), "axis")->took == first ? below : above) = middle;
  }
  EXPECT_LT(*decision(at(below), "axis")->margin, 1e-9);
  EXPECT_LT(*decision(at(above), "axis")->margin, 1e-9);
  EXPECT_GE(*decision(at(below), "axis")->margin, 0);
  EXPECT_GE(*decision(at(above), "axis")->margin, 0);
  EXPECT_EQ(decision(at(below), "axis")->over, decision(at(above), "axis")->took);
}

TEST(Decisions, SeparatedCubesReportTheirSeparation) {
  const trace::Pair pair = decided(test::stacked_cubes(20 * kDegree, -0.25));
  const trace::Decision* const contact = decision(pair, "contact");
  ASSERT_NE(contact, nullptr);
  EXPECT_EQ(contact->took, "separated");
  EXPECT_NEAR(*contact->margin, 0.25, 1e-12);
  EXPECT_EQ(decision(pair, "axis"), nullptr);
}

TEST(Decisions, EachStepOfAReducerHasTheRunnerUp) {
  const trace::Pair pair = decided(test::stacked_cubes(30 * kDegree, 0.01), reduced_by("area"));
  int steps = 0;
  for (const trace::Decision& recorded : pair.decisions) {
    if (!recorded.stage.starts_with("point ")) continue;
    EXPECT_THAT(recorded.took, StartsWith("point "));
    EXPECT_NE(recorded.took, recorded.over);
    EXPECT_GE(recorded.margin.value_or(0) + recorded.margin_area.value_or(0), -1e-12)
        << recorded.stage;
    ++steps;
  }
  EXPECT_EQ(steps, 4);
}

TEST(Decisions, TheBestAreaHasItsMargin) {
  const trace::Pair pair = decided(test::stacked_cubes(30 * kDegree, 0.01), reduced_by("optimal"));
  const trace::Decision* const points = decision(pair, "points");
  ASSERT_NE(points, nullptr);
  EXPECT_THAT(points->took, StartsWith("points "));
  ASSERT_TRUE(points->margin_area.has_value());
  EXPECT_GE(*points->margin_area, -1e-12);
  EXPECT_LT(*points->margin_area, 0.2);
}

TEST(Decisions, MirroringSwapsTheShapes) {
  const PairCase<double> pair = test::stacked_cubes(20 * kDegree, 0.01);
  trace::Pair record = decided(pair);
  trace::mirror(record);
  EXPECT_EQ(decision(record, "axis")->took, "face_b");
  EXPECT_NE(decision(record, "face_b"), nullptr);
}

trace::Flip flip_of(const PlacedShapes& pair, const CollideOptions& options = {}) {
  return flip_distance<double>(pair.a, pair.pose_a, pair.b, pair.pose_b, options);
}

TEST(FlipDistance, BallOnAFaceHasTheDistanceOutOfIt) {
  const Shape<double> box = test::cube(0.5);
  for (const double overlap : {0.001, 0.002, 0.004}) {
    const trace::Flip flip =
        flip_of({box, {}, test::ball(0.5), {Quatd::Identity(), Vec3d(0.1, 1 - overlap, 0.2)}});
    ASSERT_TRUE(flip.offset.has_value());
    EXPECT_NEAR(*flip.offset, overlap, 1e-3 * overlap);
    EXPECT_NEAR(flip.direction.y(), 1, 1e-9);
    EXPECT_FALSE(flip.turn.has_value());  // a ball does not change when it turns
  }
}

TEST(FlipDistance, NearATieIsTheTurnToTheTie) {
  // A cube on its edge over a face: a turn to either side changes the incident face, at 45 degrees.
  for (const double off : {1e-4, 1e-3}) {
    PairCase<double> pair{test::cube(0.5), test::at(0, 0, 0), test::cube(0.3),
                          test::at(0, 0.5 + 0.3 * std::sqrt(2) - 0.002, 0)};
    pair.pose_b.rotation = about(Vec3d::UnitX(), 45 * kDegree + off);
    const trace::Flip flip = flip_of(shapes_of(pair));
    ASSERT_TRUE(flip.turn.has_value()) << off;
    EXPECT_LT(*flip.turn, 2 * off) << off;
  }
}

TEST(FlipDistance, InFloatATieOfOneLastPlaceIsFound) {
  const Shape<float> box = hull_cast<float>(test::cube(0.5));
  const Shape<float> ball = Sphere<float>{0.5f};
  const float touching = 1.0f;
  const trace::Flip flip = flip_distance<float>(
      box, {}, ball, {Quat<float>::Identity(), Vec3<float>(0.1f, touching, 0.2f)}, {});
  ASSERT_TRUE(flip.last_places.has_value());
  EXPECT_LE(*flip.last_places, 2);
}

TEST(FlipDistance, TheSameSeedGivesTheSame) {
  const PlacedShapes pair = shapes_of(test::stacked_cubes(30 * kDegree, 0.01));
  EXPECT_EQ(flip_of(pair), flip_of(pair));
}

TEST(FlipDistance, SeparatedShapesHaveNone) {
  const trace::Flip flip = flip_of(shapes_of(test::stacked_cubes(30 * kDegree, -0.01)));
  EXPECT_FALSE(flip.offset || flip.turn || flip.last_places);
}

}  // namespace
}  // namespace contactscope
