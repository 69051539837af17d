#pragma once

#include "query/minkowski_difference.h"
#include "query/penetration.h"
#include "query/tolerance.h"

/// The methods of penetration() other than the separating axis test, each in a file of its name,
/// and their common parts. All of them use support points.
namespace contactscope {

/// Maximum iterations of EPA and MPR (with the first portal). EPA's polytope then has at most 4 +
/// kMaxEpaIterations vertices, and 2V - 4 triangles.
inline constexpr int kMaxEpaIterations = 256;
inline constexpr int kMaxMprIterations = 256;
/// Limits of the number of sampling directions, and of rounds of the search around the best.
inline constexpr int kMinSamples = 6;
inline constexpr int kMaxSamples = 1 << 20;
inline constexpr int kMaxSamplingRounds = 128;

/// Expanding polytope algorithm. If Converged, `depth` and `least_depth` are bounds of the true
/// depth that differ by at most the tolerance, up to rounding.
template <class S>
PenetrationResult<S> epa(const SupportSet<S>& a, const SupportSet<S>& b, const Pose<S>& b_in_a,
                         const PenetrationOptions<S>& options, const GjkSimplex<S>* overlap,
                         PenetrationSteps<S>* steps);

/// Minkowski portal refinement.
///
/// **Known weakness**: the normal is that of the face where the ray from the centre of the
/// difference through the origin leaves it. For a plate off centre on another, the ray may leave
/// through a side. The depth is correct along that normal, so it is never less than the least depth
/// but can be many times larger; `study penetration` measures it. There is no lower bound.
template <class S>
PenetrationResult<S> mpr(const SupportSet<S>& a, const SupportSet<S>& b, const Pose<S>& b_in_a,
                         const PenetrationOptions<S>& options, PenetrationSteps<S>* steps);

/// Brute force over directions. `depth` belongs to the best direction that was tried. The depth
/// along a direction changes by at most R times the angle, where R is the largest distance of a
/// point of the difference from the origin. So the true depth is at least `least_depth`: the best
/// of the even samples minus R * sampling_angle(samples).
///
/// `iterations` counts directions. Converged: the last round's directions differed by less than the
/// tolerance. A better direction may exist elsewhere; `least_depth` accounts for that.
template <class S>
PenetrationResult<S> sampling(const SupportSet<S>& a, const SupportSet<S>& b, const Pose<S>& b_in_a,
                              const PenetrationOptions<S>& options, PenetrationSteps<S>* steps);

/// Largest angle, radians, from any direction to the nearest of `count` sampled ones. For the
/// Fibonacci sphere it occurs at the poles. The constant is measured; a test verifies it.
template <class S> S sampling_angle(int count);

/// The Fibonacci sphere of evenly distributed unit directions (Gonzalez, "Measurement of Areas on a
/// Sphere Using Fibonacci and Latitude-Longitude Lattices", 2010): each is a little lower than the
/// last and turned by the golden angle about z. A library's sine would differ between processors.
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
template <class S> struct DifferencePoint {
  Vec3<S> point;
  IndexPair pair;
};

/// Up to four points of the difference, with the weights of the deepest point.
template <class S> struct WeightedPairs {
  int count = 0;
  std::array<IndexPair, 4> pairs = {};
  std::array<S, 4> weights = {};

  void add(const IndexPair& pair, S weight) {
    at(pairs, count) = pair;
    at(weights, count) = weight;
    ++count;
  }
};

/// The difference with the state of all methods: support points and the best direction so far.
/// `outward` directions are unit, out of the difference, from B to A, against the contact normal.
template <class S> class BoundedDifference : public MinkowskiDifference<S> {
 public:
  BoundedDifference(const SupportSet<S>& a, const SupportSet<S>& b, const Pose<S>& b_in_a)
      : MinkowskiDifference<S>(a, b, b_in_a),
        is_finite_(std::isfinite(reach_of(a) + reach_of(b)) &&
                   b_in_a.rotation.coeffs().allFinite() && b_in_a.position.allFinite()) {}

  /// False once a coordinate was not finite.
  bool is_finite() const { return is_finite_; }
  /// Rounding error of a point of the difference, in units.
  S rounding() const { return tie_tolerance(this->scale()); }
  /// Tolerance of the options in units, at least the rounding error.
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
  /// Computes the support point along a unit direction, whose distance bounds the depth. Returns
  /// true if it is the smallest so far; the caller must then set `weights()`.
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
  /// The same, but always makes it the best direction.
  void measure(const Vec3<S>& outward, DifferencePoint<S>& found) {
    upper_ = std::numeric_limits<S>::infinity();
    bound(outward, found);
  }
  WeightedPairs<S>& weights() { return weights_; }

  /// Result for the best direction, in metres; `lower` is in units.
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

/// Maximum number of steps of a method whose own limit is `cap`.
template <class S> int allowed_iterations(const PenetrationOptions<S>& options, int cap) {
  return options.max_iterations > 0 ? std::min(options.max_iterations, cap) : cap;
}

/// Normal of a triangle, counter-clockwise, of length twice its area; `longest` becomes its longest
/// side. Uses the two shorter sides: for needles their cross product has a small relative error,
/// and the plane through their common corner contains all corners within rounding.
template <class S>
Vec3<S> triangle_normal(const Vec3<S>& p, const Vec3<S>& q, const Vec3<S>& r, S& longest) {
  const Vec3<S> pq = q - p, qr = r - q, rp = p - r;
  const S at_r = pq.squaredNorm(), at_p = qr.squaredNorm(), at_q = rp.squaredNorm();
  longest = std::sqrt(std::max({at_p, at_q, at_r}));
  if (at_r >= at_p && at_r >= at_q) return qr.cross(rp);
  return at_p >= at_q ? rp.cross(pq) : pq.cross(qr);
}

}  // namespace contactscope
