#pragma once

#include "query/penetration.h"

/// The methods that penetration() chooses from beside the separating axis test, with its arguments;
/// each is in the file of its name.
namespace contactscope {

/// Caps on the iterations of EPA and, those of finding the first portal included, of MPR. EPA's
/// polytope then has at most 4 + kMaxEpaIterations vertices and never runs out of room: a closed
/// surface of V vertices has 2V - 4 triangles.
inline constexpr int kMaxEpaIterations = 256;
inline constexpr int kMaxMprIterations = 256;
/// Fewest and most directions that sampling may be asked for, and its cap on the rounds of the
/// search about the best one.
inline constexpr int kMinSamples = 6;
inline constexpr int kMaxSamples = 1 << 20;
inline constexpr int kMaxSamplingRounds = 128;

/// Expanding polytope algorithm. Of Converged, `depth` and `least_depth` are the two bounds of the
/// true depth, and no farther apart than the tolerance, up to rounding.
template <class S>
PenetrationResult<S> epa(const SupportSet<S>& a, const SupportSet<S>& b, const Pose<S>& b_in_a,
                         const PenetrationOptions<S>& options, const GjkSimplex<S>* overlap,
                         PenetrationSteps<S>* steps);

/// Minkowski portal refinement.
///
/// **What it is known for**: the normal is that of the face through which the ray from the middle of
/// the difference through the origin leaves it. That is the face of least depth only where the ray
/// happens to meet it: for a plate that lies off centre on another, the ray may leave through a
/// side. The depth is true along that normal, so it is never less than the least depth but can be
/// many times as large; `study penetration` measures how much. No bound from below is known.
template <class S>
PenetrationResult<S> mpr(const SupportSet<S>& a, const SupportSet<S>& b, const Pose<S>& b_in_a,
                         const PenetrationOptions<S>& options, PenetrationSteps<S>* steps);

/// Brute force over directions. `depth` is that along the best direction that was tried. The depth
/// along a direction changes by no more than the largest distance R of a point of the difference
/// from the origin times the angle, so the true depth is at least `least_depth`: the best of the even
/// samples less R * sampling_angle(samples).
///
/// `iterations` counts directions. Converged: the last round's directions were nearer than the
/// tolerance could tell; it says nothing of whether a better one is elsewhere, `least_depth` does.
template <class S>
PenetrationResult<S> sampling(const SupportSet<S>& a, const SupportSet<S>& b, const Pose<S>& b_in_a,
                              const PenetrationOptions<S>& options, PenetrationSteps<S>* steps);

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

}  // namespace contactscope
