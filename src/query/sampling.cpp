#include "query/penetration_bounds.h"

namespace contactscope {
namespace {

/// Cosine and sine of the golden angle, pi (3 - sqrt 5).
constexpr double kGoldenCosine = -0.73736887807831975;
constexpr double kGoldenSine = 0.67549029426152396;

template <class S> S radius_about_middle(const SupportSet<S>& set) {
  if (set.hull != nullptr) return set.hull->radius;
  const Vec3<S> middle = middle_of(set);
  S radius = S(0);
  for (int i = 0; i < set.count; ++i) radius = std::max(radius, (set.points[i] - middle).norm());
  return radius;
}

}  // namespace

template <class S> S sampling_angle(int count) {
  // Measured on the hull of the directions: 2.68 for six, at most 2.734, and 2.728 for many.
  return S(2.75) / std::sqrt(static_cast<S>(count));
}

Vec3d SamplingDirections::next() {
  const double z = 1.0 - (2.0 * index_ + 1.0) / count_;
  const double r = std::sqrt(1.0 - z * z);
  const Vec3d direction(r * cosine_, r * sine_, z);
  const double c = kGoldenCosine * cosine_ - kGoldenSine * sine_;
  const double s = kGoldenSine * cosine_ + kGoldenCosine * sine_;
  const double length = std::sqrt(c * c + s * s);
  cosine_ = c / length;
  sine_ = s / length;
  ++index_;
  return direction;
}

/// The last resort of Gregorius 2015 and Catto 2007: no topology that rounding could corrupt.
///
/// Steps: 1. measure the depth along many evenly spread directions; 2. try six directions around
/// the best, initially at the angle between samples; 3. take a better one; otherwise halve the
/// angle and turn the six by 30 degrees, because a ridge may lie between them; 4. repeat until the
/// angle moves no point by more than the tolerance.
template <class S>
PenetrationResult<S> sampling(const SupportSet<S>& a, const SupportSet<S>& b, const Pose<S>& b_in_a,
                              const PenetrationOptions<S>& options, PenetrationSteps<S>* steps) {
  BoundedDifference<S> difference(a, b, b_in_a);
  if (!difference.is_finite()) return {};
  const int samples = std::clamp(options.samples, kMinSamples, kMaxSamples);
  int directions = 0;
  const auto is_better_along = [&](const Vec3<S>& outward) {
    ++directions;
    DifferencePoint<S> found;
    const bool is_better = difference.bound(outward, found);
    if (steps != nullptr) {
      const S along = outward.dot(found.point);
      steps->directions.push_back({-outward, -difference.unit() * along});
    }
    return is_better;
  };
  SamplingDirections spread_evenly(samples);
  while (directions < samples) {
    is_better_along(spread_evenly.next().cast<S>());
    if (!difference.is_finite() || difference.is_separated())
      return difference.result(PenetrationStatus::Separated, S(0), directions);
  }
  const Vec3<S> middle = (b_in_a.transform(middle_of(b)) - middle_of(a));
  const S reach =
      (middle.norm() + radius_about_middle(a) + radius_about_middle(b)) / difference.unit();
  const S lower = difference.upper() - reach * sampling_angle<S>(samples);

  const S tolerance = difference.tolerance(options);
  const int allowed = allowed_iterations(options, kMaxSamplingRounds);
  PenetrationStatus status = PenetrationStatus::OutOfIterations;
  S angle = sampling_angle<S>(samples);
  bool is_turned = false;
  for (int round = 0; round < allowed; ++round) {
    if (angle * reach <= tolerance) {
      status = PenetrationStatus::Converged;
      break;
    }
    const Vec3<S> center = difference.outward();
    const Vec3<S> one = any_perpendicular(center);
    const Vec3<S> other = center.cross(one);
    bool is_better = false;
    for (int k = 0; k < 6; ++k) {
      // Cosines and sines of multiples of 60 degrees, optionally plus 30.
      constexpr double kCosine[6] = {1, 0.5, -0.5, -1, -0.5, 0.5};
      constexpr double kSine = 0.8660254037844386;
      constexpr double kSines[6] = {0, kSine, kSine, 0, -kSine, -kSine};
      const S c = static_cast<S>(is_turned ? kSines[k] : kCosine[k]);
      const S s = static_cast<S>(is_turned ? kCosine[k] : kSines[k]);
      const Vec3<S> aside = center + angle * (c * one + s * other);
      is_better = is_better_along(aside / aside.norm()) || is_better;
    }
    if (!difference.is_finite() || difference.is_separated()) break;
    if (!is_better) {
      angle *= S(0.5);
      is_turned = !is_turned;
    }
  }
  if (difference.is_separated()) status = PenetrationStatus::Separated;
  return difference.result(status, lower, directions);
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(sampling_angle, sampling);

}  // namespace contactscope
