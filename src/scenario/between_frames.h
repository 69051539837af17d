#pragma once

#include "dynamics/continuous_step.h"
#include "scenario/scenario.h"

/// Handles shapes that meet between two frames: `continuous` of a scenario.
///
/// Records of the time of impact of two shapes.
namespace contactscope {

/// Motion of a scripted shape between two poses, by the shortest rotation. `pivot`: shape's frame.
template <class S>
Sweep<S> sweep_between(const Pose<double>& from, const Pose<double>& to, const Vec3d& pivot) {
  Sweep<double> sweep{from, pivot, to.transform(pivot) - from.transform(pivot), Vec3d::Zero()};
  Quatd by = to.rotation * from.rotation.conjugate();
  if (by.w() < 0) by.coeffs() = -by.coeffs();
  const double sine = by.vec().norm();
  if (sine > 0) sweep.turn = 2 * std::atan2(sine, by.w()) / sine * by.vec();
  return sweep.cast<S>();
}

template <class S> trace::Travel travel_of(const Sweep<S>& sweep) {
  const Sweep<double> exact = sweep.template cast<double>();
  return {exact.start.transform(exact.pivot), exact.displacement, exact.turn};
}

template <class S>
trace::Impact impact_facts(const Shape<S>& a, const Sweep<S>& sweep_a, const Shape<S>& b,
                           const Sweep<S>& sweep_b, ImpactMethod method) {
  ImpactRun<S> run;
  const ShapeImpact<S> found = impact_of_shapes<S>(a, sweep_a, b, sweep_b, method, {}, &run);
  trace::Impact facts{.method = to_string(method),
                      .status = to_string(found.result.status),
                      .time = static_cast<double>(found.result.time),
                      .distance = static_cast<double>(found.result.distance),
                      .triangle = found.triangle_of_b < 0 ? found.triangle : -1,
                      .travel_a = travel_of(sweep_a),
                      .travel_b = travel_of(sweep_b),
                      .distances = {},
                      .steps = {}};
  if (found.result.status == ImpactStatus::Hit) {
    facts.normal = found.result.normal.template cast<double>();
    facts.point_a = found.result.on_a.template cast<double>();
    facts.point_b = found.result.on_b.template cast<double>();
  }
  if (found.triangle_of_b >= 0) {
    facts.triangle_a = found.triangle;
    facts.triangle_b = found.triangle_of_b;
  }
  constexpr int kDistances = 65;
  for (const S distance : distances_through<S>(a, sweep_a, b, sweep_b, found, kDistances))
    facts.distances.push_back({static_cast<double>(facts.distances.size()) / (kDistances - 1),
                               static_cast<double>(distance)});
  for (const ImpactStep<S>& step : run.steps)
    facts.steps.push_back({static_cast<double>(step.time), static_cast<double>(step.distance),
                           step.axis.template cast<double>(), static_cast<double>(step.bracket_end),
                           static_cast<double>(step.bracket_separation),
                           static_cast<double>(step.safe)});
  return facts;
}

/// Marks the ghosts of a speculative pair: points that close although the shapes do not meet.
inline void report_ghosts(trace::Pair& pair) {
  trace::Impact& impact = *pair.impact;
  if (impact.status != "separated") return;
  const auto moved = [](const trace::Travel& travel, const Vec3d& point) -> Vec3d {
    const double angle = travel.turn.norm();
    Vec3d arm = point - travel.pivot;
    if (angle > 0) arm = Eigen::AngleAxisd(angle, travel.turn / angle) * arm;
    return travel.pivot + travel.displacement + arm;
  };
  for (const trace::Manifold& manifold : pair.manifolds) {
    for (const trace::Point& point : manifold.points) {
      const Vec3d gap =
          moved(impact.travel_b, point.position) - moved(impact.travel_a, point.position);
      if (point.separation > 0 && point.separation + gap.dot(manifold.normal) < 0)
        impact.ghosts.push_back(point.position);
    }
  }
}

template <class S> trace::Stop stop_facts(const Scenario& scenario, const ImpactStop<S>& stop) {
  return {.a = scenario.shape(stop.a).name,
          .b = scenario.shape(stop.b).name,
          .time = static_cast<double>(stop.time),
          .normal = stop.normal.template cast<double>(),
          .point = stop.point.template cast<double>(),
          .for_good = stop.for_good};
}

/// When two meshes first meet between `from` and `to`, seconds. Each corner moves in a straight
/// line at constant speed between its scripted positions, whether the mesh deforms, moves or turns.
/// In double, whatever the scenario's scalar. Both shapes must be meshes.
trace::Impact mesh_impact_facts(const ScenarioShape& a, const ScenarioShape& b, double from,
                                double to);

/// Friction and restitution of two touching shapes.
template <class S> std::pair<S, S> surfaces_of(const Scenario& scenario, int a, int b) {
  const auto own = [&](std::optional<double> ScenarioShape::*coefficient, double otherwise) {
    return std::pair((scenario.shape(a).*coefficient).value_or(otherwise),
                     (scenario.shape(b).*coefficient).value_or(otherwise));
  };
  const auto friction = own(&ScenarioShape::friction, scenario.world.friction);
  const auto restitution = own(&ScenarioShape::restitution, scenario.world.restitution);
  return {static_cast<S>(std::sqrt(friction.first * friction.second)),
          static_cast<S>(std::max(restitution.first, restitution.second))};
}

/// `frame` is the one at which the step begins. `bodies` is the state then, one body per shape, if
/// any is dynamic. Deforming shapes are not handled. Keeps a reference to the scenario.
template <class S> class BetweenFrames {
 public:
  using Bodies = std::vector<Body<S>>;

  BetweenFrames(const Scenario& scenario, std::shared_ptr<const std::vector<Shape<S>>> shapes)
      : scenario_(scenario), shapes_(std::move(shapes)) {}

  /// Call before the first frame; prepares stop().
  void begin(const Bodies& bodies) {
    const auto looks = [](const PipelineSettings& settings) {
      return settings.continuous.has_value() && settings.makes_contacts();
    };
    if (bodies.empty()) return;
    if (scenario_.broad_phase.empty()
            ? std::ranges::any_of(scenario_.pairs, looks, &ScenarioPair::pipeline)
            : looks(scenario_.pipeline))
      cores_ = std::make_shared<const std::vector<ImpactCore>>(
          impact_cores(bodies, *shapes_, scenario_.solver));
  }

  /// Contains every position of the shape in the step.
  Aabb<float> swept_box(int index, int frame, const Bodies& bodies, double margin) const {
    return swept_world_box(at(*shapes_, index), sweep(index, frame, bodies), margin);
  }

  /// Metres within which a speculative pair looks for contacts; 0 for other pairs.
  double margin(const ScenarioPair& pair, int frame, const Bodies& bodies) const {
    return is_speculative(pair) ? approach(pair, frame, bodies) : 0;
  }
  bool is_speculative(const ScenarioPair& pair) const {
    return pair.pipeline.continuous == ImpactMethod::Speculative && queries(pair);
  }

  /// Metres that two rigid shapes can approach each other in the step.
  double approach(const ScenarioPair& pair, int frame, const Bodies& bodies) const {
    return static_cast<double>(largest_approach(at(*shapes_, pair.a), sweep(pair.a, frame, bodies),
                                                at(*shapes_, pair.b),
                                                sweep(pair.b, frame, bodies)));
  }

  /// Records when the pair meets, if its settings request that.
  void record(const ScenarioPair& pair, int frame, const Bodies& bodies,
              trace::Pair& record) const {
    if (!queries(pair)) return;
    const ScenarioShape &a = scenario_.shape(pair.a), &b = scenario_.shape(pair.b);
    if (a.deforms() || b.deforms()) {
      record.impact = mesh_impact_facts(a, b, frame * scenario_.dt, (frame + 1) * scenario_.dt);
      return;
    }
    record.impact =
        impact_facts(at(*shapes_, pair.a), sweep(pair.a, frame, bodies), at(*shapes_, pair.b),
                     sweep(pair.b, frame, bodies), *pair.pipeline.continuous);
    if (pair.pipeline.continuous != ImpactMethod::Speculative) return;
    record.impact->margin = margin(pair, frame, bodies);
    report_ghosts(record);
  }

  /// Moves bodies back to their first contact on the path from `before`. `settings_of(a, b)`:
  /// settings of a pair; null if its contacts do not act.
  template <class SettingsOf>
  std::vector<ImpactStop<S>> stop(Bodies& bodies, const Bodies& before,
                                  const SettingsOf& settings_of) const {
    if (!cores_) return {};
    const auto pair_of = [&](int a, int b) -> std::optional<ContinuousPair<S>> {
      const PipelineSettings* settings = settings_of(a, b);
      if (settings == nullptr || !queries(a, b, settings->continuous)) return std::nullopt;
      const auto [friction, restitution] = surfaces_of<S>(scenario_, a, b);
      return ContinuousPair<S>{*settings->continuous, friction, restitution};
    };
    return stop_at_impacts<S>(bodies, before, *shapes_, *cores_, pair_of, scenario_.solver,
                              static_cast<S>(scenario_.dt));
  }

 private:
  bool queries(const ScenarioPair& pair) const {
    return queries(pair.a, pair.b, pair.pipeline.continuous);
  }
  bool queries(int a, int b, const std::optional<ImpactMethod>& method) const {
    return method && !impact_refusal(scenario_.shape(a), scenario_.shape(b), *method);
  }

  /// Motion of a shape through the step: scripted, or of a body as if nothing stopped it.
  Sweep<S> sweep(int index, int frame, const Bodies& bodies) const {
    const ScenarioShape& shape = scenario_.shape(index);
    const S dt = static_cast<S>(scenario_.dt);
    if (!shape.dynamic())
      return sweep_between<S>(collider_pose_at(shape, frame * scenario_.dt),
                              collider_pose_at(shape, (frame + 1) * scenario_.dt),
                              -shape.collider_origin);
    Sweep<S> going = sweep_of(at(bodies, index), dt);
    going.displacement += dt * dt * scenario_.world.gravity.cast<S>();
    return going;
  }

  const Scenario& scenario_;
  std::shared_ptr<const std::vector<Shape<S>>> shapes_;  // immutable, shared by copies
  std::shared_ptr<const std::vector<ImpactCore>>
      cores_{};  // immutable, shared; null without stop()
};

}  // namespace contactscope
