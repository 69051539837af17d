#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "continuous/motion_bounds.h"
#include "core/at.h"
#include "scenario/impact_facts.h"
#include "scenario/scenario.h"

/// Handles shapes that meet between two frames: `continuous` of a scenario.
namespace contactscope {

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

  /// Motion of a shape through the step: a body moves and falls as if nothing stopped it, all
  /// others follow their script.
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
