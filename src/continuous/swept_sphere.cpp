#include "continuous/swept_sphere.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace contactscope {
namespace {

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

template decltype(sweep_sphere_triangle<float>) sweep_sphere_triangle<float>;
template decltype(sweep_sphere_triangle<double>) sweep_sphere_triangle<double>;

}  // namespace contactscope
