#include "continuous/impact_of_shapes.h"

#include "continuous/approach.h"
#include "continuous/impact_with_mesh.h"
#include "field/distance_field.h"

namespace contactscope {
namespace {

/// Core of a convex shape, or the vertices of a mesh against a plane. In double for any scalar:
/// next to a floor of a kilometre, float's height of a ball is off by tenths of a millimetre.
template <class S> class DoubleCore {
 public:
  DoubleCore(const Shape<S>& shape, const Sweep<double>& motion) {
    moving_.motion = motion;
    if (const auto* sphere = std::get_if<Sphere<S>>(&shape)) {
      moving_.core = support_set(ends_[0]);
      moving_.radius = static_cast<double>(sphere->radius);
    } else if (const auto* capsule = std::get_if<Capsule<S>>(&shape)) {
      ends_ = {capsule->points[0].template cast<double>(),
               capsule->points[1].template cast<double>()};
      moving_.core = {ends_.data(), 2, nullptr};
      moving_.radius = static_cast<double>(capsule->radius);
    } else if (const auto* hull = std::get_if<Hull<S>>(&shape)) {
      if constexpr (std::is_same_v<S, float>) {
        moving_.core = support_set(hull_.emplace(hull_cast<double>(*hull)));
      } else {
        moving_.core = support_set(*hull);
      }
    } else {
      const auto& vertices = std::get<Mesh<S>>(shape).vertices;
      if constexpr (std::is_same_v<S, float>) {
        for (const Vec3<S>& vertex : vertices) vertices_.push_back(vertex.template cast<double>());
        moving_.core = {vertices_.data(), count_of(vertices_), nullptr};
      } else {
        moving_.core = {vertices.data(), count_of(vertices), nullptr};
      }
    }
  }
  DoubleCore& operator=(DoubleCore&&) = delete;

  const MovingShape<double>& moving() const { return moving_; }

 private:
  std::array<Vec3d, 2> ends_ = {Vec3d::Zero(),
                                Vec3d::Zero()};  // of a segment, or a sphere's centre
  std::optional<Hull<double>> hull_;
  std::vector<Vec3d> vertices_;
  MovingShape<double> moving_;
};

/// Normalises the rotation to double's precision, so that a long lever keeps its length.
template <class S> Sweep<double> in_double(const Sweep<S>& sweep) {
  Sweep<double> wide = sweep.template cast<double>();
  if constexpr (std::is_same_v<S, float>) wide.start.rotation.normalize();
  return wide;
}

template <class S> void swap_sides(ImpactResult<S>& result) {
  result.normal = -result.normal;
  std::swap(result.on_a, result.on_b);
}

template <class S> ImpactResult<S> narrowed(const ImpactResult<double>& wide) {
  return {.status = wide.status,
          .time = rounded_down<S>(wide.time),
          .distance = static_cast<S>(wide.distance),
          .normal = wide.normal.cast<S>(),
          .on_a = wide.on_a.cast<S>(),
          .on_b = wide.on_b.cast<S>(),
          .steps = wide.steps,
          .bounds = wide.bounds};
}

template <class S> ImpactStep<S> narrowed(const ImpactStep<double>& wide) {
  return {.time = static_cast<S>(wide.time),
          .distance = static_cast<S>(wide.distance),
          .axis = wide.axis.cast<S>(),
          .bracket_end = static_cast<S>(wide.bracket_end),
          .bracket_separation = static_cast<S>(wide.bracket_separation),
          .safe = rounded_down<S>(wide.safe)};
}

/// Whether a shape that does not touch a field's source surface is inside it.
template <class S>
bool starts_inside(const Shape<S>& shape, const Sweep<S>& of_field, const Shape<S>& other,
                   const Sweep<S>& of_other) {
  const auto* field = std::get_if<Field<S>>(&shape);
  if (field == nullptr || kind_of(other) == ShapeKind::Plane) return false;
  const DoubleCore<S> core(made_of(other), in_double(of_other));
  const Vec3d point = core.moving().motion.start.transform(core.moving().core.points[0]);
  const PlacedField placed{field->values, field->origin, field->cell};
  return placed.sample(in_double(of_field).start.inverse_transform(point)).distance < 0;
}

template <class S> Sweep<S> without_turn(Sweep<S> sweep) {
  sweep.turn.setZero();
  return sweep;
}

/// Two shapes in processing order: a plane first, or else a mesh.
template <class S> struct Ordered {
  Ordered(const Shape<S>& a, const Sweep<double>& sweep_a, const Shape<S>& b,
          const Sweep<double>& sweep_b)
      : swapped(kind_of(b) == ShapeKind::Plane ||
                (kind_of(b) == ShapeKind::Mesh && kind_of(a) != ShapeKind::Plane)),
        first(swapped ? b : a),
        of_first(swapped ? sweep_b : sweep_a),
        second(swapped ? a : b, swapped ? sweep_a : sweep_b) {}

  std::optional<MovingPlane<double>> plane() const {
    const auto* half_space = std::get_if<HalfSpace<S>>(&first);
    if (half_space == nullptr) return std::nullopt;
    return MovingPlane<double>{half_space->plane.template cast<double>(), of_first};
  }

  bool swapped;
  const Shape<S>& first;
  const Sweep<double>& of_first;
  DoubleCore<S> second;
};

template <class S, class Approach>
std::vector<S> measured(Approach&& approach, double radii, int count) {
  std::vector<S> distances;
  for (int i = 0; i < count; ++i) {
    const double time = static_cast<double>(i) / (count - 1);
    const double distance = std::max(approach.measure(time).distance - radii, 0.0);
    distances.push_back(static_cast<S>(distance));
  }
  return distances;
}

/// For any two shapes except fields and two planes.
template <class S>
ShapeImpact<double> impact_of_solids(const Shape<S>& a, const Sweep<double>& sweep_a,
                                     const Shape<S>& b, const Sweep<double>& sweep_b,
                                     ImpactMethod method, const ImpactLimits<double>& allowed,
                                     ImpactRun<double>* run) {
  const auto *mesh_a = std::get_if<Mesh<S>>(&a), *mesh_b = std::get_if<Mesh<S>>(&b);
  if (mesh_a != nullptr && mesh_b != nullptr)
    return impact_of_rigid_meshes(*mesh_a, sweep_a, *mesh_b, sweep_b, method, allowed, run);
  const Ordered<S> pair(a, sweep_a, b, sweep_b);
  const MovingShape<double>& second = pair.second.moving();
  ShapeImpact<double> found;
  if (const auto plane = pair.plane()) {
    found.result = impact_by(method, *plane, second, allowed, run);
  } else if (const auto* mesh = std::get_if<Mesh<S>>(&pair.first)) {
    found = impact_with_mesh(*mesh, pair.of_first, second, method, allowed, run);
  } else {
    const DoubleCore<S> first(pair.first, pair.of_first);
    found.result = impact_by(method, first.moving(), second, allowed, run);
  }
  if (pair.swapped) {
    swap_sides(found.result);
    if (run != nullptr) {
      swap_sides(run->result);
      for (ImpactStep<double>& step : run->steps) step.axis = -step.axis;
    }
  }
  return found;
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

template <class S>
ShapeImpact<S> impact_of_shapes(const Shape<S>& a, const Sweep<S>& sweep_a, const Shape<S>& b,
                                const Sweep<S>& sweep_b, ImpactMethod method,
                                const ImpactLimits<S>& allowed, ImpactRun<S>* run) {
  if (method == ImpactMethod::Swept && !(sweep_a.turn.isZero(S(0)) && sweep_b.turn.isZero(S(0))))
    return impact_of_shapes(a, without_turn(sweep_a), b, without_turn(sweep_b), method, allowed,
                            run);
  if (kind_of(a) == ShapeKind::Field || kind_of(b) == ShapeKind::Field) {
    ShapeImpact<S> found =
        impact_of_shapes(made_of(a), sweep_a, made_of(b), sweep_b, method, allowed, run);
    const bool inside =
        starts_inside(a, sweep_a, b, sweep_b) || starts_inside(b, sweep_b, a, sweep_a);
    if (inside && found.result.status != ImpactStatus::Overlapping) {
      found = {};
      found.result.status = ImpactStatus::Overlapping;
      if (run != nullptr) *run = {found.result, {}};
    }
    return found;
  }
  ImpactRun<double> wide_run;
  const ShapeImpact<double> wide =
      impact_of_solids(a, in_double(sweep_a), b, in_double(sweep_b), method,
                       {.gap = static_cast<double>(allowed.gap),
                        .of_motion = static_cast<double>(allowed.of_motion),
                        .until = static_cast<double>(allowed.until),
                        .passes_overlaps = allowed.passes_overlaps},
                       run != nullptr ? &wide_run : nullptr);
  if (run != nullptr) [[unlikely]]
    *run = {narrowed<S>(wide_run.result),
            mapped(wide_run.steps, [](const auto& step) { return narrowed<S>(step); })};
  return {narrowed<S>(wide.result), wide.triangle, wide.triangle_of_b, wide.triangles};
}

template <class S>
std::vector<S> distances_through(const Shape<S>& a, const Sweep<S>& sweep_a, const Shape<S>& b,
                                 const Sweep<S>& sweep_b, const ShapeImpact<S>& found, int count) {
  const Shape<S>&surface_a = made_of(a), &surface_b = made_of(b);
  const Sweep<double> of_a = in_double(sweep_a), of_b = in_double(sweep_b);
  const auto triangle_of = [](const Shape<S>& shape, int triangle) {
    return corners_of(std::get<Mesh<S>>(shape), triangle);
  };
  if (found.triangle_of_b >= 0) {
    const auto first = triangle_of(surface_a, found.triangle),
               second = triangle_of(surface_b, found.triangle_of_b);
    return measured<S>(
        Approach<double>(moving_triangle(first, of_a), moving_triangle(second, of_b)), 0, count);
  }
  if (kind_of(surface_a) == ShapeKind::Mesh && kind_of(surface_b) == ShapeKind::Mesh) return {};
  const Ordered<S> pair(surface_a, of_a, surface_b, of_b);
  const MovingShape<double>& second = pair.second.moving();
  if (const auto plane = pair.plane())
    return measured<S>(ApproachToPlane<double>(*plane, second), second.radius, count);
  if (kind_of(pair.first) == ShapeKind::Mesh) {
    if (found.triangle < 0) return {};
    const auto corners = triangle_of(pair.first, found.triangle);
    return measured<S>(Approach<double>(moving_triangle(corners, pair.of_first), second),
                       second.radius, count);
  }
  const DoubleCore<S> first(pair.first, pair.of_first);
  return measured<S>(Approach<double>(first.moving(), second),
                     first.moving().radius + second.radius, count);
}

CONTACTSCOPE_FLOAT_AND_DOUBLE(impact_of_shapes, distances_through);

}  // namespace contactscope
