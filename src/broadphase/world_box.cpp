#include "broadphase/world_box.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "broadphase/broad_phase.h"

namespace contactscope {
namespace {

/// For a transformed point: three products and four sums of numbers up to `scale` below.
constexpr double kRoundings = 8;

/// World box of a shape before rounding.
template <class S> struct Reach {
  Pose<double> pose;
  Aabb<double> box{};
  double scale = 0;  // metres, largest number that the narrow phase adds for a point

  void add(const Vec3<S>& local, S radius = S(0)) {
    const Vec3d point = local.template cast<double>();
    const Vec3d center = pose.transform(point);
    const Vec3d around = Vec3d::Constant(static_cast<double>(radius));
    box.include(center - around);
    box.include(center + around);
    grow_scale(point.norm() + static_cast<double>(radius));
  }
  void grow_scale(double length) {
    scale = std::max(scale, length + pose.position.cwiseAbs().maxCoeff());
  }

  void operator()(const Sphere<S>& sphere) { add(Vec3<S>::Zero(), sphere.radius); }
  void operator()(const Capsule<S>& capsule) {
    for (const Vec3<S>& end : capsule.points) add(end, capsule.radius);
  }
  void operator()(const Hull<S>& hull) {
    for (const Vec3<S>& vertex : hull.vertices) add(vertex);
  }
  void operator()(const Mesh<S>& mesh) {
    const Aabb<S> bounds = mesh.tree.bounds();
    for (int corner = 0; corner < 8; ++corner) {
      Vec3<S> point;
      for (int axis = 0; axis < 3; ++axis)
        point[axis] = corner >> axis & 1 ? bounds.upper[axis] : bounds.lower[axis];
      add(point);
    }
  }
  void operator()(const Field<S>& field) { std::visit(*this, field.source->shape); }
  /// Infinite, except along an axis parallel to its normal.
  void operator()(const HalfSpace<S>& half_space) {
    constexpr double kNoEnd = std::numeric_limits<double>::infinity();
    const Plane<double> plane = half_space.plane.template cast<double>();
    const Vec3d normal = pose.rotate(plane.normal);
    const double offset = plane.offset + normal.dot(pose.position);
    box = {Vec3d::Constant(-kNoEnd), Vec3d::Constant(kNoEnd)};
    for (int axis = 0; axis < 3; ++axis) {
      if (normal[axis] == 1) box.upper[axis] = offset;
      if (normal[axis] == -1) box.lower[axis] = -offset;
    }
    grow_scale(std::abs(plane.offset));
  }
};

}  // namespace

template <class S>
Aabb<float> world_box(const Shape<S>& shape, const Pose<S>& pose, double margin) {
  Reach<S> reach{pose.template cast<double>()};
  std::visit(reach, shape);
  const double epsilon = static_cast<double>(std::numeric_limits<S>::epsilon());
  const Vec3d out = Vec3d::Constant(margin + kRoundings * epsilon * reach.scale);
  return outward_box({reach.box.lower - out, reach.box.upper + out});
}

template Aabb<float> world_box(const Shape<float>&, const Pose<float>&, double);
template Aabb<float> world_box(const Shape<double>&, const Pose<double>&, double);

}  // namespace contactscope
