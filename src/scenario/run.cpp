#include "scenario/run.h"

#include "scenario/active_pair.h"
#include "scenario/between_frames.h"
#include "scenario/run_facts.h"

namespace contactscope {

template <class S> class Runner::In final : public Runner::InScalar {
 public:
  In(const Scenario& scenario, const trace::Stages& stages)
      : scenario_(scenario),
        stages_(with_insets(stages, scenario.views)),
        dynamic_(std::ranges::any_of(scenario.shapes, &ScenarioShape::dynamic)),
        shapes_(std::make_shared<const std::vector<Shape<S>>>(
            mapped(scenario.shapes,
                   [](const ScenarioShape& shape) { return shape_cast<S>(*shape.collider); }))),
        between_(scenario, shapes_),
        chooser_(scenario) {
    for (int i = 0; i < count_of(scenario.shapes); ++i)
      if (scenario.shape(i).deforms()) deforming_.emplace_back(i, scenario.shape(i));
    own_bounds_.resize(shapes_->size());
    // The solver uses the first of two entries for the same shapes.
    std::set<std::pair<int, int>> seen;
    for (const ScenarioPair& pair : scenario.pairs)
      pairs_.push_back(active(pair, pair.pipeline.makes_contacts() &&
                                        seen.emplace(std::minmax(pair.a, pair.b)).second));
    for (std::size_t i = 0; dynamic_ && i < shapes_->size(); ++i)
      bodies_.push_back(body_of(scenario.shapes[i], (*shapes_)[i]));
    between_.begin(bodies_);
    if (dynamic_) sleepers_ = Sleepers<S>(bodies_, scenario.solver);
  }

  std::unique_ptr<InScalar> copy() const override { return std::make_unique<In>(*this); }

  trace::Header header() const override {
    trace::Header header{.scenario = scenario_.name,
                         .title = scenario_.title,
                         .source = scenario_.source,
                         .scalar = scenario_.scalar == Scalar::Double ? "double" : "float",
                         .up = scenario_.up,
                         .frames = scenario_.frames,
                         .shapes = {}};
    for (std::size_t i = 0; i < shapes_->size(); ++i)
      header.shapes.push_back(traced_shape(scenario_.shapes[i], (*shapes_)[i]));
    // In its initial state, even if this has advanced.
    for (const DeformingMesh<S>& now : deforming_)
      report_vertices(DeformingMesh<S>(now.index(), scenario_.shape(now.index())).facts(),
                      at(header.shapes, now.index()));
    return header;
  }

  void advance(int frame) override {
    const bool keeps = dynamic_ || chooser_.chooses() || trees_remember() ||
                       std::ranges::any_of(pairs_, [&](const ActivePair<S>& active) {
                         return remembers(scenario_, active.pair);
                       });
    assert(!keeps || frame >= next_);
    if (!keeps) next_ = frame;
    while (next_ < frame) step(false, nullptr);
  }

  trace::Frame run(int frame, bool recorded) override {
    advance(frame);
    trace::Frame result;
    result.frame = frame;
    result.time = frame * scenario_.dt;
    step(recorded, &result);
    if (recorded && (result.solver || shown(scenario_.views, Panel::Plots)))
      result.totals = trace::totals_of(result);
    return result;
  }

 private:
  /// Runs the next frame and records it in `result`; null: computes only what later frames need.
  void step(bool recorded, trace::Frame* result) {
    const double time = next_ * scenario_.dt;
    for (DeformingMesh<S>& mesh : deforming_) {
      if (mesh.move_to(time))
        for (ActivePair<S>& pair : pairs_)
          if (pair.pair.a == mesh.index() || pair.pair.b == mesh.index()) pair.query_cost.restart();
      at(own_bounds_, mesh.index()) = {};
      if (result) result->deformed.push_back(mesh.facts());
    }
    std::vector<Pose<S>> poses;
    for (std::size_t i = 0; i < scenario_.shapes.size(); ++i) {
      const ScenarioShape& shape = scenario_.shapes[i];
      poses.push_back(dynamic_ ? bodies_[i].pose()
                               : collider_pose_at(shape, time).template cast<S>());
      if (result)
        result->poses.emplace_back(
            shape.name, recorded_pose(shape, time, poses.back().template cast<double>()));
    }
    if (recorded && stages_.fields) record_field_slices(poses, *result);
    if (dynamic_ && recorded) result->solver = solver_facts(scenario_, bodies_);
    if (sleepers_.may_sleep()) note_unmoved(poses);

    if (chooser_.chooses()) choose_pairs(poses, recorded ? result : nullptr);
    std::vector<Manifolds<S>> contacts(pairs_.size());
    if (result) result->pairs.reserve(pairs_.size());
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const ScenarioPair& pair = pairs_[i].pair;
      const bool rests = is_at_rest(pairs_[i]);
      if (!result) {
        if (rests) continue;
        const bool counts = remembers(scenario_, pair);
        if (!pair.pipeline.makes_contacts()) {
          if (counts) answer_pair(pairs_[i], poses, nullptr);
        } else if (dynamic_ || counts) {
          contacts[i] = collide_pair(pairs_[i], poses, nullptr);
        }
        continue;
      }
      trace::Pair& record = result->pairs.emplace_back();
      record.a = scenario_.shape(pair.a).name;
      record.b = scenario_.shape(pair.b).name;
      record.label = pair.label;
      if (!pair.pipeline.makes_contacts()) {
        run_query(pairs_[i], poses, recorded, record);
        if (recorded) between_.record(pair, next_, bodies_, record);
        move_boxes(pair, record);
        continue;
      }
      // Recording must not change the simulation, so collide a copy.
      std::optional<ActivePair<S>> spare;
      if (rests) spare = pairs_[i];
      contacts[i] = collide_pair(spare ? *spare : pairs_[i], poses, recorded ? &record : nullptr);
      if (recorded) {
        move_boxes(pair, record);
        between_.record(pair, next_, bodies_, record);
        record_stability<S>(scenario_, stages_, pair, *result, shape(pair.a), shape(pair.b),
                            record);
      } else {
        record.kind = pair_kind(shape(pair.a), shape(pair.b));
        record_manifolds<S>(contacts[i], record);
      }
    }
    for (const ScenarioPatch& patch : scenario_.patches)
      if (result)
        result->pairs.push_back(
            patch_facts<S>(patch, scenario_.pipeline, recorded ? stages_ : trace::Stages::none()));
    if (dynamic_) solve(poses, contacts, recorded ? result : nullptr);
    ++next_;
  }

