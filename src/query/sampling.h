#pragma once

#include "query/penetration.h"

namespace contactscope {

/// Fewest and most directions that may be asked for.
inline constexpr int kMinSamples = 6;
inline constexpr int kMaxSamples = 1 << 20;
/// Cap on the rounds of the search about the best direction.
inline constexpr int kMaxSamplingRounds = 128;

/// No direction is farther than this angle, radians, from the nearest of `count` sampled ones. Of the
/// Fibonacci sphere that is at the poles; the constant is measured, a test repeats that.
template <class S>
S sampling_angle(int count);

/// Unit directions evenly spread, one after the other: the Fibonacci sphere (Gonzalez, "Measurement
/// of Areas on a Sphere Using Fibonacci and Latitude-Longitude Lattices", 2010), each a little lower
/// than the last and turned by the golden angle about z. Without a library's sine, whose last bit
/// differs between processors.
class SamplingDirections {
 public:
  explicit SamplingDirections(int count) : count_(count) {}
  Vec3d next();

 private:
  int count_;
  int index_ = 0;
  double cosine_ = 1, sine_ = 0;
};

/// Brute force over directions (see sampling.cpp and penetration.h). `depth` is that along the best
/// direction that was tried. The depth along a direction changes by no more than the largest
/// distance R of a point of the difference from the origin times the angle, so the true depth is at
/// least `least_depth`: the best of the even samples less R * sampling_angle(samples).
///
/// `iterations` counts directions. Converged: the last round's directions were nearer than the
/// tolerance could tell; it says nothing of whether a better one is elsewhere, `least_depth` does.
template <class S>
PenetrationResult<S> sampling(const SupportSet<S>& a, const SupportSet<S>& b, const Pose<S>& b_in_a,
                              const PenetrationOptions<S>& options, PenetrationSteps<S>* steps);

}  // namespace contactscope
