#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/at.h"
#include "query/minkowski_difference.h"
#include "query/penetration.h"
#include "query/tolerance.h"

/// The methods that penetration() chooses from beside the separating axis test, with its arguments, each
/// in the file of its name; and what they have in common, which all work by support points.
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

/// A vertex of the difference, in units.
template <class S>
struct DifferencePoint {
  Vec3<S> point;
  IndexPair pair;
};

/// Points of the difference and what weights give the deepest point; up to four.
template <class S>
struct WeightedPairs {
  int count = 0;
  std::array<IndexPair, 4> pairs = {};
  std::array<S, 4> weights = {};

  void add(const IndexPair& pair, S weight) {
    at(pairs, count) = pair;
    at(weights, count) = weight;
    ++count;
  }
};

/// The difference with what every step needs: support points, and the best direction so far.
/// Directions `outward` are unit and point from the origin out of the difference, which is from B
/// to A: the contact normal is their opposite.
template <class S>
class BoundedDifference : public MinkowskiDifference<S> {
 public:
  BoundedDifference(const SupportSet<S>& a, const SupportSet<S>& b, const Pose<S>& b_in_a)
      : MinkowskiDifference<S>(a, b, b_in_a),
        is_finite_(std::isfinite(reach_of(a) + reach_of(b)) &&
                   b_in_a.rotation.coeffs().allFinite() && b_in_a.position.allFinite()) {}

  /// False once a coordinate was met that is not finite.
  bool is_finite() const { return is_finite_; }
  /// Of a point of the difference, in units.
  S rounding() const { return tie_tolerance(this->scale()); }
  /// That of the options in units, never less than rounding.
  S tolerance(const PenetrationOptions<S>& options) const {
    return std::max(clip_thickness(this->scale()), options.tolerance * this->scale());
  }
  S upper() const { return upper_; }
  const Vec3<S>& outward() const { return outward_; }
  bool is_separated() const { return upper_ < -rounding(); }

  DifferencePoint<S> point_of(const IndexPair& pair) const { return {this->point(pair), pair}; }
  DifferencePoint<S> support(const Vec3<S>& outward) {
    const DifferencePoint<S> found = point_of(this->support_against(-outward));
    is_finite_ = is_finite_ && found.point.allFinite();
    return found;
  }
  /// The support point along a unit direction, whose distance bounds the depth. True when that is
  /// the least so far: then `weights()` is to be set.
  bool bound(const Vec3<S>& outward, DifferencePoint<S>& found) {
    found = support(outward);
    const S along = outward.dot(found.point);
    if (!(along < upper_)) return false;
    upper_ = along;
    outward_ = outward;
    weights_.count = 0;
    weights_.add(found.pair, S(1));
    return true;
  }
  /// The same, and makes it the best whether it is or not.
  void measure(const Vec3<S>& outward, DifferencePoint<S>& found) {
    upper_ = std::numeric_limits<S>::infinity();
    bound(outward, found);
  }
  WeightedPairs<S>& weights() { return weights_; }

  /// In metres, of the best direction; `lower` is in units.
  PenetrationResult<S> result(PenetrationStatus status, S lower, int iterations) const {
    PenetrationResult<S> result;
    result.status = is_finite_ ? status : PenetrationStatus::NotFinite;
    result.iterations = iterations;
    if (!is_finite_) return result;
    result.depth = this->unit() * std::max(upper_, S(0));
    result.least_depth = std::min(result.depth, this->unit() * std::max(lower, S(0)));
    result.normal = -outward_;
    const GjkSimplex<S> deepest = this->simplex(weights_.pairs, weights_.weights, weights_.count);
    result.on_a = weighted(deepest, &GjkVertex<S>::a);
    result.on_b = weighted(deepest, &GjkVertex<S>::b);
    return result;
  }

 private:
  bool is_finite_;
  S upper_ = std::numeric_limits<S>::infinity();
  Vec3<S> outward_ = Vec3<S>::UnitX();
  WeightedPairs<S> weights_;
};

/// How many steps a method whose own cap is `cap` may take.
template <class S>
int allowed_iterations(const PenetrationOptions<S>& options, int cap) {
  return options.max_iterations > 0 ? std::min(options.max_iterations, cap) : cap;
}

/// Normal of a triangle, counter-clockwise, twice its area long; `longest` becomes the length of its
/// longest side. From where the two shorter sides meet: there the cross product of a needle's sides
/// is relatively exact, and its plane has all three corners within rounding.
template <class S>
Vec3<S> triangle_normal(const Vec3<S>& p, const Vec3<S>& q, const Vec3<S>& r, S& longest) {
  const Vec3<S> pq = q - p, qr = r - q, rp = p - r;
  const S at_r = pq.squaredNorm(), at_p = qr.squaredNorm(), at_q = rp.squaredNorm();
  longest = std::sqrt(std::max({at_p, at_q, at_r}));
  if (at_r >= at_p && at_r >= at_q) return qr.cross(rp);
  return at_p >= at_q ? rp.cross(pq) : pq.cross(qr);
}

}  // namespace contactscope
