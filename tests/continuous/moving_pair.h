#pragma once

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "continuous/impact.h"
#include "support/brute_force_distance.h"
#include "support/random_geometry.h"

/// Two moving shapes, an oracle that finds their time of impact by steps of the distance, and a
/// comparison of a method's results with it.
namespace contactscope::test {

/// Core of a moving shape: a hull, a segment or a point.
template <class S> struct Core {
  std::vector<Vec3<S>> points;  // one or two, if there is no hull
  std::optional<Hull<S>> hull;

  template <class T> Core<T> cast() const {
    Core<T> result;
    for (const Vec3<S>& point : points) result.points.push_back(point.template cast<T>());
    if (hull) result.hull = hull_cast<T>(*hull);
    return result;
  }
  SupportSet<S> set() const {
    if (hull) return support_set(*hull);
    return {points.data(), static_cast<int>(points.size()), nullptr};
  }
};

template <class S> struct MovingPair {
  Core<S> core_a, core_b;
  Sweep<S> motion_a, motion_b;
  S radius_a = 0, radius_b = 0;

  template <class T> MovingPair<T> cast() const {
    return {core_a.template cast<T>(),   core_b.template cast<T>(), motion_a.template cast<T>(),
            motion_b.template cast<T>(), static_cast<T>(radius_a),  static_cast<T>(radius_b)};
  }
  MovingShape<S> a() const { return {core_a.set(), motion_a, radius_a}; }
  MovingShape<S> b() const { return {core_b.set(), motion_b, radius_b}; }
};

/// The oracle's own motion: an angle and an axis.
inline Pose<double> placed(const Sweep<double>& motion, double time) {
  const double angle = motion.turn.norm();
  Quatd by = Quatd::Identity();
  if (angle > 0) by = Quatd(Eigen::AngleAxisd(time * angle, motion.turn / angle));
  const Quatd start = motion.start.rotation.normalized();
  const Vec3d pivot = start * motion.pivot + motion.start.position;
  const Quatd rotation = by * start;
  return {rotation, pivot + time * motion.displacement - rotation * motion.pivot};
}

inline Features features_at(const Core<double>& core, const Pose<double>& pose) {
  if (core.hull) return features_of(*core.hull, pose);
  if (core.points.size() == 1) return features_of_point(core.points[0], pose);
  return features_of_segment(core.points[0], core.points[1], pose);
}

/// Distance at a time by exhaustion, both moved near A: the oracle's features are in double.
inline double true_distance(const MovingPair<double>& pair, double time) {
  Pose<double> a = placed(pair.motion_a, time), b = placed(pair.motion_b, time);
  const Vec3d origin = a.position;
  a.position -= origin;
  b.position -= origin;
  const auto found = brute_force_distance(features_at(pair.core_a, a), features_at(pair.core_b, b));
  return static_cast<double>(found.distance) - pair.radius_a - pair.radius_b;
}

/// No point of one moves farther relative to the other in the step, metres.
inline double most_motion(const MovingPair<double>& pair) {
  const auto turning = [](const Core<double>& core, const Sweep<double>& motion) {
    double most = 0;
    for (const Vec3d& point : core.hull ? core.hull->vertices : core.points) {
      const Vec3d arm = motion.start.rotation.normalized() * (point - motion.pivot);
      most = std::max(most, motion.turn.cross(arm).norm());
    }
    return most;
  };
  return (pair.motion_b.displacement - pair.motion_a.displacement).norm() +
         turning(pair.core_a, pair.motion_a) + turning(pair.core_b, pair.motion_b);
}

/// The first time at which they are within `gap` metres, by steps as long as the distance allows;
/// nullopt if there is none. After `most` steps it returns the time reached, which may be early.
inline std::optional<double> first_time_within(const MovingPair<double>& pair, double gap,
                                               double speed, double from = 0, int most = 4000) {
  double time = from;
  for (int i = 0; i < most; ++i) {
    const double distance = true_distance(pair, time);
    if (distance <= gap) return time;
    // Slightly more than is certain, so that it ends: less than a thousandth of the gap.
    time += (distance - 0.999 * gap) / speed;
    if (time > 1) return std::nullopt;
  }
  return time;
}

inline Core<double> random_core(Random& random, double size, int& vertices) {
  switch (random.index(4)) {
    case 0:
      return {{Vec3d::Zero()}, {}};
    case 1: {
      const Vec3d half = size * random.unit_vector();
      return {{-half, half}, {}};
    }
    case 2:
      return {{}, random_box(random, size, 4)};
    default:
      return {{}, random_hull(random, vertices, size, 4)};
  }
}

/// Two bodies some sizes from each other. B moves at A or past it closely, turning or not.
inline MovingPair<double> random_moving_pair(Random& random, double size, double most_turn,
                                             int vertices) {
  MovingPair<double> pair;
  pair.core_a = random_core(random, size, vertices);
  pair.core_b = random_core(random, size, vertices);
  if (pair.core_a.points.size() + pair.core_b.points.size() > 0 && random.chance(0.7)) {
    pair.radius_a = random.uniform(0, 0.5) * size;
    pair.radius_b = random.uniform(0, 0.5) * size;
  }
  pair.motion_a.start = random.pose(0.1 * size);
  pair.motion_b.start = random.pose(0.1 * size);
  const Vec3d direction = random.unit_vector();
  pair.motion_b.start.position += random.uniform(2, 5) * size * direction;
  const Vec3d aim = random.vector(-1, 1);
  const double far = random.decade(-0.3, 1);
  const Vec3d relative = far * (size * aim - pair.motion_b.start.position);
  const Vec3d common = size * random.vector(-5, 5);
  pair.motion_a.displacement = common;
  pair.motion_b.displacement = common + relative;
  for (Sweep<double>* motion : {&pair.motion_a, &pair.motion_b}) {
    motion->pivot = size * random.vector(-0.3, 0.3);
    if (most_turn > 0 && random.chance(0.8)) {
      const double angle = most_turn * random.uniform(0, 1);
      motion->turn = angle * random.unit_vector();
    }
  }
  return pair;
}

/// 32 roundings of the reach and motion of both shapes, with a margin for how these are bounded.
template <class S> double least_tolerance(const MovingPair<double>& pair) {
  const auto reach = [](const Core<double>& core) {
    double most = 0;
    for (const Vec3d& point : core.hull ? core.hull->vertices : core.points)
      most = std::max(most, point.norm());
    return most;
  };
  const double extent = (pair.motion_b.start.position - pair.motion_a.start.position).norm() +
                        most_motion(pair) +
                        3 * (reach(pair.core_a) + reach(pair.core_b) + pair.motion_a.pivot.norm() +
                             pair.motion_b.pivot.norm() + pair.radius_a + pair.radius_b);
  return 64 * static_cast<double>(std::numeric_limits<S>::epsilon()) * extent;
}

/// Results over many pairs.
struct Tally {
  int hits = 0, misses = 0, invented = 0, late = 0, not_near = 0, early = 0, undecided = 0;
  int steps = 0, bounds = 0, most_steps = 0;
};

template <class S>
using Find = ImpactResult<S> (*)(const MovingShape<S>&, const MovingShape<S>&,
                                 const ImpactLimits<S>&, ImpactRun<S>*);

template <class S>
inline constexpr std::array<Find<S>, 2> kMethods = {&time_of_impact<S>,
                                                    &conservative_advancement<S>};

template <class S> void judge(Find<S> find, const MovingPair<double>& exact, Tally& tally) {
  constexpr double kOfMotion = 1e-5;
  const MovingPair<S> pair = exact.template cast<S>();
  // The oracle uses the rounded numbers that the function gets.
  const MovingPair<double> given = pair.template cast<double>();
  const double speed = most_motion(given);
  // The function bounds motion by a ball about each hull, which is up to twice as much.
  const double tolerance = std::max(2 * kOfMotion * speed, least_tolerance<S>(given));
  if (true_distance(given, 0) <= tolerance) return;
  const ImpactResult<S> found =
      find(pair.a(), pair.b(), {.of_motion = static_cast<S>(kOfMotion)}, nullptr);
  tally.steps += found.steps;
  tally.bounds += found.bounds;
  tally.most_steps = std::max(tally.most_steps, found.steps);
  const auto time = static_cast<double>(found.time);
  const double slack = 1e-3 * tolerance;
  const std::optional<double> touches = first_time_within(given, slack, speed);
  switch (found.status) {
    case ImpactStatus::Hit: {
      ++tally.hits;
      tally.late += touches && *touches < time;
      const double distance = true_distance(given, time);
      tally.not_near += distance > 1.01 * tolerance;
      tally.invented += !touches;
      tally.early += touches && *touches - time > 2e-4;
      break;
    }
    case ImpactStatus::Separated:
      tally.misses += touches.has_value();
      break;
    case ImpactStatus::OutOfIterations:
      ++tally.undecided;
      tally.late += touches && *touches < time;
      break;
    case ImpactStatus::Overlapping:
      ADD_FAILURE() << "apart at the start by more than the tolerance";
  }
}

inline void expect_right(const Tally& tally, int of) {
  EXPECT_EQ(tally.misses, 0);
  EXPECT_EQ(tally.late, 0);
  EXPECT_EQ(tally.not_near, 0);
  EXPECT_EQ(tally.undecided, 0);
  EXPECT_GT(tally.hits, of / 5);
  EXPECT_LE(tally.early + tally.invented, tally.hits / 100 + 1);
  std::printf("hits %d, invented %d, early %d, steps %.1f, most %d, bounds %.1f\n", tally.hits,
              tally.invented, tally.early, double(tally.steps) / of, tally.most_steps,
              double(tally.bounds) / of);
}

}  // namespace contactscope::test
