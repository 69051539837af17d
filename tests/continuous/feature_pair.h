#pragma once

#include <array>
#include <cmath>

#include "continuous/moving_features.h"
#include "support/random_geometry.h"

/// Moving vertices, faces and edges for tests and benchmarks.
namespace contactscope::test {

/// A vertex (corner 0) and a face, or the edge of corners 0 and 1 and the edge of 2 and 3.
template <class S> struct FeaturePair {
  bool edges = false;
  std::array<MovingCorner<S>, 4> corners;

  FeatureImpact impact() const {
    const auto& [a, b, c, d] = corners;
    if (edges) return impact_of_edges<S>({a, b}, {c, d});
    return impact_of_vertex_face<S>(a, {b, c, d});
  }
  template <class T> FeaturePair<T> cast() const {
    FeaturePair<T> result;
    result.edges = edges;
    for (std::size_t i = 0; i < 4; ++i)
      result.corners[i] = {corners[i].start.template cast<T>(), corners[i].end.template cast<T>()};
    return result;
  }
};

/// Corners of about `size` metres; most pairs come near each other in the step.
inline FeaturePair<double> random_feature_pair(Random& random, double size) {
  FeaturePair<double> pair;
  pair.edges = random.chance(0.5);
  const double fast = random.decade(-2, 1);
  for (MovingCorner<double>& corner : pair.corners) {
    corner.start = size * random.vector(-1, 1);
    corner.end = corner.start + fast * size * random.vector(-1, 1);
  }
  if (random.chance(0.6)) {  // two points of them meet, or nearly
    const double time = random.uniform(0.1, 1);
    std::array<Vec3d, 4> met;
    for (std::size_t i = 0; i < 4; ++i) met[i] = pair.corners[i].at(time);
    const double u = random.uniform(0, 1), v = random.uniform(0, 1 - (pair.edges ? 0 : u));
    const double past = random.chance(0.5) ? 0 : random.decade(-9, 0);
    Vec3d gap = past * size * random.unit_vector();
    if (pair.edges) {
      gap += (met[2] + v * (met[3] - met[2])) - (met[0] + u * (met[1] - met[0]));
    } else {
      gap += (met[1] + u * (met[2] - met[1]) + v * (met[3] - met[1])) - met[0];
    }
    for (std::size_t i = 0; i < (pair.edges ? 2U : 1U); ++i) {
      pair.corners[i].start += gap;
      pair.corners[i].end += gap;
    }
  }
  const double thin = random.decade(-8, 0);
  if (random.chance(0.2)) {  // a needle, or edges nearly parallel
    const auto& [a, b, c, d] = pair.corners;
    if (pair.edges) {
      pair.corners[3].start = c.start + (b.start - a.start) + thin * size * random.vector(-1, 1);
      pair.corners[3].end = c.end + (b.end - a.end) + thin * size * random.vector(-1, 1);
    } else {
      pair.corners[3].start = 0.3 * b.start + 0.7 * c.start + thin * size * random.vector(-1, 1);
      pair.corners[3].end = 0.3 * b.end + 0.7 * c.end + thin * size * random.vector(-1, 1);
    }
  }
  return pair;
}

/// Integer corners that meet exactly at time k / 8 and a known place: a hit by construction. A
/// linear map of integers preserves it, and so does any power of two.
inline FeaturePair<double> exact_feature_hit(Random& random, bool on_border, double& time) {
  constexpr double kReach = 64;
  const auto integers = [&](double reach) -> Vec3d {
    return random.vector(-reach, reach).array().round();
  };
  FeaturePair<double> pair;
  pair.edges = random.chance(0.5);
  time = (1 + random.index(7)) / 8.0;
  const auto fraction = [&](int least, int most) {
    return on_border && random.chance(0.6) ? (random.chance(0.5) ? 0 : 8)
                                           : least + random.index(most - least + 1);
  };
  std::array<Vec3d, 4> met;
  for (Vec3d& corner : met) corner = 8 * integers(kReach);
  if (pair.edges) {
    const double s = fraction(1, 7) / 8.0, t = fraction(1, 7) / 8.0;
    const Vec3d meeting = met[0] + s * (met[1] - met[0]);
    const Vec3d other = met[2] + t * (met[3] - met[2]);
    met[2] += meeting - other;
    met[3] += meeting - other;
  } else {
    const double u = fraction(1, 3) / 8.0;
    const double v = u > 0.5 ? 0 : (1 + random.index(3)) / 8.0;
    met[0] = met[1] + u * (met[2] - met[1]) + v * (met[3] - met[1]);
  }
  Mat3<double> map;
  for (int k = 0; k < 3; ++k) map.col(k) = integers(5);
  const bool coplanar = random.chance(0.2);
  if (coplanar) map.col(2).setZero();
  const Vec3d away = 1024 * integers(random.chance(0.5) ? 1000 : 0);
  const double unit = std::ldexp(1.0, random.index(27) - 23);
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3d offset = 8 * integers(random.chance(0.3) ? 1000 : 30);
    pair.corners[i].start = unit * (map * (met[i] - time * offset) + away);
    pair.corners[i].end = unit * (map * (met[i] + (1 - time) * offset) + away);
  }
  return pair;
}

}  // namespace contactscope::test
