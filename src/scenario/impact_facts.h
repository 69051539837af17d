#pragma once

#include "continuous/impact_of_shapes.h"
#include "dynamics/continuous_step.h"
#include "scenario/scenario.h"
#include "trace/impact.h"
#include "trace/trace.h"

/// Records of the time of impact of two shapes.
namespace contactscope {

/// Motion of a scripted shape between two poses, in metres and by the shortest rotation. `pivot` is
/// the pivot in the shape's frame.
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

/// Marks the ghosts of a speculative pair: points that the motion closes although the shapes would
/// not meet.
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

}  // namespace contactscope