  /// Finds the shapes that did not move since the previous frame.
  void note_unmoved(const std::vector<Pose<S>>& poses) {
    unmoved_.assign(poses.size(), false);
    for (int i = 0; i < count_of(poses_before_); ++i)
      at(unmoved_, i) = at(poses, i).position == at(poses_before_, i).position &&
                        at(poses, i).rotation.coeffs() == at(poses_before_, i).rotation.coeffs() &&
                        !scenario_.shape(i).deforms();
    poses_before_ = poses;
  }

  /// Whether the solver does not need a pair's unchanged contacts: its bodies are asleep or static.
  bool is_at_rest(const ActivePair<S>& active) const {
    const auto rests = [&](int i) {
      return at(unmoved_, i) && (sleepers_.asleep(i) || !scenario_.shape(i).dynamic());
    };
    return sleepers_.may_sleep() && active.acts && rests(active.pair.a) && rests(active.pair.b);
  }

  void record_field_slices(const std::vector<Pose<S>>& poses, trace::Frame& frame) const {
    const Vec3d toward = facing_slices(scenario_);
    for (int i = 0; i < count_of(poses); ++i)
      if (const auto* field = std::get_if<Field<S>>(&shape(i)))
        frame.field_slices.push_back(slice_through(scenario_.shape(i).name, PlacedField::of(*field),
                                                   at(poses, i).template cast<double>(), toward));
  }

