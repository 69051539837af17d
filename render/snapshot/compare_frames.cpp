#include "snapshot/compare_frames.h"

#include <algorithm>
#include <cmath>

namespace contactscope::snapshot {
namespace {

// Sine and cosine of C libraries differ by one ulp between processors. Such a pose moves by up to
// one ulp of its coordinates; two poses and the transform back to world space make four.
constexpr double kPlaceUlps = 4;
// One ulp in a quaternion moves a shape by up to two ulps of its extent; each later stage (query,
// clip, area) rounds again. Twice the largest sum of those that we could count.
constexpr double kExtentUlps = 16;
// A polygon within the extent has a perimeter of at most 8 extents, which scales area errors.
constexpr double kPerimeter = 8;

double largest_coordinate(const std::vector<Vec3d>& points) {
  double largest = 0;
  for (const Vec3d& point : points) largest = std::max(largest, point.lpNorm<Eigen::Infinity>());
  return largest;
}

/// Largest local coordinate of a shape. A plane is unbounded; its offset is what rounds.
double extent(const trace::Shape& shape) {
  if (shape.half_space) return std::abs(shape.half_space->offset);
  return largest_coordinate(shape.vertices) + shape.radius;
}

}  // namespace

FrameComparison::FrameComparison(const trace::Header& expected)
    : ulp_(std::ldexp(1.0, expected.scalar == "double" ? -52 : -23)) {
  know(expected.shapes);
}

void FrameComparison::know(const std::vector<trace::Shape>& shapes) {
  for (const trace::Shape& shape : shapes) extents_[shape.name] = extent(shape);
}

std::vector<Difference> FrameComparison::header(const trace::Header& expected,
                                                trace::Header& actual) const {
  std::vector<Difference> differences;
  Comparison([&](const std::string& shape, const std::string&) {
    return make(0, extent_of(shape));  // in its local frame
  }).compare(expected, actual, {}, "", differences);
  return differences;
}

std::vector<Difference> FrameComparison::frame(const trace::Frame& expected,
                                               trace::Frame& actual) const {
  std::vector<Difference> differences;
  Comparison([&](const std::string& a, const std::string& b) {
    return of(expected, a, b);
  }).compare(expected, actual, {"", "", of(expected)}, "", differences);
  return differences;
}

/// For one shape or a pair in a frame.
Tolerance FrameComparison::of(const trace::Frame& frame, const std::string& a,
                              const std::string& b) const {
  const double extent = std::max(extent_of(a), extent_of(b));
  double place = 0;
  for (const auto& [name, pose] : frame.poses) {
    if (name != a && name != b) continue;
    place = std::max(place, pose.position.lpNorm<Eigen::Infinity>());
  }
  return make(place, extent);
}

/// For sums over a frame: lengths as for the largest pair, impulses and energies as for all pairs
/// together.
Tolerance FrameComparison::of(const trace::Frame& frame) const {
  Tolerance tolerance = make(0, 0);
  for (const trace::Pair& pair : frame.pairs)
    tolerance.length = std::max(tolerance.length, of(frame, pair.a, pair.b).length);
  const auto add = [&](trace::Kind kind, double value) { tolerance.magnitude(kind) += value; };
  each_magnitude(frame.pairs, add);
  each_magnitude(frame.solver, add);
  return tolerance;
}

double FrameComparison::extent_of(const std::string& shape) const {
  const auto found = extents_.find(shape);
  return found == extents_.end() ? 0 : found->second;
}

Tolerance FrameComparison::make(double place, double extent) const {
  const double local = kExtentUlps * extent * ulp_;
  return {kPlaceUlps * place * ulp_ + local, kExtentUlps * ulp_, kPerimeter * extent * local};
}

}  // namespace contactscope::snapshot
