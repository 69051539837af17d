#include "study/stacked_pair.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/primitives.h"
#include "study/uniform.h"

namespace contactscope {
namespace {

constexpr double kSphereRadius = 0.5;
constexpr double kCapsuleRadius = 0.3;
constexpr double kCapsuleHalfLength = 0.5;
constexpr double kHalfCube = 0.5;
constexpr double kHalfMesh = 4;
constexpr double kLeastCrossing = 0.3;  // radians, between the axes of capsules
constexpr double kShift = 0.2;          // of the size: whatever is on top stays over what is below

Quatd turn(const Vec3d& axis, double radians) {
  return Quatd(Eigen::AngleAxisd(radians, axis));
}

Shape<double> capsule(double half_length, double radius) {
  return Capsule<double>{{Vec3d(-half_length, 0, 0), Vec3d(half_length, 0, 0)}, radius};
}

Shape<double> shape_on_top(OnTop kind, double size) {
  if (kind == OnTop::Sphere) return Sphere<double>{kSphereRadius * size};
  if (kind == OnTop::Capsule) return capsule(kCapsuleHalfLength * size, kCapsuleRadius * size);
  return make_box(Vec3d::Constant(kHalfCube * size));
}

Shape<double> shape_below(Below kind, double size, double aspect) {
  switch (kind) {
    case Below::Sphere:
      return Sphere<double>{kSphereRadius * size};
    case Below::Capsule:
      return capsule(kCapsuleHalfLength * size * aspect, kCapsuleRadius * size);
    case Below::Box:
      return make_box(Vec3d(kHalfCube * size * aspect, kHalfCube * size, kHalfCube * size));
    case Below::Plane:
      return HalfSpace<double>{{Vec3d::UnitY(), 0}};
    case Below::Mesh:
      break;
  }
  const double x = kHalfMesh * size * aspect;
  const double z = kHalfMesh * size;
  // Off the middle, so that what stands there does so on one of the two.
  return build_mesh({{-0.5 * x, 0, -1.5 * z},
                     {1.5 * x, 0, -1.5 * z},
                     {1.5 * x, 0, 0.5 * z},
                     {-0.5 * x, 0, 0.5 * z}},
                    {{0, 2, 1}, {0, 3, 2}});
}

/// Lowest point of a shape of the upper kind, from its centre.
Vec3d lowest_point(const Shape<double>& shape, const Quatd& rotation) {
  if (const auto* sphere = std::get_if<Sphere<double>>(&shape)) return {0, -sphere->radius, 0};
  if (const auto* round = std::get_if<Capsule<double>>(&shape)) {
    const Vec3d end = rotation * round->points[1];
    return (end.y() > 0 ? Vec3d(-end) : end) - Vec3d(0, round->radius, 0);
  }
  Vec3d lowest = Vec3d::Zero();
  for (const Vec3d& vertex : std::get_if<Hull<double>>(&shape)->vertices) {
    const Vec3d turned = rotation * vertex;
    if (turned.y() < lowest.y()) lowest = turned;
  }
  return lowest;
}

double reach_down(const Shape<double>& shape, const Quatd& rotation) {
  return -lowest_point(shape, rotation).y();
}

bool stands_on_a_corner(const PairKind& kind, const Stacking& stacking, int index) {
  return !stacking.crossed && stacking.tilt == 0 && kind.below != Below::Capsule && index % 2 == 1;
}

Quatd rotation_on_top(const PairKind& kind, const Stacking& stacking, int index,
                      std::mt19937_64& engine) {
  const double yaw = uniform(engine, 0, 2 * std::numbers::pi);
  const Quatd any = uniform_rotation(engine);
  if (stacking.crossed) {
    const double edge_down = kind.top == OnTop::Box ? std::numbers::pi / 4 : 0;
    return turn(Vec3d::UnitY(), stacking.angle) * turn(Vec3d::UnitX(), edge_down);
  }
  if (stacking.tilt != 0) return turn(Vec3d::UnitZ(), stacking.tilt);
  if (kind.below == Below::Capsule) {
    // An end that points down would miss the lower one's axis; nearly parallel axes have a study
    // of their own, and rules of their own where they meet.
    return turn(Vec3d::UnitY(),
                kLeastCrossing + yaw / 2 * (1 - 2 * kLeastCrossing / std::numbers::pi));
  }
  return stands_on_a_corner(kind, stacking, index) ? any : turn(Vec3d::UnitY(), yaw);
}

double half_height_below(Below kind, const Quatd& rotation, const Shape<double>& shape) {
  return kind == Below::Plane || kind == Below::Mesh ? 0 : reach_down(shape, rotation);
}

}  // namespace

std::string to_string(const PairKind& kind) {
  constexpr const char* kTop[] = {"sphere", "capsule", "box"};
  constexpr const char* kBelow[] = {"sphere", "capsule", "box", "plane", "mesh"};
  return std::string(kTop[static_cast<int>(kind.top)]) + " on " +
         kBelow[static_cast<int>(kind.below)];
}

StackedPair stacked_pair(const PairKind& kind, const Stacking& stacking, int index,
                         std::mt19937_64& engine) {
  StackedPair pair;
  pair.size = stacking.size;
  pair.below = shape_below(kind.below, stacking.size, stacking.aspect);
  pair.on_top = shape_on_top(kind.top, stacking.size);
  if (stacking.crossed && kind.below == Below::Box) {
    pair.pose_below.rotation = turn(Vec3d::UnitX(), std::numbers::pi / 4);
  }
  pair.pose_on_top.rotation = rotation_on_top(kind, stacking, index, engine);

  const double height_below = half_height_below(kind.below, pair.pose_below.rotation, pair.below);
  const double height_on_top = reach_down(pair.on_top, pair.pose_on_top.rotation);
  pair.pose_below.position.y() = -height_below;
  const double sunk = stacking.overlap * (height_below + height_on_top);
  const double least_shift = 1 - stacking.overlap;
  const double along = uniform(engine, -1, 1) * kShift * stacking.size * least_shift;
  const double aside = uniform(engine, -1, 1) * kShift * stacking.size * least_shift;
  // A long shape is touched anywhere along it.
  const double far = stacking.aspect > 1
                         ? uniform(engine, -0.9, 0.9) * 0.5 * stacking.size * (stacking.aspect - 1)
                         : 0;
  Vec3d shift(along + far, 0, aside);
  if (stands_on_a_corner(kind, stacking, index)) {
    // It is the corner that is to meet the middle of what is below.
    const Vec3d corner = lowest_point(pair.on_top, pair.pose_on_top.rotation);
    shift -= least_shift * Vec3d(corner.x(), 0, corner.z());
  }
  if (kind.below == Below::Sphere) shift.setZero();
  if (kind.below == Below::Capsule && kind.top == OnTop::Sphere) shift.z() = 0;
  if (stacking.crossed) {
    // Along both edges, so that they still cross.
    shift = Vec3d(along + far, 0, 0);
    shift += pair.pose_on_top.rotation * Vec3d(aside, 0, 0);
  }
  pair.pose_on_top.position = shift + Vec3d(0, height_on_top - sunk, 0);
  return pair;
}

StackedPair moved(const StackedPair& pair, const Pose<double>& by) {
  StackedPair result = pair;
  result.pose_below = compose(by, pair.pose_below);
  result.pose_on_top = compose(by, pair.pose_on_top);
  result.pose_below.rotation.normalize();
  result.pose_on_top.rotation.normalize();
  return result;
}

}  // namespace contactscope
