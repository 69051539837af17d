#include "continuous/impact_with_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "broadphase/broad_phase.h"
#include "continuous/approach.h"
#include "continuous/swept_sphere.h"
#include "core/instantiate.h"

namespace contactscope {
namespace {

/// Box in the mesh's frame around the shape's whole sweep. Between two samples, a point with an
/// acceleration of at most k is off the straight line by at most k / 8 times the squared interval.
Aabb<double> swept_box(const MovingShape<double>& shape, const Sweep<double>& of_mesh) {
  const Turning<double> turning(shape);
  const bool turns = !of_mesh.turn.isZero(0) || !shape.motion.turn.isZero(0);
  const Vec3d between = between_pivots(of_mesh, shape.motion);
  const Vec3d offset = shape.motion.displacement - of_mesh.displacement;
  const double angle = of_mesh.turn.norm();
  const double reach = std::max(between.norm(), Vec3d(between + offset).norm()) + turning.reach();
  const double acceleration = turning.acceleration() +
                              2 * angle * (offset.norm() + turning.speed()) + angle * angle * reach;
  // Enough samples that the box grows by no more than about a tenth of the shape.
  constexpr int kMaxLooks = 32;
  const double wanted = std::sqrt(acceleration / std::max(0.8 * turning.reach(), 1e-30));
  const int looks = turns ? static_cast<int>(std::clamp<double>(wanted, 1, kMaxLooks)) : 1;
  Aabb<double> box;
  for (int i = 0; i <= looks; ++i) {
    const double time = static_cast<double>(i) / static_cast<double>(looks);
    Sweep<double> turning_mesh;
    turning_mesh.start.rotation = of_mesh.start.rotation;
    turning_mesh.turn = of_mesh.turn;
    const Quatd to_mesh = turning_mesh.at(time).rotation.conjugate();
    const Quatd rotation = to_mesh * turning.rotation(time);
    const Vec3d pivot = to_mesh * Vec3d(between + time * offset) + of_mesh.pivot;
    for (int p = 0; p < shape.core.count; ++p)
      box.include(pivot + rotation * Vec3d(shape.core.points[p] - turning.pivot()));
  }
  const double rounding = tie_tolerance(reach + of_mesh.pivot.norm());
  const Vec3d grown = Vec3d::Constant(shape.radius + rounding +
                                      acceleration / static_cast<double>(8 * looks * looks));
  return {box.lower - grown, box.upper + grown};
}

/// Exact impact of a ball with one mesh triangle. No turn moves the triangle or the ball's centre.
ImpactResult<double> ball_against(const std::array<Vec3d, 3>& corners, const Sweep<double>& of_mesh,
                                  const MovingShape<double>& ball) {
  // In a frame that moves with the mesh's origin, with the world's axes.
  const Vec3d start = (ball.motion.start.position - of_mesh.start.position) +
                      ball.motion.start.rotate(ball.core.points[0]);
  std::array<Vec3d, 3> placed;
  for (std::size_t i = 0; i < 3; ++i) placed[i] = of_mesh.start.rotate(corners[i]);
  const Vec3d offset = ball.motion.displacement - of_mesh.displacement;
  const SweptSphereHit hit = sweep_sphere_triangle(start, offset, ball.radius, placed);
  ImpactResult<double> result;
  result.steps = 1;
  result.time = hit.time;
  result.status = hit.status == SweptStatus::Hit           ? ImpactStatus::Hit
                  : hit.status == SweptStatus::Overlapping ? ImpactStatus::Overlapping
                                                           : ImpactStatus::Separated;
  if (hit.status != SweptStatus::Hit) return result;
  const Vec3d origin = of_mesh.start.position + result.time * of_mesh.displacement;
  result.normal = hit.normal;
  result.on_a = origin + placed[0] + hit.point;
  result.on_b = result.on_a;
  return result;
}

/// Casts to the scalar of the queried tree, rounded outwards.
template <class S> Aabb<S> tree_box(const Aabb<double>& box) {
  if constexpr (std::is_same_v<S, float>)
    return outward_box(box);
  else
    return box;
}

/// Calls visit(triangle) for each triangle of `b` that may come near `a`, until it returns true.
template <class S, class Visit>
void visit_near(const Mesh<S>& a, const Sweep<double>& of_a, const Mesh<S>& b,
                const Sweep<double>& of_b, double gap, const Visit& visit) {
  const auto may_meet = [&](const MovingShape<double>& part) {
    return a.tree.any_of(tree_box<S>(swept_box(part, of_a)), [](int) { return true; });
  };
  for (int i = 0; i < count_of(b.tree.nodes);) {
    const typename AabbTree<S>::Node& node = at(b.tree.nodes, i);
    std::array<Vec3d, 8> corners;
    for (int k = 0; k < 8; ++k)
      for (int axis = 0; axis < 3; ++axis)
        at(corners, k)[axis] = (k >> axis & 1) != 0 ? node.box.upper[axis] : node.box.lower[axis];
    const bool near = may_meet({{corners.data(), 8, nullptr}, of_b, gap});
    if (near && node.leaf()) {
      for (int k = node.next; k < node.next + node.count; ++k)
        if (visit(at(b.tree.triangles, k))) return;
    }
    i = near || node.leaf() ? i + 1 : node.next;
  }
}

}  // namespace

template <class S>
ShapeImpact<double> impact_with_mesh(const Mesh<S>& mesh, const Sweep<double>& of_mesh,
                                     const MovingShape<double>& shape, ImpactMethod method,
                                     ImpactLimits<double> allowed, ImpactRun<double>* run) {
  ShapeImpact<double> found;
  found.result.status = ImpactStatus::Separated;
  found.result.time = allowed.until;
  // A ball may turn about its centre.
  const bool exact = shape.core.count == 1 && shape.radius > 0 && of_mesh.turn.isZero(0) &&
                     (shape.motion.turn.isZero(0) || shape.core.points[0] == shape.motion.pivot) &&
                     allowed.gap == 0;
  mesh.tree.any_of(tree_box<S>(swept_box(shape, of_mesh)), [&](int triangle) {
    const std::array<Vec3d, 3> corners = corners_of(mesh, triangle);
    ++found.triangles;
    const ImpactResult<double> one =
        exact ? ball_against(corners, of_mesh, shape)
              : impact_by(method, moving_triangle(corners, of_mesh), shape, allowed, nullptr);
    if (one.status == ImpactStatus::Separated ||
        (one.status == ImpactStatus::Overlapping && allowed.passes_overlaps))
      return false;
    const bool first = one.status == ImpactStatus::Overlapping || found.triangle < 0 ||
                       one.time < found.result.time;
    if (first) {
      found.result = one;
      found.triangle = triangle;
      allowed.until = std::max(one.time, std::numeric_limits<double>::min());
    }
    return one.status == ImpactStatus::Overlapping;
  });
  if (run != nullptr) [[unlikely]] {
    run->result = found.result;
    if (found.triangle >= 0 && !exact) {
      const std::array<Vec3d, 3> corners = corners_of(mesh, found.triangle);
      allowed.until = 1;
      impact_by(method, moving_triangle(corners, of_mesh), shape, allowed, run);
    }
  }
  return found;
}

template <class S>
ShapeImpact<double> impact_of_rigid_meshes(const Mesh<S>& a, const Sweep<double>& of_a,
                                           const Mesh<S>& b, const Sweep<double>& of_b,
                                           ImpactMethod method, ImpactLimits<double> allowed,
                                           ImpactRun<double>* run) {
  ShapeImpact<double> found;
  found.result.status = ImpactStatus::Separated;
  found.result.time = allowed.until;
  visit_near(a, of_a, b, of_b, allowed.gap, [&](int triangle) {
    const std::array<Vec3d, 3> corners = corners_of(b, triangle);
    const ShapeImpact<double> one =
        impact_with_mesh(a, of_a, moving_triangle(corners, of_b), method, allowed, nullptr);
    found.triangles += one.triangles;
    if (one.triangle < 0) return false;
    found.result = one.result;
    found.triangle = one.triangle;
    found.triangle_of_b = triangle;
    allowed.until = std::max(one.result.time, std::numeric_limits<double>::min());
    return one.result.status == ImpactStatus::Overlapping;
  });
  if (run != nullptr) [[unlikely]] {
    run->result = found.result;
    if (found.triangle >= 0) {
      const std::array<Vec3d, 3> first = corners_of(a, found.triangle),
                                 second = corners_of(b, found.triangle_of_b);
      allowed.until = 1;
      impact_by(method, moving_triangle(first, of_a), moving_triangle(second, of_b), allowed, run);
    }
  }
  return found;
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(impact_with_mesh, impact_of_rigid_meshes);

}  // namespace contactscope
