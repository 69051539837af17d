#include "scenario/run.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <numeric>
#include <set>
#include <utility>

#include "broadphase/world_box.h"
#include "core/at.h"
#include "core/feature_id.h"
#include "dynamics/rest.h"
#include "manifold/dispatch.h"

namespace contactscope {
namespace {

template <class S>
CollideOptions<S> options_of(const PipelineSettings& settings) {
  CollideOptions<S> options;
  options.margin = static_cast<S>(settings.margin);
  options.preference = settings.preference;
  options.degenerate = settings.degenerate;
  options.internal_edges = settings.internal_edges;
  options.penetration = settings.penetration;
  options.reducer = find_reducer<S>(settings.reducer);
  options.reduction.max_points = settings.max_points;
  return options;
}

/// Whether a pair goes by what it kept in the frame before.
bool remembers(const Scenario& scenario, const ScenarioPair& pair) {
  const PipelineSettings& settings = pair.pipeline;
  const auto kind = [&](int i) { return kind_of(*scenario.shape(i).geometry); };
  const auto reducer = std::ranges::find(reducers(), settings.reducer, &ReducerInfo::name);
  return settings.manifold == ManifoldKind::Incremental ||
         (settings.cache && can_cache(kind(pair.a), kind(pair.b))) ||
         (reducer != reducers().end() && reducer->remembers);
}

/// Whether some view shows the layer or panel.
bool shown(const std::vector<View>& views, auto what) {
  return std::ranges::any_of(views, [&](const View& view) { return view.shows(what); });
}

/// Also what is too large to be recorded where no view of the scenario shows it.
trace::Stages with_insets(trace::Stages stages, const std::vector<View>& views) {
  stages.gauss_map = stages.gauss_map || shown(views, Panel::GaussMap);
  stages.minkowski = stages.minkowski || shown(views, Panel::Minkowski);
  return stages;
}

/// The first entry of every two shapes of which one is dynamic.
std::vector<bool> acting_pairs(const Scenario& scenario) {
  std::vector<bool> acting;
  std::set<std::pair<int, int>> seen;
  for (const ScenarioPair& pair : scenario.pairs) {
    const bool first = seen.emplace(std::minmax(pair.a, pair.b)).second;
    acting.push_back(first &&
                     (scenario.shape(pair.a).dynamic() || scenario.shape(pair.b).dynamic()));
  }
  return acting;
}

/// Metres apart up to which two shapes have contacts, or keep old ones.
double farthest_contact(const Scenario& scenario) {
  const PipelineSettings& settings =
      scenario.pairs.front().pipeline;  // a broad phase: of all pairs
  const double margin = std::max(settings.margin, scenario.solver.speculative_margin.value_or(0));
  return settings.manifold == ManifoldKind::Incremental
             ? margin + settings.incremental.breaking_distance
             : margin;
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

const ScenarioShape& mesh_of(const Scenario& scenario, const ScenarioPair& pair) {
  const ScenarioShape& a = scenario.shape(pair.a);
  return kind_of(*a.geometry) == ShapeKind::Mesh ? a : scenario.shape(pair.b);
}

/// From the frame in which the mesh is collided to that of its file.
void move_boxes(trace::Tree& tree, const Vec3d& by) {
  const auto move = [&](trace::Box& box) {
    box.lower += by;
    box.upper += by;
  };
  move(tree.box);
  for (trace::TreeVisit& visit : tree.visits) move(visit.box);
}

}  // namespace

Runner::Runner(const Scenario& scenario, const trace::Stages& stages)
    : scenario_(&scenario),
      stages_(with_insets(stages, scenario.views)),
      shows_stability_(shown(scenario.views, Layer::CenterOfMass) ||
                       shown(scenario.views, Layer::Support) ||
                       shown(scenario.views, Panel::Stability)),
      shows_plots_(shown(scenario.views, Panel::Plots)),
      dynamic_(std::ranges::any_of(scenario.shapes, &ScenarioShape::dynamic)),
      acts_(acting_pairs(scenario)),
      state_(scenario.scalar == Scalar::Double ? decltype(state_)(at_start<double>())
                                               : decltype(state_)(at_start<float>())) {
  for (const ScenarioPair& pair : scenario.pairs) remembers_.push_back(remembers(scenario, pair));
  for (std::size_t i = 0; !scenario.broad_phase.empty() && i < scenario.pairs.size(); ++i)
    places_.emplace(BoxPair{scenario.pairs[i].a, scenario.pairs[i].b}, i);
}

template <class S>
Runner::State<S> Runner::at_start() const {
  const auto rounded = [](const ScenarioShape& shape) { return shape_cast<S>(*shape.collider); };
  State<S> state;
  state.shapes = std::make_shared<const std::vector<Shape<S>>>(mapped(scenario_->shapes, rounded));
  state.memories.resize(scenario_->pairs.size());
  state.chooser.phase = make_broad_phase(scenario_->broad_phase);
  if (!dynamic_) return state;
  for (std::size_t i = 0; i < scenario_->shapes.size(); ++i)
    state.bodies.push_back(body_of(scenario_->shapes[i], (*state.shapes)[i]));
  state.impulses.resize(scenario_->pairs.size());
  return state;
}

trace::Header Runner::header() const {
  trace::Header header;
  header.scenario = scenario_->name;
  header.title = scenario_->title;
  header.source = scenario_->source;
  header.scalar = scenario_->scalar == Scalar::Double ? "double" : "float";
  header.up = scenario_->up;
  header.frames = scenario_->frames;
  std::visit(
      [&](const auto& state) {
        for (std::size_t i = 0; i < state.shapes->size(); ++i)
          header.shapes.push_back(traced_shape(scenario_->shapes[i], (*state.shapes)[i]));
      },
      state_);
  return header;
}

template <class S>
std::vector<std::size_t> Runner::choose_pairs(State<S>& state, const std::vector<Pose<S>>& poses,
                                              trace::Frame* record) const {
  std::vector<std::size_t> chosen;
  if (!state.chooser.phase) {
    chosen.resize(scenario_->pairs.size());
    std::iota(chosen.begin(), chosen.end(), std::size_t{0});
    return chosen;
  }
  BroadPhase& phase = *state.chooser.phase;
  const BroadPhaseCounts before = phase.counts();
  const double reach = scenario_->pairs.empty() ? 0 : 0.5 * farthest_contact(*scenario_);
  for (int i = 0; i < count_of(poses); ++i) {
    Aabb<float> box = world_box(at(*state.shapes, i), at(poses, i), reach);
    // A body that the solver lost has no place: its contacts tell so, wherever the others are.
    if (box.empty()) {
      const Vec3<float> far = Vec3<float>::Constant(std::numeric_limits<float>::infinity());
      box = {-far, far};
    }
    i < phase.handles() ? phase.move(i, box) : void(phase.add(box));
  }
  for (const BoxPair& pair : phase.pairs()) {
    if (const auto place = places_.find(pair); place != places_.end())
      chosen.push_back(place->second);
  }
  for (const std::size_t pair : state.chooser.chosen)
    if (!std::ranges::binary_search(chosen, pair)) state.memories[pair] = {};
  state.chooser.chosen = chosen;
  if (record != nullptr) {
    const auto since = [&](std::int64_t BroadPhaseCounts::*count) {
      return static_cast<int>(phase.counts().*count - before.*count);
    };
    trace::BroadPhase& facts = record->broad_phase.emplace();
    facts.method = scenario_->broad_phase;
    facts.pairs = count_of(chosen);
    facts.comparisons = since(&BroadPhaseCounts::comparisons);
    facts.visits = since(&BroadPhaseCounts::visits);
    facts.swaps = since(&BroadPhaseCounts::swaps);
    for (int i = 0; i < phase.handles(); ++i) {
      const Aabb<double> box = phase.box(i).cast<double>();
      if (is_bounded(phase.box(i)))
        facts.bounds.push_back({scenario_->shape(i).name, {box.lower, box.upper}});
    }
  }
  return chosen;
}

/// Shapes of one type are worked on in the order of the file, whichever of them a pair names first:
/// then trading a and b mirrors every result.
template <class S>
Manifolds<S> Runner::collide_pair(State<S>& state, std::size_t index,
                                  const std::vector<Pose<S>>& poses, trace::Pair* record) const {
  const ScenarioPair& pair = scenario_->pairs[index];
  const auto a = static_cast<std::size_t>(pair.a), b = static_cast<std::size_t>(pair.b);
  const std::vector<Shape<S>>& shapes = *state.shapes;
  Memory<S>& memory = state.memories[index];
  CollideOptions<S> options = options_of<S>(pair.pipeline);
  options.b_first = pair.b < pair.a;
  options.reduction.previous = memory.kept;
  if (scenario_->shapes[a].dynamic() || scenario_->shapes[b].dynamic())
    options.margin =
        std::max(options.margin, static_cast<S>(scenario_->solver.speculative_margin.value_or(0)));

  Manifolds<S> manifolds;
  if (pair.pipeline.manifold == ManifoldKind::Incremental) {
    collide_incremental(shapes[a], poses[a], shapes[b], poses[b], options,
                        {pair.pipeline.incremental, pair.pipeline.penetration}, memory.persistent,
                        manifolds, record, stages_);
  } else {
    PairCache<S>* const cache = pair.pipeline.cache ? &memory.cache : nullptr;
    collide(shapes[a], poses[a], shapes[b], poses[b], options, manifolds, cache, record, stages_);
  }
  memory.kept.clear();
  for (const Manifold<S>& manifold : manifolds)
    for (const ContactPoint<S>& point : manifold.points) memory.kept.push_back(point.id);
  return manifolds;
}

void Runner::record_stability(const ScenarioPair& pair, const trace::Frame& frame,
                              trace::Pair& record) const {
  if (!stages_.stability) return;
  if (!shows_stability_ && pair.pipeline.manifold != ManifoldKind::Incremental) return;
  const Vec3d up = scenario_->up == "z" ? Vec3d::UnitZ() : Vec3d::UnitY();
  const auto center = [&](int index) {
    const auto i = static_cast<std::size_t>(index);
    return std::visit(
        [&](const auto& state) {
          return frame.poses[i].second.transform(
              traced_shape(scenario_->shapes[i], (*state.shapes)[i]).center_of_mass);
        },
        state_);
  };
  const auto rests = [&](int index) {  // false of what cannot fall
    const ShapeKind kind = kind_of(*scenario_->shape(index).geometry);
    return kind != ShapeKind::Plane && kind != ShapeKind::Mesh;
  };
  const auto rank = [&](int index) {
    return std::pair(rests(index), scenario_->shape(index).dynamic());
  };
  const bool higher_a = center(pair.a).dot(up) > center(pair.b).dot(up);
  const int body =
      rank(pair.a) > rank(pair.b) || (rank(pair.a) == rank(pair.b) && higher_a) ? pair.a : pair.b;
  if (!rests(body)) return;
  const double epsilon = scenario_->scalar == Scalar::Double
                             ? std::numeric_limits<double>::epsilon()
                             : static_cast<double>(std::numeric_limits<float>::epsilon());
  record.stability = rest_of(record, scenario_->shape(body).name, center(body), epsilon);
}

template <class S>
void Runner::step(State<S>& state, bool recorded, trace::Frame* result) const {
  const double time = state.frame * scenario_->dt;
  std::vector<Pose<S>> poses;
  for (std::size_t i = 0; i < scenario_->shapes.size(); ++i) {
    const ScenarioShape& shape = scenario_->shapes[i];
    poses.push_back(dynamic_ ? state.bodies[i].pose()
                             : collider_pose_at(shape, time).template cast<S>());
    if (result)
      result->poses.emplace_back(shape.name,
                                 told_pose(shape, time, poses.back().template cast<double>()));
  }
  if (dynamic_ && recorded) result->solver = solver_facts(state);

  const std::vector<std::size_t> chosen = choose_pairs(state, poses, recorded ? result : nullptr);
  std::vector<Manifolds<S>> contacts(scenario_->pairs.size());
  for (const std::size_t i : chosen) {
    if (!result) {
      if (dynamic_ || remembers_[i]) contacts[i] = collide_pair<S>(state, i, poses, nullptr);
      continue;
    }
    const ScenarioPair& pair = scenario_->pairs[i];
    const auto a = static_cast<std::size_t>(pair.a), b = static_cast<std::size_t>(pair.b);
    trace::Pair& record = result->pairs.emplace_back();
    record.a = scenario_->shapes[a].name;
    record.b = scenario_->shapes[b].name;
    record.label = pair.label;
    contacts[i] = collide_pair(state, i, poses, recorded ? &record : nullptr);
    if (recorded) {
      const ScenarioShape& mesh = mesh_of(*scenario_, pair);
      if (record.tree && mesh.is_moved()) move_boxes(*record.tree, mesh.collider_origin);
      record_stability(pair, *result, record);
    } else {
      record.kind = pair_kind((*state.shapes)[a], (*state.shapes)[b]);
      record_manifolds<S>(contacts[i], record);
    }
  }
  if (dynamic_) solve(state, contacts, chosen, recorded ? result : nullptr);
  ++state.frame;
}

template <class S>
trace::Frame Runner::run(State<S>& state, int frame, bool recorded) const {
  const bool keeps = dynamic_ || state.chooser.phase != nullptr ||
                     std::ranges::find(remembers_, true) != remembers_.end();
  assert(!keeps || frame >= state.frame);
  if (!keeps) state.frame = frame;
  while (state.frame < frame) step(state, false, nullptr);
  trace::Frame result;
  result.frame = frame;
  result.time = frame * scenario_->dt;
  step(state, recorded, &result);
  return result;
}

trace::Frame Runner::frame(int frame) {
  trace::Frame result = std::visit([&](auto& state) { return run(state, frame, true); }, state_);
  if (result.solver || shows_plots_) result.totals = trace::totals_of(result);
  return result;
}

trace::Frame Runner::frame_unrecorded(int frame) {
  return std::visit([&](auto& state) { return run(state, frame, false); }, state_);
}

}  // namespace contactscope