  /// From a mesh's collision frame to the file's, if they differ.
  void move_boxes(const ScenarioPair& pair, trace::Pair& record) const {
    for (const int index : {pair.a, pair.b}) {
      const ScenarioShape& shape = scenario_.shape(index);
      if (!record.tree || record.tree->shape != shape.name || !shape.is_moved()) continue;
      const auto move = [&](trace::Box& box) {
        for (Vec3d* corner : {&box.lower, &box.upper}) *corner += shape.collider_origin;
      };
      move(record.tree->box);
      for (trace::TreeVisit& visit : record.tree->visits) move(visit.box);
    }
  }

  /// Queries a pair that makes no contacts. The answer depends only on the poses; the cost of
  /// traversing trees also depends on earlier frames.
  void run_query(ActivePair<S>& memory, const std::vector<Pose<S>>& poses, bool recorded,
                 trace::Pair& record) {
    const Answer<S> answer = answer_pair(memory, poses, recorded ? &record : nullptr);
    if (recorded) return;
    record.kind = pair_kind(shape(memory.pair.a), shape(memory.pair.b));
    record_answer(answer, record);
  }

  Answer<S> answer_pair(ActivePair<S>& memory, const std::vector<Pose<S>>& poses,
                        trace::Pair* record) {
    const ScenarioPair& pair = memory.pair;
    const auto placed = [&](int i) -> QueriedShape<S> {
      return {shape(i), at(poses, i), at(own_bounds_, i)};
    };
    QueryMemory* const last =
        pair.pipeline.traversal == Traversal::Coherent ? &memory.query : nullptr;
    const Answer<S> answer = query_pair(placed(pair.a), placed(pair.b), pair.pipeline.question,
                                        pair.b < pair.a, record, stages_, last);
    if (answer.trees) {
      const MeshQueryCost::Verdict verdict = memory.query_cost.judge(*answer.trees);
      for (DeformingMesh<S>& mesh : deforming_)
        if (mesh.index() == pair.a || mesh.index() == pair.b) mesh.was_queried(verdict);
    }
    return answer;
  }

  /// Whether some mesh's tree is rebuilt when it has become expensive.
  bool trees_remember() const { return std::ranges::any_of(scenario_.shapes, chooses_tree); }

  /// In its form of the current frame.
  const Shape<S>& shape(int index) const {
    const auto deforming = std::ranges::find(deforming_, index, &DeformingMesh<S>::index);
    return deforming == deforming_.end() ? at(*shapes_, index) : deforming->shape();
  }

  ActivePair<S> active(const ScenarioPair& pair, bool first) const {
    ActivePair<S> made;
    made.pair = pair;
    made.acts = first && (scenario_.shape(pair.a).dynamic() || scenario_.shape(pair.b).dynamic());
    return made;
  }

  /// Selects the pairs of this frame. Pairs of the previous frame keep their state.
  void choose_pairs(const std::vector<Pose<S>>& poses, trace::Frame* record) {
    const double margin = 0.5 * chooser_.reach();
    boxes_.resize(poses.size());
    for (int i = 0; i < count_of(poses); ++i) {
      const bool looks_ahead =
          scenario_.pipeline.continuous || (dynamic_ && scenario_.solver.substeps > 1);
      if (looks_ahead && !scenario_.shape(i).deforms() && !sleepers_.asleep(i))
        at(boxes_, i) = between_.swept_box(i, next_, bodies_, margin);
      else if (!sleepers_.may_sleep() || !at(unmoved_, i))
        at(boxes_, i) = world_box(shape(i), at(poses, i), margin);
    }
    const std::vector<BoxPair> boxed = chooser_.choose(boxes_, record, stages_.cells);
    if (std::ranges::equal(boxed, pairs_, {}, {}, &ActivePair<S>::shapes)) return;
    std::vector<ActivePair<S>> chosen;
    auto before = pairs_.begin();
    for (const BoxPair& pair : boxed) {
      while (before != pairs_.end() && before->shapes() < pair) ++before;
      if (before != pairs_.end() && before->shapes() == pair)
        chosen.push_back(std::move(*before));
      else
        chosen.push_back(
            active({pair.a, pair.b, "", scenario_.pipeline}, scenario_.pipeline.makes_contacts()));
    }
    pairs_ = std::move(chosen);
  }

