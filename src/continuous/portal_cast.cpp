#include "continuous/portal_cast.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/at.h"
#include "geometry/lanes.h"
#include "query/minkowski_difference.h"
#include "query/simplex.h"

namespace contactscope {
namespace {

/// Limits of one search. Pairs of hulls of 32 vertices take six support points on average; beyond
/// these limits the search is Undecided.
constexpr int kMaxDiscoveries = 16, kMaxRefinements = 64;

/// Smaller squares of lengths in units have lost digits to underflow.
template <class S>
constexpr S kMinSquare = std::numeric_limits<S>::min() / std::numeric_limits<S>::epsilon();

/// A point of the core. A hull's are read from its lanes, which the support search has cached.
template <class S> Vec3<S> point_of(const SupportSet<S>& set, int index) {
  if (set.hull == nullptr) return set.points[index];
  return VectorLanes<S>(set.hull->lanes.vertices.data(), set.count)[index];
}

}  // namespace

template <class S>
PortalCast<S>::PortalCast(const Turning<S>& a, const Turning<S>& b, S scale) : a_(a), b_(b) {
  if (scale >= std::numeric_limits<S>::min()) {
    unit_ = power_of_two_up_to(scale);
    per_unit_ = S(1) / unit_;
  }
}

template <class S>
void PortalCast<S>::place(S time, const Vec3<S>& between, const Vec3<S>& offset) {
  rotation_a_ = per_unit_ * a_.rotation(time).toRotationMatrix();
  rotation_b_ = per_unit_ * b_.rotation(time).toRotationMatrix();
  between_ = per_unit_ * between;
  offset_ = per_unit_ * offset;
}

template <class S>
typename PortalCast<S>::Corner PortalCast<S>::corner(int index_a, int index_b) const {
  Corner result;
  result.index_a = index_a;
  result.index_b = index_b;
  result.arm_a = rotation_a_ * (point_of(a_.core(), index_a) - a_.pivot());
  result.arm_b = rotation_b_ * (point_of(b_.core(), index_b) - b_.pivot());
  result.point = between_ + (result.arm_b - result.arm_a);
  return result;
}

template <class S> bool PortalCast<S>::measure(const Vec3<S>& outward, Corner& support) {
  ++supports_;
  plane_.normal = outward / outward.norm();
  const Vec3<S> against_a = -(rotation_a_.transpose() * outward);
  const Vec3<S> along_b = rotation_b_.transpose() * outward;
  support = corner(support_index(a_.core(), against_a), support_index(b_.core(), along_b));
  const S separation = -plane_.normal.dot(support.point);
  const S gap = separation - limits_.target, speed = plane_.normal.dot(offset_);
  plane_.separation = unit_ * separation;
  plane_.time = speed > S(0) ? gap / speed : limits_.until;
  if (!(gap > S(0) && plane_.time > safe_time_)) return false;
  safe_time_ = plane_.time;
  if (planes_ != nullptr) [[unlikely]]
    planes_->push_back(plane_);
  return safe_time_ >= limits_.until;
}

template <class S> CastStatus PortalCast<S>::discover() {
  const S offset_squared = offset_.squaredNorm();
  const Vec3<S> arm_a = rotation_a_ * (middle_of(a_.core()) - a_.pivot());
  const Vec3<S> arm_b = rotation_b_ * (middle_of(b_.core()) - b_.pivot());
  Vec3<S> first = -(between_ + (arm_b - arm_a));
  const S far = first.norm();
  if (!(offset_squared > kMinSquare<S> && far * far > kMinSquare<S>)) return CastStatus::Undecided;
  first /= far;
  if (measure(first, corners_[0])) return CastStatus::Separated;

  // Offset of the point from the path. For ball-like shapes, half of this tilt moves the point to
  // the path. The limit keeps the direction from vanishing.
  constexpr S kMaxTilt = S(0.9), kTilt = S(5);
  const Vec3<S>& point = corners_[0].point;
  Vec3<S> perpendicular = point - (point.dot(offset_) / offset_squared) * offset_;
  S off = perpendicular.norm();
  if (!(off * off > kMinSquare<S>)) perpendicular = any_perpendicular(offset_), off = S(1);
  perpendicular /= off;
  const S tilt = std::min(kMaxTilt, kTilt * off / far);
  if (measure(first - tilt * perpendicular, corners_[1])) return CastStatus::Separated;
  const bool same = corners_[0].index_a == corners_[1].index_a &&  //
                    corners_[0].index_b == corners_[1].index_b;
  if (same && measure(-perpendicular, corners_[1])) return CastStatus::Separated;

  for (int i = 0; i < kMaxDiscoveries; ++i) {
    Vec3<S> across = offset_.cross(corners_[1].point - corners_[0].point);
    const S squared = across.squaredNorm();
    if (!(squared > kMinSquare<S>)) return CastStatus::Undecided;
    across /= std::sqrt(squared);
    if (across.dot(corners_[0].point) > S(0)) {
      across = -across;
      std::swap(corners_[0], corners_[1]);
    }
    // Search near the impact first. Searching across the path finds any point beyond it.
    constexpr int kTilted = 3;
    const bool tilted = i < kTilted;
    if (tilted && measure(across + kMaxTilt * first, corners_[2])) return CastStatus::Separated;
    if (!tilted || across.dot(corners_[2].point) <= S(0)) {
      if (measure(across, corners_[2])) return CastStatus::Separated;
      if (across.dot(corners_[2].point) <= S(0)) return CastStatus::Undecided;
    }
    if (side(corners_[1], corners_[2]) < S(0)) {
      corners_[0] = corners_[2];
    } else if (side(corners_[2], corners_[0]) < S(0)) {
      corners_[1] = corners_[2];
    } else {
      return CastStatus::Hit;
    }
  }
  return CastStatus::Undecided;
}

template <class S> CastStatus PortalCast<S>::refine() {
  for (int i = 0; i < kMaxRefinements; ++i) {
    const Vec3<S> side_01 = corners_[1].point - corners_[0].point;
    const Vec3<S> side_02 = corners_[2].point - corners_[0].point;
    const Vec3<S> normal = side_01.cross(side_02);
    if (!(normal.squaredNorm() > kMinSquare<S> && normal.dot(offset_) > S(0)))
      return CastStatus::Undecided;
    Corner support;
    if (measure(normal, support)) return CastStatus::Separated;
    if (plane_.normal.dot(support.point - corners_[0].point) <= limits_.slack)
      return CastStatus::Hit;
    // Replace corner 2, 0 or 1. If rounding makes none right, any will do.
    const Vec3<S> about = offset_.cross(support.point);
    const bool left_0 = about.dot(corners_[0].point) >= S(0);
    const bool left_1 = about.dot(corners_[1].point) >= S(0);
    const bool left_2 = about.dot(corners_[2].point) >= S(0);
    const int replaced = left_0 && !left_1 ? 2 : left_1 && !left_2 ? 0 : 1;
    at(corners_, replaced) = support;
  }
  return CastStatus::Undecided;
}

template <class S>
CastStatus PortalCast<S>::cast(const CastLimits<S>& limits, std::vector<SupportPlane<S>>* planes) {
  limits_ = {per_unit_ * limits.target, per_unit_ * limits.slack, limits.until};
  planes_ = planes;
  safe_time_ = 0;
  const CastStatus status = discover();
  return status == CastStatus::Hit ? refine() : status;
}

template <class S> CastStatus PortalCast<S>::cast_again(const CastLimits<S>& limits) {
  for (Corner& of : corners_) of = corner(of.index_a, of.index_b);
  const bool passes = side(corners_[0], corners_[1]) >= S(0) &&
                      side(corners_[1], corners_[2]) >= S(0) &&
                      side(corners_[2], corners_[0]) >= S(0);
  if (!passes) return cast(limits);
  limits_ = {per_unit_ * limits.target, per_unit_ * limits.slack, limits.until};
  safe_time_ = 0;
  return refine();
}

template <class S> GjkVertex<S> PortalCast<S>::vertex(int i) const {
  const Corner& of = at(corners_, i);
  return {of.index_a, of.index_b, unit_ * of.arm_a, unit_ * of.arm_b};
}

template <class S> GjkSimplex<S> PortalCast<S>::portal() const {
  GjkSimplex<S> result;
  for (int i = 0; i < 3; ++i) result.vertices.push_back(vertex(i));
  const S across[3] = {side(corners_[1], corners_[2]), side(corners_[2], corners_[0]),
                       side(corners_[0], corners_[1])};
  const S sum = (across[0] + across[1]) + across[2];
  result.weights = {S(1), S(0), S(0), S(0)};
  if (sum > S(0)) result.weights = {across[0] / sum, across[1] / sum, across[2] / sum, S(0)};
  return result;
}

template <class S> Closest<S> PortalCast<S>::closest(S time) const {
  const Vec3<S> gone = time * offset_;
  std::array<Vec3<S>, 4> points = {Vec3<S>::Zero(), Vec3<S>::Zero(), Vec3<S>::Zero(),
                                   Vec3<S>::Zero()};
  for (int i = 0; i < 3; ++i) at(points, i) = at(corners_, i).point + gone;
  NearestOnSimplex<S> nearest;
  nearest_on_simplex(points, 3, S(2), nearest);
  GjkSimplex<S> carrier;
  carrier.weights = nearest.weights;
  for (int i = 0; i < nearest.count; ++i) carrier.vertices.push_back(vertex(at(nearest.kept, i)));
  Closest<S> result;
  result.distance = unit_ * std::sqrt(nearest.squared_distance);
  result.axis = -plane_.normal;
  result.on_a = weighted(carrier, &GjkVertex<S>::a);
  result.on_b = weighted(carrier, &GjkVertex<S>::b) + unit_ * (between_ + gone);
  return result;
}

template class PortalCast<float>;
template class PortalCast<double>;

}  // namespace contactscope
