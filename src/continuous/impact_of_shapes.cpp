#include "continuous/impact_of_shapes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "continuous/approach_to_plane.h"
#include "continuous/impact_with_mesh.h"
#include "field/distance_field.h"

namespace contactscope {
namespace {

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
  if (a == ShapeKind::Plane && b == ShapeKind::Plane)
    return "when two planes meet is not known; one of the shapes must have an end";
  return std::nullopt;
}

namespace {

/// What is asked of a field: what it was made of.
template <class S>
const Shape<S>& surface_of(const Shape<S>& shape) {
  const auto* field = std::get_if<Field<S>>(&shape);
  return field == nullptr ? shape : field->source->shape;
}

/// Whether a shape, which touches nothing of what a field was made of, is inside of it.
template <class S>
bool starts_inside(const Shape<S>& shape, const Sweep<S>& of_field, const Shape<S>& other,
                   const Sweep<S>& of_other) {
  const auto* field = std::get_if<Field<S>>(&shape);
  if (field == nullptr || kind_of(other) == ShapeKind::Plane) return false;
  const Vec3<S> centre = Vec3<S>::Zero();
  const MovingShape<S> moved = moving(surface_of(other), of_other, centre);
  const Vec3<S> point = moved.motion.start.transform(moved.core.points[0]);
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
  const auto *mesh_a = std::get_if<Mesh<S>>(&a), *mesh_b = std::get_if<Mesh<S>>(&b);
  if (mesh_a != nullptr && mesh_b != nullptr)
    return impact_of_rigid_meshes(*mesh_a, sweep_a, *mesh_b, sweep_b, method, allowed, run);
  const Ordered<S> pair(a, sweep_a, b, sweep_b);
  ShapeImpact<S> found;
  if (const auto* plane = std::get_if<HalfSpace<S>>(&pair.first)) {
    found.result =
        impact_by(method, MovingPlane<S>{plane->plane, pair.of_first}, pair.second, allowed, run);
  } else if (const auto* mesh = std::get_if<Mesh<S>>(&pair.first)) {
    found = impact_with_mesh(*mesh, pair.of_first, pair.second, method, allowed, run);
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
                                 const Sweep<S>& sweep_b, const ShapeImpact<S>& found, int count) {
  const auto triangle_of = [](const Shape<S>& shape, int triangle) {
    return corners_of(std::get<Mesh<S>>(shape), triangle);
  };
  if (found.triangle_of_b >= 0) {
    const auto first = triangle_of(surface_of(a), found.triangle),
               second = triangle_of(surface_of(b), found.triangle_of_b);
    return measured<S>(
        Approach<S>(moving_triangle(first, sweep_a), moving_triangle(second, sweep_b)), S(0),
        count);
  }
  if (kind_of(surface_of(a)) == ShapeKind::Mesh && kind_of(surface_of(b)) == ShapeKind::Mesh)
    return {};
  const Ordered<S> pair(surface_of(a), sweep_a, surface_of(b), sweep_b);
  if (const auto* plane = std::get_if<HalfSpace<S>>(&pair.first))
    return measured<S>(ApproachToPlane<S>({plane->plane, pair.of_first}, pair.second),
                       pair.second.radius, count);
  std::array<Vec3<S>, 3> corners;
  MovingShape<S> first;
  if (kind_of(pair.first) == ShapeKind::Mesh) {
    if (found.triangle < 0) return {};
    corners = triangle_of(pair.first, found.triangle);
    first = moving_triangle(corners, pair.of_first);
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
