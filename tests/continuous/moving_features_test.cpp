#include "continuous/moving_features.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "continuous/feature_pair.h"
#include "support/brute_force_distance.h"
#include "support/random_geometry.h"

namespace contactscope {
namespace {

using test::Extended;
using test::ExtendedPoint;
using test::FeaturePair;
using test::Features;
using test::Random;

/// A corner at a time, relative to the start of another one, in extended precision.
ExtendedPoint corner_at(const FeaturePair<double>& pair, std::size_t i, Extended time) {
  const ExtendedPoint origin = pair.corners[0].start.cast<Extended>();
  const ExtendedPoint start = pair.corners[i].start.cast<Extended>() - origin;
  const ExtendedPoint end = pair.corners[i].end.cast<Extended>() - origin;
  return (1 - time) * start + time * end;
}

/// By exhaustion, metres.
Extended true_distance(const FeaturePair<double>& pair, Extended time) {
  const auto corner = [&](std::size_t i) { return corner_at(pair, i, time); };
  const auto edge = [](const ExtendedPoint& from, const ExtendedPoint& to) {
    return Features{{from, to}, {{0, 1}}, {}, {}};
  };
  if (pair.edges)
    return brute_force_distance(edge(corner(0), corner(1)), edge(corner(2), corner(3))).distance;
  const Features vertex{{corner(0)}, {}, {}, {}};
  return brute_force_distance(vertex, test::features_of_triangle({corner(1), corner(2), corner(3)}))
      .distance;
}

/// Bounds in metres: how much any two points approach in the step, and all differences of corners.
struct Extent {
  explicit Extent(const FeaturePair<double>& pair) {
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const ExtendedPoint start = corner_at(pair, i, 0) - corner_at(pair, j, 0);
        const ExtendedPoint end = corner_at(pair, i, 1) - corner_at(pair, j, 1);
        speed = std::max(speed, (end - start).norm());
        size = std::max({size, start.norm(), end.norm()});
      }
    }
  }
  Extended speed = 0, size = 0;
};

/// The first time at which they are within `gap`, by steps as long as the distance allows. nullopt
/// if there is none; `undecided` if it takes too many steps.
std::optional<Extended> marched(const FeaturePair<double>& pair, Extended gap, bool& undecided) {
  const Extended speed = Extent(pair).speed;
  Extended time = 0;
  undecided = false;
  for (int i = 0; i < 3000; ++i) {
    const Extended distance = true_distance(pair, time);
    if (distance <= gap) return time;
    time += (distance - 0.9L * gap) / speed;
    if (!(time <= 1)) return std::nullopt;
  }
  undecided = true;
  return time;
}

template <class S> void compare_with_marching(double away) {
  Random random(31);
  int hits = 0, separated = 0, near = 0, overlapping = 0, undecided = 0, unproved = 0;
  std::int64_t steps = 0;
  int most_steps = 0;
  constexpr int kPairs = 6000;
  for (int i = 0; i < kPairs; ++i) {
    FeaturePair<double> exact = random_feature_pair(random, away > 0 ? 1.0 : random.decade(-4, 4));
    const Vec3d by = away * random.unit_vector();
    for (MovingCorner<double>& corner : exact.corners) {
      corner.start += by;
      corner.end += by;
    }
    const FeaturePair<S> pair = exact.cast<S>();
    const FeaturePair<double> given = pair.template cast<double>();
    const FeatureImpact found = pair.impact();
    steps += found.steps;
    most_steps = std::max(most_steps, found.steps);
    const Extended size = Extent(given).size, rounding = 1e-13L * size;
    bool unsure;
    const auto touches = marched(given, 1e-16L * size, unsure);
    undecided += unsure;
    switch (found.status) {
      case FeatureStatus::Separated:
        ++separated;
        EXPECT_TRUE(unsure || !touches) << "missed " << i;
        break;
      case FeatureStatus::Overlapping:
        ++overlapping;
        EXPECT_LE(true_distance(given, 0), rounding) << i;
        break;
      case FeatureStatus::Hit: {
        ++hits;
        EXPECT_LE(found.begin, found.end);
        EXPECT_LE(found.end - found.begin, 1e-3) << i;
        const Extended speed = Extent(given).speed;
        EXPECT_LE(true_distance(given, found.end),
                  rounding + speed * static_cast<Extended>(found.end - found.begin))
            << i;
        EXPECT_NEAR(found.normal.norm(), 1, 1e-12);
        EXPECT_TRUE(touches.has_value()) << "invented " << i;
        [[fallthrough]];
      }
      case FeatureStatus::Near:
        if (found.status == FeatureStatus::Near) ++near;
        EXPECT_LE(true_distance(given, found.begin), rounding) << i;
        EXPECT_TRUE(unsure || !touches || found.begin <= *touches) << "late " << i;
        // An alarm that the oracle does not confirm.
        unproved += !touches;
    }
  }
  std::printf("hits %d, near %d, separated %d, overlapping %d, undecided %d, steps %.2f, most %d\n",
              hits, near, separated, overlapping, undecided, double(steps) / kPairs, most_steps);
  EXPECT_GT(hits, kPairs / 20);
  EXPECT_GT(separated, kPairs / 10);
  EXPECT_LE(near, kPairs / 200);
  EXPECT_EQ(unproved, 0);
  EXPECT_LT(undecided, kPairs / 100);
}