  /// Records into `record` unless null. Shapes of one type are collided in file order, whichever of
  /// them the pair names first, so swapping a and b mirrors every result.
  Manifolds<S> collide_pair(ActivePair<S>& memory, const std::vector<Pose<S>>& poses,
                            trace::Pair* record) {
    const ScenarioPair& pair = memory.pair;
    const Shape<S>&a = shape(pair.a), &b = shape(pair.b);
    const Pose<S>&pose_a = at(poses, pair.a), &pose_b = at(poses, pair.b);
    CollideOptions options = options_of(pair.pipeline);
    options.b_first = pair.b < pair.a;
    if (scenario_.up == "z") options.up = Vec3d::UnitZ();
    // If frames can be run independently, none depends on the previous one.
    if (dynamic_ || remembers(scenario_, pair)) options.reduction.previous = memory.kept;
    const ScenarioShape &shape_a = scenario_.shape(pair.a), &shape_b = scenario_.shape(pair.b);
    if (shape_a.dynamic() || shape_b.dynamic()) {
      const auto reach = [&] {
        return shape_a.deforms() || shape_b.deforms() ? 0 : between_.approach(pair, next_, bodies_);
      };
      options.margin = std::max(options.margin, contact_margin(scenario_.solver, reach));
    }
    options.margin = std::max(options.margin, between_.margin(pair, next_, bodies_));
    options.margin = static_cast<S>(options.margin);  // rounded to the pipeline's scalar

    Manifolds<S> manifolds;
    if (pair.pipeline.manifold == ManifoldKind::Incremental) {
      if (memory.persistent.empty()) memory.persistent.emplace_back();
      collide_incremental(a, pose_a, b, pose_b, options,
                          {pair.pipeline.incremental, pair.pipeline.penetration},
                          memory.persistent.front(), manifolds, record, stages_);
    } else {
      PairCache<S>* const cache = pair.pipeline.cache ? &memory.cache : nullptr;
      collide(a, pose_a, b, pose_b, options, manifolds, cache, record, stages_);
      if (record != nullptr && stages_.flip && !manifolds.empty())
        record->flip = flip_distance(a, pose_a, b, pose_b, options,
                                     {.directions = stages_.flip_directions,
                                      .seed = static_cast<std::uint64_t>(stages_.flip_seed)});
    }
    memory.kept.clear();
    for (const Manifold<S>& manifold : manifolds)
      for (const ContactPoint<S>& point : manifold.points) memory.kept.push_back(point.id);
    memory.touches = !memory.kept.empty();
    return manifolds;
  }

