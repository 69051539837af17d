#pragma once

#include "dynamics/sleep.h"
#include "field/distance_field.h"
#include "manifold/recorder.h"
#include "scenario/scenario.h"

/// Trace records of shapes, patches and fields, and of the solver in dynamic scenarios.
namespace contactscope {

inline bool shown(const std::vector<View>& views, auto what) {
  return std::ranges::any_of(views, [&](const View& view) { return view.shows(what); });
}

/// Adds stages that are too large to record unless a view shows them.
inline trace::Stages with_insets(trace::Stages stages, const std::vector<View>& views) {
  stages.gauss_map = stages.gauss_map || shown(views, Panel::GaussMap);
  stages.minkowski = stages.minkowski || shown(views, Panel::Minkowski);
  stages.cells = stages.cells || shown(views, Layer::Cells) || shown(views, Panel::Endpoints);
  stages.node_pairs = stages.node_pairs || shown(views, Panel::NodePairs);
  stages.fields = stages.fields || shown(views, Layer::Field);
  stages.decisions =
      stages.decisions || shown(views, Layer::FlipDistance) || shown(views, Panel::Code);
  stages.flip = stages.flip || shown(views, Layer::FlipDistance);
  return stages;
}

// field_slice.cpp

/// The direction, world, any length, that slices through fields face: towards the eye of the first
/// view that shows them and sets its eye, else towards a typical fitted camera.
Vec3d facing_slices(const Scenario& scenario);

/// Distances on a plane through the centre of the surface, the lattice plane whose normal is
/// closest to `toward`; its axes are counter-clockwise from there. About as many values as a square
/// with kSliceValues per side, eight per cell at most: cells that use their triangles resolve
/// features thinner than a cell. `pose` places the field's shape in the world.
trace::FieldSlice slice_through(const std::string& name, const PlacedField& field,
                                const Pose<double>& pose, const Vec3d& toward);

inline constexpr int kSliceValues = 96;

/// A patch as a pair without shapes, labelled with its name: the reduced manifold and, if recorded,
/// all points with the choices, rounded to the reducer's scalar; ids are numbers, from 1.
template <class S>
trace::Pair patch_facts(const ScenarioPatch& patch, const PipelineSettings& settings,
                        const trace::Stages& stages) {
  std::vector<ContactPoint<S>> points;
  for (const ContactPoint<double>& point : patch.points)
    points.push_back({point.position.cast<S>(), static_cast<S>(point.separation), FeatureId()});
  const Vec3<S> normal = patch.normal.cast<S>();
  const ReducerInfo* const reducer = find_reducer(settings.reducer);
  ReduceOptions options;
  options.max_points = settings.max_points;

  trace::Pair pair;
  pair.label = patch.name;
  pair.kind = "patch";
  pair.state = "touching";
  trace::Stages recorded = stages;
  recorded.reduction = stages.reduction && reducer != nullptr;
  const KeptIndices kept =
      Recorder<S>(ToWorld<S>(Pose<S>()), recorded, pair).reduce(reducer, points, normal, options);
  const auto record = [&](int index) -> trace::Point {
    const ContactPoint<S>& point = at(points, index);
    return {point.position.template cast<double>(), static_cast<double>(point.separation),
            std::to_string(index + 1)};
  };
  trace::Manifold& manifold = pair.manifolds.emplace_back();
  manifold.normal = normal.template cast<double>();
  for (const int index : kept) manifold.points.push_back(record(index));
  if (pair.reduction)
    for (int i = 0; i < count_of(points); ++i) at(pair.reduction->points, i) = record(i);
  pair.separation = manifold.points.front().separation;
  for (const trace::Point& point : manifold.points)
    pair.separation = std::min(pair.separation, point.separation);
  return pair;
}

template <class S> void describe(const Sphere<S>& sphere, trace::Shape& traced) {
  traced.vertices = {Vec3d::Zero()};
  traced.radius = sphere.radius;
}

template <class S> void describe(const Capsule<S>& capsule, trace::Shape& traced) {
  traced.vertices = cast_each<Vec3d>(capsule.points);
  traced.edges = {{0, 1}};
  traced.radius = capsule.radius;
  traced.center_of_mass = 0.5 * (traced.vertices[0] + traced.vertices[1]);
}

template <class S> void describe(const Hull<S>& hull, trace::Shape& traced) {
  traced.vertices = cast_each<Vec3d>(hull.vertices);
  for (int face = 0; face < hull.face_count(); ++face)
    traced.faces.push_back(face_vertices(hull, face));
  for (std::size_t edge = 0; edge < hull.half_edges.size(); edge += 2)
    traced.edges.push_back({hull.half_edges[edge].origin, hull.half_edges[edge + 1].origin});
  traced.center_of_mass = hull.centroid.template cast<double>();
}

template <class S> void describe(const HalfSpace<S>& half_space, trace::Shape& traced) {
  const Plane<double> plane = half_space.plane.template cast<double>();
  traced.half_space = trace::HalfSpace{plane.normal, plane.offset};
}

template <class S> void describe(const Mesh<S>& mesh, trace::Shape& traced) {
  traced.vertices = cast_each<Vec3d>(mesh.vertices);
  for (int triangle = 0; triangle < mesh.triangle_count(); ++triangle) {
    const std::array<int, 3>& corners = at(mesh.triangles, triangle);
    traced.faces.emplace_back(corners.begin(), corners.end());
    for (int k = 0; k < 3; ++k) {
      // A shared edge is listed by its first triangle.
      const int neighbour = mesh.neighbour(triangle, k);
      if (neighbour >= 0 && neighbour < triangle) continue;
      traced.edges.push_back({at(corners, k), at(corners, (k + 1) % 3)});
    }
  }
  const Aabb<S> bounds = mesh.tree.bounds();
  traced.center_of_mass = bounds.center().template cast<double>();
}

/// Described as its source shape.
template <class S> void describe(const Field<S>& field, trace::Shape& traced) {
  std::visit([&](const auto& kind) { describe(kind, traced); }, field.source->shape);
}

/// A scenario's shape for a trace, with the vertices of the pipeline.
template <class S> trace::Shape traced_shape(const ScenarioShape& shape, const Shape<S>& rounded) {
  trace::Shape traced;
  traced.name = shape.name;
  traced.type = shape.type;
  const auto describe_kind = [&](const auto& kind) { describe(kind, traced); };
  if (shape.is_moved())
    std::visit(describe_kind, *shape.geometry);
  else
    std::visit(describe_kind, rounded);
  if (kind_of(rounded) == ShapeKind::Sphere)
    traced.vertices = {traced.center_of_mass = shape.collider_origin};
  return traced;
}

/// Applies a frame's deformation to a shape of the header.
inline void report_vertices(const trace::Deformed& deformed, trace::Shape& traced) {
  traced.vertices = deformed.vertices;
  traced.center_of_mass = box_around(deformed.vertices).center();
}

/// Velocity of a point of a body; `arm` is its offset from the centre.
template <class S> Vec3d velocity_at(const Body<S>& body, const Vec3d& arm) {
  const Vec3d turning = body.angular_velocity.template cast<double>();
  return body.velocity.template cast<double>() + turning.cross(arm);
}

/// Records the relative velocities of points with an impulse, before and after the step. Scripted
/// bodies have the same velocity throughout the step.
template <class S>
void record_relative_velocities(const ScenarioPair& pair, const std::vector<Body<S>>& before,
                                const std::vector<Body<S>>& after, trace::Pair& record) {
  const auto a = static_cast<std::size_t>(pair.a), b = static_cast<std::size_t>(pair.b);
  const auto began = [&](std::size_t i) -> const Body<S>& {
    return before[i].dynamic() ? before[i] : after[i];
  };
  for (trace::Manifold& manifold : record.manifolds) {
    for (trace::Point& point : manifold.points) {
      if (!point.impulse) continue;
      const Vec3d arm_a = point.position - before[a].center.template cast<double>();
      const Vec3d arm_b = point.position - before[b].center.template cast<double>();
      point.relative_velocity =
          trace::RelativeVelocity{velocity_at(began(b), arm_b) - velocity_at(began(a), arm_a),
                                  velocity_at(after[b], arm_b) - velocity_at(after[a], arm_a)};
    }
  }
}

/// Impulses are in the order of manifolds and points; points that the solver ignored have none.
template <class S>
void record_impulses(const Manifolds<S>& manifolds, const PairImpulses<S>& impulses,
                     trace::Pair& record) {
  std::size_t next = 0;
  for (std::size_t m = 0; m < manifolds.size(); ++m) {
    for (std::size_t p = 0; p < manifolds[m].points.size() && next < impulses.size(); ++p) {
      const PointImpulse<S>& impulse = impulses[next];
      if (impulse.id != manifolds[m].points[p].id || impulse.triangle != manifolds[m].triangle)
        continue;
      ++next;
      record.manifolds[m].points[p].impulse = trace::Impulse{
          static_cast<double>(impulse.total_normal), impulse.total_friction.template cast<double>(),
          static_cast<double>(impulse.warm_start)};
    }
  }
}

/// Records whether a body can rest on the pair's manifolds, if the pair is incremental or a view
/// shows it. The body is the dynamic one, else the higher one along `up`.
template <class S>
void record_stability(const Scenario& scenario, const trace::Stages& stages,
                      const ScenarioPair& pair, const trace::Frame& frame, const Shape<S>& shape_a,
                      const Shape<S>& shape_b, trace::Pair& record) {
  const std::vector<View>& views = scenario.views;
  if (!stages.stability) return;
  if (pair.pipeline.manifold != ManifoldKind::Incremental && !shown(views, Layer::CenterOfMass) &&
      !shown(views, Layer::Support) && !shown(views, Panel::Stability))
    return;
  const Vec3d up = scenario.up == "z" ? Vec3d::UnitZ() : Vec3d::UnitY();
  const auto center = [&](int i, const Shape<S>& shape) {
    return at(frame.poses, i)
        .second.transform(traced_shape(scenario.shape(i), shape).center_of_mass);
  };
  const auto rests = [&](int index) {  // false for shapes that cannot fall
    const ShapeKind kind = kind_of(*scenario.shape(index).geometry);
    return kind != ShapeKind::Plane && kind != ShapeKind::Mesh;
  };
  const auto rank = [&](int index) {
    return std::pair(rests(index), scenario.shape(index).dynamic());
  };
  const Vec3d center_a = center(pair.a, shape_a), center_b = center(pair.b, shape_b);
  const bool higher_a = center_a.dot(up) > center_b.dot(up);
  const bool of_a = rank(pair.a) > rank(pair.b) || (rank(pair.a) == rank(pair.b) && higher_a);
  const int body = of_a ? pair.a : pair.b;
  if (!rests(body)) return;
  record.stability = rest_of(record, scenario.shape(body).name, of_a ? center_a : center_b,
                             static_cast<double>(std::numeric_limits<S>::epsilon()));
}

template <class S>
trace::Solver solver_facts(const Scenario& scenario, const std::vector<Body<S>>& bodies) {
  trace::Solver facts{
      .position_correction = to_string(scenario.solver.position_correction),
      .iterations = scenario.solver.iterations,
      .substeps = scenario.solver.substeps,
      .warm_start = scenario.solver.warm_start,
      .slop = scenario.solver.slop.value_or(0),
      .speculative_margin = scenario.solver.speculative_margin.value_or(0),
      .sleep_after = scenario.solver.sleep_after,
      .sleep_speed = scenario.solver.sleep_after ? scenario.solver.sleep_speed : std::nullopt,
      .bodies = {}};
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Body<S>& body = bodies[i];
    if (!body.dynamic()) continue;
    facts.bodies.push_back({.name = scenario.shapes[i].name,
                            .mass = static_cast<double>(body.mass),
                            .center_of_mass = body.center.template cast<double>(),
                            .velocity = body.velocity.template cast<double>(),
                            .angular_velocity = body.angular_velocity.template cast<double>(),
                            .kinetic_energy = kinetic_energy(body),
                            .potential_energy = potential_energy(body, scenario.world.gravity)});
  }
  return facts;
}

}  // namespace contactscope