TEST(MovingFeatures, SlowMeetWhenMarchingMeets) {
  compare_with_marching<double>(0);
  compare_with_marching<float>(0);
}

TEST(MovingFeatures, SlowNothingIsLostAKilometreFromTheOrigin) {
  compare_with_marching<float>(1000);
  compare_with_marching<double>(1000);
}

TEST(MovingFeatures, SlowHitsByConstructionAreNeverMissed) {
  Random random(32);
  constexpr int kHits = 20'000;
  int proved = 0, near = 0, at_start = 0, late = 0, missed = 0, most_steps = 0, in_space = 0;
  for (int i = 0; i < kHits; ++i) {
    double time;
    const bool on_border = i % 2 == 0;
    const FeaturePair<double> pair = exact_feature_hit(random, on_border, time);
    const FeatureImpact found = pair.impact();
    missed += found.status == FeatureStatus::Separated;
    late += found.begin > time;
    if (found.status == FeatureStatus::Overlapping) ++at_start;
    in_space += !on_border;
    proved += !on_border && found.status == FeatureStatus::Hit;
    near += found.status == FeatureStatus::Near;
    most_steps = std::max(most_steps, found.steps);
  }
  std::printf("proved %d of %d, near %d, at the start %d, most steps %d\n", proved, in_space, near,
              at_start, most_steps);
  EXPECT_EQ(missed, 0);
  EXPECT_EQ(late, 0);
  // Hits at an inner place; a sixth of the pairs move in one plane and meet at borders.
  EXPECT_GT(proved, in_space * 6 / 10);
  EXPECT_LT(at_start, kHits / 7);
}

/// One feature stays on one side of the other along a direction, by a margin, and moves across it.
TEST(MovingFeatures, SlowMissesByAMarginAreNoHits) {
  Random random(33);
  for (const double margin : {1e-3, 1e-6, 1e-9, 1e-11}) {
    int alarms = 0, most_steps = 0;
    std::int64_t steps = 0;
    constexpr int kMisses = 30'000;
    for (int i = 0; i < kMisses; ++i) {
      const double size = random.decade(-4, 4);
      FeaturePair<double> pair;
      pair.edges = random.chance(0.5);
      const Quatd rotation = random.rotation();
      for (std::size_t k = 0; k < 4; ++k) {
        const bool is_first = k < (pair.edges ? 2U : 1U);
        const double fast = random.decade(-1, 1);
        Vec3d start = random.vector(-1, 1), end = fast * random.vector(-1, 1) + start;
        const auto lift = [&](Vec3d& place) {
          // Half of them come as near as the margin.
          place.z() = random.chance(0.5) ? 0 : std::abs(place.z());
          place.z() = is_first ? place.z() + margin : -place.z();
        };
        lift(start);
        lift(end);
        pair.corners[k] = {size * (rotation * start), size * (rotation * end)};
      }
      const FeatureImpact found = pair.impact();
      alarms += found.status != FeatureStatus::Separated;
      steps += found.steps;
      most_steps = std::max(most_steps, found.steps);
    }
    std::printf("margin %g: alarms %d, steps %.2f, most %d\n", margin, alarms,
                double(steps) / kMisses, most_steps);
    EXPECT_EQ(alarms, 0) << margin;
  }
}

MovingCorner<double> moves(const Vec3d& start, const Vec3d& offset) {
  return {start, start + offset};
}

