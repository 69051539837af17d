#include "scenario/run.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "broadphase/world_box.h"
#include "core/at.h"
#include "dynamics/rest.h"
#include "manifold/dispatch.h"
#include "manifold/flip_distance.h"
#include "manifold/incremental.h"
#include "scenario/between_frames.h"
#include "scenario/deforming_mesh.h"
#include "scenario/field_slice.h"
#include "scenario/pair_chooser.h"
#include "scenario/patch_facts.h"
#include "scenario/run_facts.h"
#include "scenario/shown_stages.h"

namespace contactscope {
namespace {

CollideOptions options_of(const PipelineSettings& settings) {
  CollideOptions options;
  options.margin = settings.margin;
  options.preference = settings.preference;
  options.degenerate = settings.degenerate;
  options.field = settings.field;
  options.internal_edges = settings.internal_edges;
  options.penetration = settings.penetration;
  options.reducer = find_reducer(settings.reducer);
  options.reduction.max_points = settings.max_points;
  return options;
}

/// Whether its tree is built anew when it has become expensive.
bool chooses_tree(const ScenarioShape& shape) {
  return shape.deforms() && shape.tree == TreeUpdate::Auto;
}

/// Whether a pair goes by what it kept in the frame before, or tells a mesh what its tree cost.
bool remembers(const Scenario& scenario, const ScenarioPair& pair) {
  const PipelineSettings& settings = pair.pipeline;
  if (!settings.makes_contacts())
    return walks_trees(scenario, pair) &&
           (settings.traversal == Traversal::Coherent || chooses_tree(scenario.shape(pair.a)) ||
            chooses_tree(scenario.shape(pair.b)));
  const auto kind = [&](int i) { return kind_of(*scenario.shape(i).geometry); };
  const ReducerInfo* const reducer = find_reducer(settings.reducer);
  return settings.manifold == ManifoldKind::Incremental ||
         (settings.cache && can_cache(kind(pair.a), kind(pair.b))) ||
         (reducer != nullptr && reducer->remembers);
}

/// The body of a shape at the start.
template <class S>
Body<S> body_of(const ScenarioShape& shape, const Shape<S>& rounded) {
  const Pose<S> pose = collider_pose_at(shape, 0).template cast<S>();
  if (!shape.dynamic()) return static_body<S>(pose);
  Body<S> body = dynamic_body<S>(pose, with_mass(*mass_properties(rounded), shape.body->mass));
  body.velocity = shape.body->velocity.template cast<S>();
  body.angular_velocity = shape.body->angular_velocity.template cast<S>();
  return body;
}

/// From the frame in which the mesh is collided to that of its file.
void move_boxes(trace::Tree& tree, const Vec3d& by) {
  for (Vec3d* corner : {&tree.box.lower, &tree.box.upper}) *corner += by;
  for (trace::TreeVisit& visit : tree.visits)
    for (Vec3d* corner : {&visit.box.lower, &visit.box.upper}) *corner += by;
}

/// A pair that is run, and what it keeps from one frame for the next.
template <class S>
struct ActivePair {
  ScenarioPair pair;
  bool acts = false;            // the solver gets its contacts
  std::vector<FeatureId> kept;  // by the reducer, or all
  PairCache<S> cache;
  PersistentManifold<S> persistent;
  PairImpulses<S> impulses;  // of dynamic scenarios
  MeshFront front;           // of two meshes that are asked, as the next
  MeshQueryCost query_cost;

  BoxPair shapes() const { return {pair.a, pair.b}; }
};

}  // namespace

template <class S>
class Runner::In final : public Runner::InScalar {
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
    // Of two entries that name the same shapes the solver goes by the first.
    std::set<std::pair<int, int>> seen;
    for (const ScenarioPair& pair : scenario.pairs)
      pairs_.push_back(active(pair, pair.pipeline.makes_contacts() &&
                                        seen.emplace(std::minmax(pair.a, pair.b)).second));
    for (std::size_t i = 0; dynamic_ && i < shapes_->size(); ++i)
      bodies_.push_back(body_of(scenario.shapes[i], (*shapes_)[i]));
    between_.begin(bodies_);
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
    // As at the start, though this may have gone on.
    for (const DeformingMesh<S>& now : deforming_)
      tell_vertices(DeformingMesh<S>(now.index(), scenario_.shape(now.index())).facts(),
                    at(header.shapes, now.index()));
    return header;
  }

