#include "continuous/impact_of_shapes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "continuous/approach_to_plane.h"
#include "continuous/swept_sphere.h"
#include "field/distance_field.h"

namespace contactscope {
namespace {

template <class A, class S>
ImpactResult<S> impact_by(ImpactMethod method, const A& a, const MovingShape<S>& b,
                          const ImpactLimits<S>& allowed, ImpactRun<S>* run) {
  return method == ImpactMethod::ConservativeAdvancement
             ? conservative_advancement(a, b, allowed, run)
             : time_of_impact(a, b, allowed, run);
}

/// The core of a convex shape, or of a mesh as a plane meets it: by its vertices. A sphere's centre
/// is `centre`, which must outlive the result.
template <class S>
MovingShape<S> moving(const Shape<S>& shape, const Sweep<S>& motion, const Vec3<S>& centre) {
  switch (kind_of(shape)) {
    case ShapeKind::Sphere:
      return {support_set(centre), motion, std::get<Sphere<S>>(shape).radius};
    case ShapeKind::Capsule: {
      const auto& capsule = std::get<Capsule<S>>(shape);
      return {{capsule.points.data(), 2, nullptr}, motion, capsule.radius};
    }
    case ShapeKind::Hull:
      return {support_set(std::get<Hull<S>>(shape)), motion, 0};
    default: {
      const auto& vertices = std::get<Mesh<S>>(shape).vertices;
      return {{vertices.data(), static_cast<int>(vertices.size()), nullptr}, motion, 0};
    }
  }
}

/// A box in the mesh's frame around everything that the shape sweeps. Between two of the times at
/// which it is looked at, a point that is accelerated by no more than k is off the straight line by
/// no more than k / 8 times the square of the time between.
template <class S>
Aabb<S> swept_box(const MovingShape<S>& shape, const Sweep<S>& of_mesh) {
  const Turning<S> turning(shape);
  const bool turns = !of_mesh.turn.isZero(S(0)) || !shape.motion.turn.isZero(S(0));
  const Vec3<S> between = between_pivots(of_mesh, shape.motion);
  const Vec3<S> way = shape.motion.displacement - of_mesh.displacement;
  const S angle = of_mesh.turn.norm();
  const S reach = std::max(between.norm(), Vec3<S>(between + way).norm()) + turning.reach();
  const S acceleration = turning.acceleration() + S(2) * angle * (way.norm() + turning.speed()) +
                         angle * angle * reach;
  // As many looks as keep the box from growing by more than about a tenth of the shape.
  constexpr int kMostLooks = 32;
  const S wanted = std::sqrt(acceleration / std::max(S(0.8) * turning.reach(), S(1e-30)));
  const int looks = turns ? static_cast<int>(std::clamp(wanted, S(1), S(kMostLooks))) : 1;
  Aabb<S> box;
  for (int i = 0; i <= looks; ++i) {
    const S time = static_cast<S>(i) / static_cast<S>(looks);
    Sweep<S> turning_mesh;
    turning_mesh.start.rotation = of_mesh.start.rotation;
    turning_mesh.turn = of_mesh.turn;
    const Quat<S> to_mesh = turning_mesh.at(time).rotation.conjugate();
    const Quat<S> rotation = to_mesh * turning.rotation(time);
    const Vec3<S> pivot = to_mesh * Vec3<S>(between + time * way) + of_mesh.pivot;
    for (int p = 0; p < shape.core.count; ++p)
      box.include(pivot + rotation * Vec3<S>(shape.core.points[p] - turning.pivot()));
  }
  const S rounding = tie_tolerance(reach + of_mesh.pivot.norm());
  const Vec3<S> grown =
      Vec3<S>::Constant(shape.radius + rounding + acceleration / static_cast<S>(8 * looks * looks));
  return {box.lower - grown, box.upper + grown};
}

/// A ball against one triangle of a mesh, neither of which turns the other's way: exactly.
template <class S>
ImpactResult<S> ball_against(const std::array<Vec3<S>, 3>& corners, const Sweep<S>& of_mesh,
                             const MovingShape<S>& ball) {
  // In a frame that goes with the mesh's origin. Its axes are the world's.
  const Vec3<S> start = (ball.motion.start.position - of_mesh.start.position) +
                        ball.motion.start.rotate(ball.core.points[0]);
  std::array<Vec3<S>, 3> placed;
  for (std::size_t i = 0; i < 3; ++i) placed[i] = of_mesh.start.rotate(corners[i]);
  const Vec3<S> way = ball.motion.displacement - of_mesh.displacement;
  const SweptSphereHit hit = sweep_sphere_triangle(start, way, ball.radius, placed);
  ImpactResult<S> result;
  result.steps = 1;
  result.time = static_cast<S>(hit.time);
  result.status = hit.status == SweptStatus::Hit           ? ImpactStatus::Hit
                  : hit.status == SweptStatus::Overlapping ? ImpactStatus::Overlapping
                                                           : ImpactStatus::Separated;
  if (hit.status != SweptStatus::Hit) return result;
  // Rounded towards the start: never late.
  if (static_cast<double>(result.time) > hit.time) result.time = std::nextafter(result.time, S(0));
  const Vec3<S> origin = of_mesh.start.position + result.time * of_mesh.displacement;
  result.normal = hit.normal.template cast<S>();
  result.on_a = origin + placed[0] + hit.point.template cast<S>();
  result.on_b = result.on_a;
  return result;
}

template <class S>
ShapeImpact<S> mesh_impact(const Mesh<S>& mesh, const Sweep<S>& of_mesh,
                           const MovingShape<S>& shape, ImpactMethod method,
                           ImpactLimits<S> allowed, ImpactRun<S>* run) {
  ShapeImpact<S> found;
  found.result.status = ImpactStatus::Separated;
  found.result.time = allowed.until;
  // A ball turns as it likes where its centre is the pivot.
  const bool exact =
      shape.core.count == 1 && shape.radius > S(0) && of_mesh.turn.isZero(S(0)) &&
      (shape.motion.turn.isZero(S(0)) || shape.core.points[0] == shape.motion.pivot) &&
      allowed.gap == S(0);
  std::array<Vec3<S>, 3> corners;
  const auto corners_of = [&](int triangle) {
    for (int k = 0; k < 3; ++k) at(corners, k) = mesh.corner(triangle, k);
  };
  mesh.tree.any_of(swept_box(shape, of_mesh), [&](int triangle) {
    corners_of(triangle);
    ++found.triangles;
    const ImpactResult<S> one =
        exact ? ball_against(corners, of_mesh, shape)
              : impact_by(method, MovingShape<S>{{corners.data(), 3, nullptr}, of_mesh, 0}, shape,
                          allowed, static_cast<ImpactRun<S>*>(nullptr));
    if (one.status == ImpactStatus::Separated ||
        (one.status == ImpactStatus::Overlapping && allowed.passes_overlaps))
      return false;
    const bool first = one.status == ImpactStatus::Overlapping || found.triangle < 0 ||
                       one.time < found.result.time;
    if (first) {
      found.result = one;
      found.triangle = triangle;
      allowed.until = std::max(one.time, std::numeric_limits<S>::min());
    }
    return one.status == ImpactStatus::Overlapping;
  });
  if (run != nullptr) [[unlikely]] {
    run->result = found.result;
    if (found.triangle >= 0 && !exact) {
      corners_of(found.triangle);
      allowed.until = 1;
      impact_by(method, MovingShape<S>{{corners.data(), 3, nullptr}, of_mesh, 0}, shape, allowed,
                run);
    }
  }
  return found;
}

template <class S>
void swap_sides(ImpactResult<S>& result) {
  result.normal = -result.normal;
  std::swap(result.on_a, result.on_b);
}

}  // namespace

const std::vector<ImpactMethodInfo>& impact_methods() {
  const auto info = [](ImpactMethod method, const char* summary) {
    return ImpactMethodInfo{method, to_string(method), summary};
  };
  static const std::vector<ImpactMethodInfo> kAll = {
      info(ImpactMethod::Speculative,
           "contacts as far apart as the two can come nearer in the step; pushes where nothing "
           "would "
           "meet (ghosts)"),
      info(ImpactMethod::Swept, "a cast of the shapes as they stand; misses what meets by turning"),
      info(ImpactMethod::ConservativeAdvancement,
           "safe steps of the distance over the fastest approach (Mirtich 1996)"),
      info(ImpactMethod::TimeOfImpact,
           "roots of the separation along the axis of GJK (Catto 2013), bounded so that none is "
           "late"),
  };
  return kAll;
}

std::optional<std::string> impact_refusal(ShapeKind a, ShapeKind b) {
  const bool fields = a == ShapeKind::Field && b == ShapeKind::Field;
  const bool with_mesh = (a == ShapeKind::Field && b == ShapeKind::Mesh) ||
                         (a == ShapeKind::Mesh && b == ShapeKind::Field);
  if (fields || with_mesh)
    return std::string("when a distance field meets ") + (fields ? "another one" : "a mesh") +
           " is not known; one of the shapes must be convex or a plane";
  if (is_convex(a) || is_convex(b) || (a != b)) return std::nullopt;
  return std::string("when two ") + to_string(a) + (a == ShapeKind::Mesh ? "es" : "s") +
         " meet is not known; one of the shapes must be convex, or a mesh against a plane";
}

namespace {

/// What is asked of a field: what it was made of.
template <class S>
const Shape<S>& surface_of(const Shape<S>& shape) {
  const auto* field = std::get_if<Field<S>>(&shape);
  return field == nullptr ? shape : field->source->shape;
}

/// Whether a convex shape, which touches nothing of what a field was made of, is inside of it.
template <class S>
bool starts_inside(const Shape<S>& shape, const Sweep<S>& of_field, const Shape<S>& convex,
                   const Sweep<S>& of_convex) {
  const auto* field = std::get_if<Field<S>>(&shape);
  if (field == nullptr || !is_convex(kind_of(convex))) return false;
  const Vec3<S> centre = Vec3<S>::Zero();
  const MovingShape<S> other = moving(convex, of_convex, centre);
  const Vec3<S> point = other.motion.start.transform(other.core.points[0]);
  const Vec3<S> arm = point - of_field.start.position;
  const Vec3<S> own = of_field.start.rotation.conjugate() * arm;
  const PlacedField placed{field->values, field->origin, field->cell};
  return placed.sample(own.template cast<double>()).distance < 0;
}

template <class S>
Sweep<S> without_turn(Sweep<S> sweep) {
  sweep.turn.setZero();
  return sweep;
}

/// Two shapes in the order in which they are worked on: a plane first, or else a mesh.
template <class S>
struct Ordered {
  Ordered(const Shape<S>& a, const Sweep<S>& sweep_a, const Shape<S>& b, const Sweep<S>& sweep_b)
      : swapped(kind_of(b) == ShapeKind::Plane ||
                (kind_of(b) == ShapeKind::Mesh && kind_of(a) != ShapeKind::Plane)),
        first(swapped ? b : a),
        of_first(swapped ? sweep_b : sweep_a),
        second(swapped ? moving(a, sweep_a, centre) : moving(b, sweep_b, centre)) {}