TEST(MovingFeatures, DegenerateOnesAreAnswered) {
  const Vec3d none = Vec3d::Zero(), x = Vec3d::UnitX(), y = Vec3d::UnitY(), z = Vec3d::UnitZ();
  const MovingFace<double> face = {moves(none, none), moves(x, none), moves(y, none)};
  const Vec3d inside(0.25, 0.25, 0);
  // At rest, separated or not.
  EXPECT_EQ(impact_of_vertex_face(moves(inside + z, none), face).status, FeatureStatus::Separated);
  EXPECT_EQ(impact_of_vertex_face(moves(inside, none), face).status, FeatureStatus::Overlapping);
  // Through the inside, the middle of an edge, a corner, and past it.
  const FeatureImpact hit = impact_of_vertex_face(moves(inside + z, -4 * z), face);
  EXPECT_EQ(hit.status, FeatureStatus::Hit);
  EXPECT_NEAR(hit.begin, 0.25, 1e-12);
  EXPECT_NEAR(hit.end, 0.25, 1e-12);
  EXPECT_LE(hit.begin, 0.25);
  EXPECT_GE(hit.end, 0.25);
  EXPECT_NEAR(hit.u, 0.25, 1e-12);
  EXPECT_NEAR(hit.v, 0.25, 1e-12);
  EXPECT_NEAR(hit.normal.z(), -1, 1e-12);  // from the vertex to the face
  for (const Vec3d& border : {Vec3d(0.5, 0.5, 0), x, none}) {
    const FeatureImpact found = impact_of_vertex_face(moves(border + z, -4 * z), face);
    EXPECT_EQ(found.status, FeatureStatus::Near);
    EXPECT_NEAR(found.begin, 0.25, 1e-12);
  }
  EXPECT_EQ(impact_of_vertex_face(moves(Vec3d(0.5, 0.5 + 1e-12, 1), -4 * z), face).status,
            FeatureStatus::Separated);
  // In the plane of the face.
  const FeatureImpact flat = impact_of_vertex_face(moves(Vec3d(-1, 0.5, 0), 2 * x), face);
  EXPECT_EQ(flat.status, FeatureStatus::Near);
  EXPECT_NEAR(flat.begin, 0.5, 1e-12);
  // A face that is an edge, and one that is a point.
  const MovingFace<double> line = {moves(none, none), moves(x, none), moves(0.5 * x, none)};
  EXPECT_NEAR(impact_of_vertex_face(moves(0.5 * x + z, -4 * z), line).begin, 0.25, 1e-12);
  EXPECT_EQ(impact_of_vertex_face(moves(0.5 * x + y + z, -4 * z), line).status,
            FeatureStatus::Separated);
  const MovingFace<double> point = {moves(none, none), moves(none, none), moves(none, none)};
  EXPECT_NEAR(impact_of_vertex_face(moves(z, -4 * z), point).begin, 0.25, 1e-12);
  // Edges: crossed, parallel, on one line, of length 0, all in one place.
  const MovingEdge<double> edge = {moves(-x, none), moves(x, none)};
  const auto falls = [&](const Vec3d& from, const Vec3d& to) -> MovingEdge<double> {
    return {moves(from + z, -4 * z), moves(to + z, -4 * z)};
  };
  EXPECT_EQ(impact_of_edges(edge, falls(-y, y)).status, FeatureStatus::Hit);
  for (const Vec3d& to : {x, Vec3d(0.5 * x), none, Vec3d(5 * x)}) {
    EXPECT_NEAR(impact_of_edges(edge, falls(none, to)).begin, 0.25, 1e-12);
  }
  const MovingEdge<double> slides = {moves(2 * x, -4 * x), moves(3 * x, -4 * x)};
  EXPECT_NEAR(impact_of_edges(edge, slides).begin, 0.25, 1e-12);
  EXPECT_EQ(impact_of_edges(edge, {moves(2 * x, none), moves(3 * x, none)}).status,
            FeatureStatus::Separated);
  EXPECT_EQ(impact_of_edges(edge, edge).status, FeatureStatus::Overlapping);
  const MovingEdge<double> nothing = {moves(none, none), moves(none, none)};
  EXPECT_EQ(impact_of_edges(nothing, nothing).status, FeatureStatus::Overlapping);
  // Input that has no answer must not give a miss.
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {nan, std::numeric_limits<double>::infinity(), 1e200}) {
    const FeatureImpact found = impact_of_vertex_face(moves(Vec3d(bad, 0, 1), -4 * z), face);
    EXPECT_TRUE(found.begin == 0 || found.status == FeatureStatus::Separated) << bad;
    EXPECT_TRUE(found.status == FeatureStatus::Near || bad == 1e200 || !std::isnan(bad)) << bad;
  }
}

}  // namespace
}  // namespace contactscope