  trace::Frame run(int frame, bool recorded) override {
    const bool keeps = dynamic_ || chooser_.chooses() || trees_remember() ||
                       std::ranges::any_of(pairs_, [&](const ActivePair<S>& active) {
                         return remembers(scenario_, active.pair);
                       });
    assert(!keeps || frame >= next_);
    if (!keeps) next_ = frame;
    while (next_ < frame) step(false, nullptr);
    trace::Frame result;
    result.frame = frame;
    result.time = frame * scenario_.dt;
    step(recorded, &result);
    if (recorded && (result.solver || shown(scenario_.views, Panel::Plots)))
      result.totals = trace::totals_of(result);
    return result;
  }

 private:
  /// Runs the next frame, recorded into `result` unless that is null: then only what later frames
  /// depend on.
  void step(bool recorded, trace::Frame* result) {
    const double time = next_ * scenario_.dt;
    for (DeformingMesh<S>& mesh : deforming_) {
      if (mesh.move_to(time)) {
        for (ActivePair<S>& pair : pairs_)
          if (pair.pair.a == mesh.index() || pair.pair.b == mesh.index())
            pair.query_cost.begin_anew();
      }
      at(own_bounds_, mesh.index()) = {};
      if (result) result->deformed.push_back(mesh.facts());
    }
    std::vector<Pose<S>> poses;
    for (std::size_t i = 0; i < scenario_.shapes.size(); ++i) {
      const ScenarioShape& shape = scenario_.shapes[i];
      poses.push_back(dynamic_ ? bodies_[i].pose()
                               : collider_pose_at(shape, time).template cast<S>());
      if (result)
        result->poses.emplace_back(shape.name,
                                   told_pose(shape, time, poses.back().template cast<double>()));
    }
    if (recorded && stages_.fields) record_field_slices(poses, *result);
    if (dynamic_ && recorded) result->solver = solver_facts(scenario_, bodies_);

    if (chooser_.chooses()) choose_pairs(poses, recorded ? result : nullptr);
    std::vector<Manifolds<S>> contacts(pairs_.size());
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const ScenarioPair& pair = pairs_[i].pair;
      if (!result) {
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
        ask_pair(pairs_[i], poses, recorded, record);
        if (recorded) between_.record(pair, next_, bodies_, record);
        move_boxes(pair, record);
        continue;
      }
      contacts[i] = collide_pair(pairs_[i], poses, recorded ? &record : nullptr);
      if (recorded) {
        move_boxes(pair, record);
        between_.record(pair, next_, bodies_, record);
        record_stability(pair, *result, record);
      } else {
        record.kind = pair_kind(shape(pair.a), shape(pair.b));
        record_manifolds<S>(contacts[i], record);
      }
    }
    for (const ScenarioPatch& patch : scenario_.patches) {
      if (result)
        result->pairs.push_back(
            patch_facts<S>(patch, scenario_.pipeline, recorded ? stages_ : trace::Stages::none()));
    }
    if (dynamic_) solve(contacts, recorded ? result : nullptr);
    ++next_;
  }

  void record_field_slices(const std::vector<Pose<S>>& poses, trace::Frame& frame) const {
    const Vec3d toward = facing_slices(scenario_);
    for (int i = 0; i < count_of(poses); ++i) {
      if (const auto* field = std::get_if<Field<S>>(&shape(i)))
        frame.field_slices.push_back(slice_through(scenario_.shape(i).name, PlacedField::of(*field),
                                                   at(poses, i).template cast<double>(), toward));
    }
  }

  /// From the frame in which a mesh is collided to that of its file, where the two differ.
  void move_boxes(const ScenarioPair& pair, trace::Pair& record) const {
    for (const int index : {pair.a, pair.b}) {
      const ScenarioShape& shape = scenario_.shape(index);
      if (record.tree && record.tree->shape == shape.name && shape.is_moved())
        contactscope::move_boxes(*record.tree, shape.collider_origin);
    }
  }

  /// A pair that makes no contacts. The answer depends on nothing but the poses; what it cost, with
  /// trees, also on the frames before.
  void ask_pair(ActivePair<S>& memory, const std::vector<Pose<S>>& poses, bool recorded,
                trace::Pair& record) {
    const Answer<S> answer = answer_pair(memory, poses, recorded ? &record : nullptr);
    if (recorded) return;
    record.kind = pair_kind(shape(memory.pair.a), shape(memory.pair.b));
    record_answer(answer, record);
  }

  Answer<S> answer_pair(ActivePair<S>& memory, const std::vector<Pose<S>>& poses,
                        trace::Pair* record) {
    const ScenarioPair& pair = memory.pair;
    const auto placed = [&](int i) -> AskedShape<S> {
      return {shape(i), at(poses, i), at(own_bounds_, i)};
    };
    MeshFront* const front =
        pair.pipeline.traversal == Traversal::Coherent ? &memory.front : nullptr;
    const Answer<S> answer = ask(placed(pair.a), placed(pair.b), pair.pipeline.question,
                                 pair.b < pair.a, record, stages_, front);
    if (answer.trees) {
      const MeshQueryCost::Verdict verdict = memory.query_cost.judge(*answer.trees);
      for (DeformingMesh<S>& mesh : deforming_)
        if (mesh.index() == pair.a || mesh.index() == pair.b) mesh.was_queried(verdict);
    }
    return answer;
  }

  /// Whether some mesh's tree is built anew when it has become expensive.
  bool trees_remember() const { return std::ranges::any_of(scenario_.shapes, chooses_tree); }

  /// As it is in the frame that is run.
  const Shape<S>& shape(int index) const {
    const auto deforming = std::ranges::find(deforming_, index, &DeformingMesh<S>::index);
    return deforming == deforming_.end() ? at(*shapes_, index) : deforming->shape();
  }

  ActivePair<S> active(const ScenarioPair& pair, bool first) const {
    return {
        .pair = pair,
        .acts = first && (scenario_.shape(pair.a).dynamic() || scenario_.shape(pair.b).dynamic()),
        .kept = {},
        .cache = {},
        .persistent = {},
        .impulses = {},
        .front = {},
        .query_cost = {}};
  }

  /// The pairs of this frame. Those that were there in the frame before keep what they have.
  void choose_pairs(const std::vector<Pose<S>>& poses, trace::Frame* record) {
    std::vector<Aabb<float>> boxes;
    const double margin = 0.5 * chooser_.reach();
    for (int i = 0; i < count_of(poses); ++i)
      boxes.push_back(scenario_.pipeline.continuous && !scenario_.shape(i).deforms()
                          ? between_.swept_box(i, next_, bodies_, margin)
                          : world_box(shape(i), at(poses, i), margin));
    std::vector<ActivePair<S>> chosen;
    auto before = pairs_.begin();
    for (const BoxPair& pair : chooser_.choose(boxes, record, stages_.cells)) {
      while (before != pairs_.end() && before->shapes() < pair) ++before;
      if (before != pairs_.end() && before->shapes() == pair)
        chosen.push_back(std::move(*before));
      else
        chosen.push_back(
            active({pair.a, pair.b, "", scenario_.pipeline}, scenario_.pipeline.makes_contacts()));
    }
    pairs_ = std::move(chosen);
  }

  /// Writes into `record` unless that is null. Shapes of one type are worked on in the order of the
  /// file, whichever of them a pair names first: then trading a and b mirrors every result.
  Manifolds<S> collide_pair(ActivePair<S>& memory, const std::vector<Pose<S>>& poses,
                            trace::Pair* record) {
    const ScenarioPair& pair = memory.pair;
    const Shape<S>&a = shape(pair.a), &b = shape(pair.b);
    const Pose<S>&pose_a = at(poses, pair.a), &pose_b = at(poses, pair.b);
    CollideOptions options = options_of(pair.pipeline);
    options.b_first = pair.b < pair.a;
    options.reduction.previous = memory.kept;
    if (scenario_.shape(pair.a).dynamic() || scenario_.shape(pair.b).dynamic())
      options.margin = std::max(options.margin, scenario_.solver.speculative_margin.value_or(0));
    options.margin = std::max(options.margin, between_.margin(pair, next_, bodies_));
    options.margin = static_cast<S>(options.margin);  // a length as the pipeline has it

    Manifolds<S> manifolds;
    if (pair.pipeline.manifold == ManifoldKind::Incremental) {
      collide_incremental(a, pose_a, b, pose_b, options,
                          {pair.pipeline.incremental, pair.pipeline.penetration}, memory.persistent,
                          manifolds, record, stages_);
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
    return manifolds;
  }

  /// Whether a body can rest on the pair's manifolds, where the pair is incremental or a view shows
  /// it: the one that the solver moves, else the higher one along `up`.
  void record_stability(const ScenarioPair& pair, const trace::Frame& frame,
                        trace::Pair& record) const {
    const std::vector<View>& views = scenario_.views;
    if (!stages_.stability) return;
    if (pair.pipeline.manifold != ManifoldKind::Incremental && !shown(views, Layer::CenterOfMass) &&
        !shown(views, Layer::Support) && !shown(views, Panel::Stability))
      return;
    const Vec3d up = scenario_.up == "z" ? Vec3d::UnitZ() : Vec3d::UnitY();
    const auto center = [&](int i) {
      return at(frame.poses, i)
          .second.transform(traced_shape(scenario_.shape(i), shape(i)).center_of_mass);
    };
    const auto rests = [&](int index) {  // false of what cannot fall
      const ShapeKind kind = kind_of(*scenario_.shape(index).geometry);
      return kind != ShapeKind::Plane && kind != ShapeKind::Mesh;
    };
    const auto rank = [&](int index) {
      return std::pair(rests(index), scenario_.shape(index).dynamic());
    };
    const bool higher_a = center(pair.a).dot(up) > center(pair.b).dot(up);
    const int body =
        rank(pair.a) > rank(pair.b) || (rank(pair.a) == rank(pair.b) && higher_a) ? pair.a : pair.b;
    if (!rests(body)) return;
    record.stability = rest_of(record, scenario_.shape(body).name, center(body),
                               static_cast<double>(std::numeric_limits<S>::epsilon()));
  }

  /// The solver's step; what it gave the contacts stands in `result` where there is one.
  void solve(const std::vector<Manifolds<S>>& contacts, trace::Frame* result) {
    const double now = next_ * scenario_.dt, next = (next_ + 1) * scenario_.dt;
    const std::vector<Body<S>> before = bodies_;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const ScenarioShape& shape = scenario_.shapes[i];
      if (!shape.dynamic())
        set_scripted_velocity(bodies_[i], collider_pose_at(shape, now),
                              collider_pose_at(shape, next), scenario_.dt);
    }
    std::vector<PairContacts<S>> pairs;
    std::vector<PairImpulses<S>> impulses;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const ScenarioPair& pair = pairs_[i].pair;
      const auto [friction, restitution] = surfaces_of<S>(scenario_, pair.a, pair.b);
      impulses.push_back(std::move(pairs_[i].impulses));
      pairs.push_back(
          {pair.a, pair.b, pairs_[i].acts ? &contacts[i] : nullptr, friction, restitution});
    }
    solve_step<S>(bodies_, pairs, impulses, scenario_.world.gravity.cast<S>(), scenario_.solver,
                  static_cast<S>(scenario_.dt));
    const auto settings_of = [&](int a, int b) -> const PipelineSettings* {
      if (chooser_.chooses()) return &scenario_.pipeline;
      const auto found = std::ranges::find_if(pairs_, [&](const ActivePair<S>& active) {
        return active.acts && std::minmax(active.pair.a, active.pair.b) == std::minmax(a, b);
      });
      return found == pairs_.end() ? nullptr : &found->pair.pipeline;
    };
    const std::vector<ImpactStop<S>> stops = between_.stop(bodies_, before, settings_of);
    // A script knows where it is; steps would add up their rounding.
    for (std::size_t i = 0; i < bodies_.size(); ++i)
      if (!scenario_.shapes[i].dynamic())
        bodies_[i].place(collider_pose_at(scenario_.shapes[i], next).template cast<S>());
    for (const ImpactStop<S>& stop : stops)
      if (result && result->solver) result->solver->stops.push_back(stop_facts(scenario_, stop));
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      pairs_[i].impulses = std::move(impulses[i]);
      if (!result) continue;
      record_impulses(contacts[i], pairs_[i].impulses, result->pairs[i]);
      record_relative_velocities(pairs_[i].pair, before, bodies_, result->pairs[i]);
    }
  }

  const Scenario& scenario_;
  trace::Stages stages_;
  bool dynamic_;                                         // some shape is moved by the solver
  std::shared_ptr<const std::vector<Shape<S>>> shapes_;  // never changed, and shared by copies
  BetweenFrames<S> between_;
  // Before the next frame, all that it and the frames after it depend on:
  int next_ = 0;
  std::vector<DeformingMesh<S>> deforming_;
  std::vector<Body<S>> bodies_;  // one a shape; of dynamic scenarios alone
  std::vector<ActivePair<S>> pairs_;
  PairChooser chooser_;
  std::vector<OwnBounds<S>> own_bounds_;  // one a shape, for pairs that ask them
};

Runner::Runner(const Scenario& scenario, const trace::Stages& stages) {
  if (scenario.scalar == Scalar::Double)
    in_scalar_ = std::make_unique<In<double>>(scenario, stages);
  else
    in_scalar_ = std::make_unique<In<float>>(scenario, stages);
}

}  // namespace contactscope