  Vec3<S> centre = Vec3<S>::Zero();  // of a sphere
  bool swapped;
  const Shape<S>& first;
  const Sweep<S>& of_first;
  MovingShape<S> second;
};

template <class S, class Approach>
std::vector<S> measured(Approach&& approach, S radii, int count) {
  std::vector<S> distances;
  for (int i = 0; i < count; ++i) {
    const S time = static_cast<S>(i) / static_cast<S>(count - 1);
    distances.push_back(std::max(approach.measure(time).distance - radii, S(0)));
  }
  return distances;
}

}  // namespace

template <class S>
ShapeImpact<S> impact_of_shapes(const Shape<S>& a, const Sweep<S>& sweep_a, const Shape<S>& b,
                                const Sweep<S>& sweep_b, ImpactMethod method,
                                const ImpactLimits<S>& allowed, ImpactRun<S>* run) {
  if (method == ImpactMethod::Swept && !(sweep_a.turn.isZero(S(0)) && sweep_b.turn.isZero(S(0))))
    return impact_of_shapes(a, without_turn(sweep_a), b, without_turn(sweep_b), method, allowed,
                            run);
  if (kind_of(a) == ShapeKind::Field || kind_of(b) == ShapeKind::Field) {
    ShapeImpact<S> found =
        impact_of_shapes(surface_of(a), sweep_a, surface_of(b), sweep_b, method, allowed, run);
    const bool inside =
        starts_inside(a, sweep_a, b, sweep_b) || starts_inside(b, sweep_b, a, sweep_a);
    if (inside && found.result.status != ImpactStatus::Overlapping) {
      found = {};
      found.result.status = ImpactStatus::Overlapping;
      if (run != nullptr) *run = {found.result, {}};
    }
    return found;
  }
  const Ordered<S> pair(a, sweep_a, b, sweep_b);
  ShapeImpact<S> found;
  if (const auto* plane = std::get_if<HalfSpace<S>>(&pair.first)) {
    found.result =
        impact_by(method, MovingPlane<S>{plane->plane, pair.of_first}, pair.second, allowed, run);
  } else if (const auto* mesh = std::get_if<Mesh<S>>(&pair.first)) {
    found = mesh_impact(*mesh, pair.of_first, pair.second, method, allowed, run);
  } else {
    found.result = impact_by(method, moving(pair.first, pair.of_first, pair.centre), pair.second,
                             allowed, run);
  }
  if (pair.swapped) {
    swap_sides(found.result);
    if (run != nullptr) {
      swap_sides(run->result);
      for (ImpactStep<S>& step : run->steps) step.axis = -step.axis;
    }
  }
  return found;
}

template <class S>
std::vector<S> distances_through(const Shape<S>& a, const Sweep<S>& sweep_a, const Shape<S>& b,
                                 const Sweep<S>& sweep_b, int triangle, int count) {
  const Ordered<S> pair(surface_of(a), sweep_a, surface_of(b), sweep_b);
  if (const auto* plane = std::get_if<HalfSpace<S>>(&pair.first))
    return measured<S>(ApproachToPlane<S>({plane->plane, pair.of_first}, pair.second),
                       pair.second.radius, count);
  std::array<Vec3<S>, 3> corners;
  MovingShape<S> first;
  if (const auto* mesh = std::get_if<Mesh<S>>(&pair.first)) {
    if (triangle < 0) return {};
    for (int k = 0; k < 3; ++k) at(corners, k) = mesh->corner(triangle, k);
    first = {{corners.data(), 3, nullptr}, pair.of_first, 0};
  } else {
    first = moving(pair.first, pair.of_first, pair.centre);
  }
  return measured<S>(Approach<S>(first, pair.second), first.radius + pair.second.radius, count);
}

template decltype(impact_of_shapes<float>) impact_of_shapes<float>;
template decltype(impact_of_shapes<double>) impact_of_shapes<double>;
template decltype(distances_through<float>) distances_through<float>;
template decltype(distances_through<double>) distances_through<double>;

}  // namespace contactscope