  /// The solver's step; records the impulses in `result` unless null.
  void solve(const std::vector<Pose<S>>& poses, std::vector<Manifolds<S>>& contacts,
             trace::Frame* result) {
    const double now = next_ * scenario_.dt, next = (next_ + 1) * scenario_.dt;
    const std::vector<Body<S>> before = bodies_;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const ScenarioShape& shape = scenario_.shapes[i];
      if (!shape.dynamic())
        set_scripted_velocity(bodies_[i], collider_pose_at(shape, now),
                              collider_pose_at(shape, next), scenario_.dt);
    }
    const std::vector<Touch> touches = wake(poses, contacts);
    std::vector<PairContacts<S>> pairs;
    std::vector<PairImpulses<S>> impulses;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const ScenarioPair& pair = pairs_[i].pair;
      const auto [friction, restitution] = surfaces_of<S>(scenario_, pair.a, pair.b);
      impulses.push_back(std::move(pairs_[i].impulses));
      pairs.push_back(
          {pair.a, pair.b, pairs_[i].acts ? &contacts[i] : nullptr, friction, restitution,
           round_radius(shape(pair.a)), round_radius(shape(pair.b)),
           head_on_margin<S>(
               scenario_.solver, between_.is_speculative(pair),
               std::max(pair.pipeline.margin, scenario_.solver.speculative_margin.value_or(0)))});
    }
    solve_awake<S>(bodies_, pairs, impulses, scenario_.world.gravity.cast<S>(), scenario_.solver,
                   static_cast<S>(scenario_.dt), sleepers_);
    const auto settings_of = [&](int a, int b) -> const PipelineSettings* {
      if (chooser_.chooses()) return &scenario_.pipeline;
      const auto found = std::ranges::find_if(pairs_, [&](const ActivePair<S>& active) {
        return active.acts && std::minmax(active.pair.a, active.pair.b) == std::minmax(a, b);
      });
      return found == pairs_.end() ? nullptr : &found->pair.pipeline;
    };
    const std::vector<ImpactStop<S>> stops = between_.stop(bodies_, before, settings_of);
    // Scripted bodies take their exact pose; integration would accumulate rounding.
    for (std::size_t i = 0; i < bodies_.size(); ++i)
      if (!scenario_.shapes[i].dynamic())
        bodies_[i].place(collider_pose_at(scenario_.shapes[i], next).template cast<S>());
    for (const ImpactStop<S>& stop : stops)
      if (result && result->solver) result->solver->stops.push_back(stop_facts(scenario_, stop));
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      pairs_[i].impulses = std::move(impulses[i]);
      if (!result || sleeps(pairs_[i].pair)) continue;
      record_impulses(contacts[i], pairs_[i].impulses, result->pairs[i]);
      record_relative_velocities(pairs_[i].pair, before, bodies_, result->pairs[i]);
    }
    for (const ImpactStop<S>& stop : stops) {
      sleepers_.wake(stop.a);
      sleepers_.wake(stop.b);
    }
    if (result && result->solver) report_sleepers(*result->solver);
    sleepers_.settle(bodies_, touches, scenario_.dt);
  }

  /// Wakes bodies that are touched, and collides pairs that were skipped while they slept. Returns
  /// the touching pairs; empty if sleeping is off.
  std::vector<Touch> wake(const std::vector<Pose<S>>& poses, std::vector<Manifolds<S>>& contacts) {
    if (!sleepers_.may_sleep()) return {};
    std::vector<Touch> touches;
    std::vector<std::size_t> rested;
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      const ActivePair<S>& active = pairs_[i];
      if (active.acts && active.touches) touches.push_back({active.pair.a, active.pair.b});
      if (is_at_rest(active)) rested.push_back(i);
    }
    if (!sleepers_.wake(bodies_, touches)) return touches;
    for (const std::size_t i : rested)
      if (!is_at_rest(pairs_[i])) contacts[i] = collide_pair(pairs_[i], poses, nullptr);
    return touches;
  }

  /// Whether the step skips the pair because one of its bodies sleeps.
  bool sleeps(const ScenarioPair& pair) const {
    return sleepers_.asleep(pair.a) || sleepers_.asleep(pair.b);
  }

  void report_sleepers(trace::Solver& facts) const {
    if (!sleepers_.may_sleep()) return;
    auto reported = facts.bodies.begin();  // dynamic shapes only, in order
    for (int i = 0; i < count_of(bodies_); ++i)
      if (at(bodies_, i).dynamic()) (reported++)->asleep = sleepers_.asleep(i);
  }

  const Scenario& scenario_;
  trace::Stages stages_;
  bool dynamic_;                                         // the solver moves some shape
  std::shared_ptr<const std::vector<Shape<S>>> shapes_;  // immutable, shared by copies
  BetweenFrames<S> between_;
  // State before the next frame:
  int next_ = 0;
  std::vector<DeformingMesh<S>> deforming_;
  std::vector<Body<S>> bodies_;  // one per shape, only in dynamic scenarios
  Sleepers<S> sleepers_;
  std::vector<Pose<S>> poses_before_;  // of the previous frame; only with sleeping, as the next
  std::vector<bool> unmoved_;          // shapes that have kept their pose since
  std::vector<ActivePair<S>> pairs_;
  PairChooser chooser_;
  std::vector<Aabb<float>> boxes_;        // used to select the pairs
  std::vector<OwnBounds<S>> own_bounds_;  // one per shape, for queries of bounds
};

Runner::Runner(const Scenario& scenario, const trace::Stages& stages) {
  if (scenario.scalar == Scalar::Double)
    in_scalar_ = std::make_unique<In<double>>(scenario, stages);
  else
    in_scalar_ = std::make_unique<In<float>>(scenario, stages);
}

}  // namespace contactscope
