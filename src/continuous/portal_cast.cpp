#include "continuous/portal_cast.h"

#include "geometry/lanes.h"
#include "query/minkowski_difference.h"

namespace contactscope {
namespace {

/// Limits of one search, which takes six points for hulls of 32 vertices; beyond them: Undecided.
constexpr int kMaxDiscoveries = 16, kMaxRefinements = 64;

/// Smaller squares of lengths in units have lost digits to underflow.
template <class S>
constexpr S kMinSquare = std::numeric_limits<S>::min() / std::numeric_limits<S>::epsilon();

/// A point of the core. A hull's are read from its lanes, which the support search has cached.
template <class S> Vec3<S> point_of(const SupportSet<S>& set, int index) {
  if (set.hull == nullptr) return set.points[index];
  return VectorLanes<S>(set.hull->lanes.vertices.data(), set.count)[index];
}

constexpr double kNever = std::numeric_limits<double>::infinity();

/// The first time at which a t^2 + 2 b t + c falls to 0, from c > 0 at time 0.
double first_root(double a, double b, double c) {
  if (b >= 0) return kNever;  // moves away
  const double discriminant = b * b - a * c;
  if (discriminant < 0) return kNever;
  return c / (-b + std::sqrt(discriminant));
}

class RoundedPrism {
 public:
  RoundedPrism(const Vec3d& start, const Vec3d& shift, double radius,
               const std::array<Vec3d, 3>& corners)
      : start_(start), offset_(shift), radius_(radius), corners_(corners) {}

  SweptSphereHit first_hit() {
    if (overlaps_at_start()) {
      hit_.status = SweptStatus::Overlapping;
      hit_.time = 0;
      return hit_;
    }
    if (!face()) return hit_;
    for (int i = 0; i < 3; ++i) edge(i);
    for (int i = 0; i < 3; ++i) vertex(i);
    return hit_;
  }

 private:
  const Vec3d& corner(int i) const { return corners_[static_cast<std::size_t>(i % 3)]; }
  Vec3d centre(double time) const { return start_ + time * offset_; }

  /// Whether a point is on the inner side of all edges, seen along the face's normal.
  bool inside(const Vec3d& point) const {
    for (int i = 0; i < 3; ++i) {
      const Vec3d along = corner(i + 1) - corner(i);
      if (along.cross(point - corner(i)).dot(normal_) < 0) return false;
    }
    return true;
  }

  bool overlaps_at_start() {
    const Vec3d ab = corner(1) - corner(0), ac = corner(2) - corner(0);
    normal_ = ab.cross(ac);
    twice_area_ = normal_.norm();
    // A smaller normal has a direction of rounding: use only the edges.
    const double longest = std::max(ab.squaredNorm(), ac.squaredNorm());
    is_flat_ = !(twice_area_ > 1e-15 * longest);
    if (!is_flat_) {
      normal_ *= 1 / twice_area_;
      height_ = normal_.dot(start_ - corner(0));
      if (height_ < 0) {  // reverse the corners' order to face the sphere
        height_ = -height_;
        normal_ = -normal_;
        std::swap(corners_[1], corners_[2]);
        swapped_ = true;
      }
      if (height_ > radius_) return false;
      if (inside(start_)) return true;
    }
    for (int i = 0; i < 3; ++i) {
      const Vec3d along = corner(i + 1) - corner(i), offset = start_ - corner(i);
      const double squared = along.squaredNorm();
      const double at = squared > 0 ? std::clamp(offset.dot(along) / squared, 0.0, 1.0) : 0.0;
      if ((offset - at * along).squaredNorm() <= radius_ * radius_) return true;
    }
    return false;
  }

  /// False when the answer is known: the face is hit, or its plane is never reached.
  bool face() {
    if (is_flat_ || height_ <= radius_) return true;
    const double down = -normal_.dot(offset_);
    if (!(down >= height_ - radius_)) return false;  // not as far as the plane
    const double time = (height_ - radius_) / down;
    const Vec3d foot = centre(time) - radius_ * normal_;
    if (!inside(foot)) return true;
    take(time, TriangleFeature::Face, 0, foot);
    return false;
  }

  /// Cylinder about the edge, between the planes of its ends. Cross products with the edge give
  /// perpendicular parts times its length, so no division is needed before the cylinder is hit.
  void edge(int i) {
    const Vec3d along = corner(i + 1) - corner(i);
    const double squared = along.squaredNorm();
    const Vec3d from = start_ - corner(i);
    const Vec3d offset = along.cross(from), shift = along.cross(offset_);
    const double c = offset.squaredNorm() - radius_ * radius_ * squared;
    if (c <= 0) return;  // inside the infinite cylinder: enters through an end, hits a vertex first
    const double time = first_root(shift.squaredNorm(), shift.dot(offset), c);
    if (!(time < hit_.time)) return;
    const double at = (from + time * offset_).dot(along);
    if (at < 0 || at > squared) return;
    take(time, TriangleFeature::Edge, i, corner(i) + at / squared * along);
  }

  void vertex(int i) {
    const Vec3d offset = start_ - corner(i);
    const double time = first_root(offset_.squaredNorm(), offset_.dot(offset),
                                   offset.squaredNorm() - radius_ * radius_);
    if (time < hit_.time) take(time, TriangleFeature::Vertex, i, corner(i));
  }

  void take(double time, TriangleFeature feature, int index, const Vec3d& point) {
    hit_.status = SweptStatus::Hit;
    hit_.time = time;
    hit_.feature = feature;
    // In the caller's numbering, whose corners may be in reverse order.
    if (swapped_) index = feature == TriangleFeature::Edge ? (5 - index) % 3 : (3 - index) % 3;
    hit_.index = feature == TriangleFeature::Face ? 0 : index;
    hit_.point = point;
    hit_.normal = (centre(time) - point).normalized();
  }

  Vec3d start_, offset_;
  double radius_;
  std::array<Vec3d, 3> corners_;
  Vec3d normal_ = Vec3d::Zero();  // towards the sphere
  double twice_area_ = 0;
  double height_ = 0;  // of the start above the plane
  bool is_flat_ = false, swapped_ = false;
  SweptSphereHit hit_;
};

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

template <class S>
SweptSphereHit sweep_sphere_triangle(const Vec3<S>& start, const Vec3<S>& displacement, S radius,
                                     const std::array<Vec3<S>, 3>& triangle) {
  const Vec3d origin = triangle[0].template cast<double>();
  const auto relative = [&](const Vec3<S>& point) -> Vec3d {
    return point.template cast<double>() - origin;
  };
  return RoundedPrism(relative(start), displacement.template cast<double>(),
                      static_cast<double>(radius),
                      {Vec3d::Zero(), relative(triangle[1]), relative(triangle[2])})
      .first_hit();
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(sweep_sphere_triangle);

}  // namespace contactscope
