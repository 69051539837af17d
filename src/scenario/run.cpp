#include "scenario/run.h"

#include <algorithm>
#include <limits>
#include <set>
#include <utility>

#include "core/feature_id.h"
#include "manifold/dispatch.h"
#include "manifold/stability.h"

namespace contactscope {
namespace {

template <class S>
std::vector<Shape<S>> rounded_shapes(const Scenario& scenario) {
  std::vector<Shape<S>> shapes;
  shapes.reserve(scenario.shapes.size());
  for (const ScenarioShape& shape : scenario.shapes)
    shapes.push_back(shape_cast<S>(*shape.collider));
  return shapes;
}

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

/// What an engine that records nothing still knows of a pair.
template <class S>
void keep_manifolds(const Manifolds<S>& manifolds, trace::Pair& pair) {
  pair.state = manifolds.empty() ? "separated" : "touching";
  if (manifolds.empty()) return;
  pair.separation = std::numeric_limits<double>::infinity();
  for (const Manifold<S>& manifold : manifolds) {
    trace::Manifold& kept = pair.manifolds.emplace_back();
    kept.normal = manifold.normal.template cast<double>();
    kept.axis = to_string(manifold.axis);
    kept.type = to_string(manifold.type);
    if (manifold.triangle >= 0) kept.triangle = manifold.triangle;
    for (const ContactPoint<S>& point : manifold.points) {
      kept.points.push_back({point.position.template cast<double>(),
                             static_cast<double>(point.separation), to_string(point.id)});
      pair.separation = std::min(pair.separation, kept.points.back().separation);
    }
  }
}

bool remembers(const std::string& reducer) {
  const auto found = std::ranges::find(reducers(), reducer, &ReducerInfo::name);
  return found != reducers().end() && found->remembers;
}

bool shows_stability(const std::vector<View>& views) {
  return std::ranges::any_of(views, [](const View& view) {
    return view.shows(Layer::CenterOfMass) || view.shows(Layer::Support) ||
           view.shows(Panel::Stability);
  });
}

bool shows_plots(const std::vector<View>& views) {
  return std::ranges::any_of(views, [](const View& view) { return view.shows(Panel::Plots); });
}

/// Also what is too large to be recorded where no view of the scenario shows it.
trace::Stages with_insets(trace::Stages stages, const std::vector<View>& views) {
  for (const View& view : views) {
    stages.gauss_map = stages.gauss_map || view.shows(Panel::GaussMap);
    stages.minkowski = stages.minkowski || view.shows(Panel::Minkowski);
  }
  return stages;
}

/// The first entry of every two shapes of which one is dynamic.
std::vector<bool> acting_pairs(const Scenario& scenario) {
  std::vector<bool> acting;
  std::set<std::pair<int, int>> seen;
  for (const ScenarioPair& pair : scenario.pairs) {
    const bool first = seen.emplace(std::minmax(pair.a, pair.b)).second;
    const auto dynamic = [&](int i) {
      return scenario.shapes[static_cast<std::size_t>(i)].body.has_value();
    };
    acting.push_back(first && (dynamic(pair.a) || dynamic(pair.b)));
  }
  return acting;
}

template <class S>
void describe(const Sphere<S>& sphere, trace::Shape& traced) {
  traced.vertices = {Vec3d::Zero()};
  traced.radius = sphere.radius;
}

template <class S>
void describe(const Capsule<S>& capsule, trace::Shape& traced) {
  for (const Vec3<S>& point : capsule.points)
    traced.vertices.push_back(point.template cast<double>());
  traced.edges = {{0, 1}};
  traced.radius = capsule.radius;
  traced.center_of_mass = 0.5 * (traced.vertices[0] + traced.vertices[1]);
}

template <class S>
void describe(const Hull<S>& hull, trace::Shape& traced) {
  for (const Vec3<S>& vertex : hull.vertices)
    traced.vertices.push_back(vertex.template cast<double>());
  for (int face = 0; face < hull.face_count(); ++face)
    traced.faces.push_back(face_vertices(hull, face));
  for (std::size_t edge = 0; edge < hull.half_edges.size(); edge += 2)
    traced.edges.push_back({hull.half_edges[edge].origin, hull.half_edges[edge + 1].origin});
  traced.center_of_mass = hull.centroid.template cast<double>();
}

template <class S>
void describe(const HalfSpace<S>& half_space, trace::Shape& traced) {
  const Plane<double> plane = half_space.plane.template cast<double>();
  traced.half_space = trace::HalfSpace{plane.normal, plane.offset};
}

template <class S>
void describe(const Mesh<S>& mesh, trace::Shape& traced) {
  for (const Vec3<S>& vertex : mesh.vertices)
    traced.vertices.push_back(vertex.template cast<double>());
  for (int triangle = 0; triangle < mesh.triangle_count(); ++triangle) {
    const std::array<int, 3>& corners = mesh.triangles[static_cast<std::size_t>(triangle)];
    traced.faces.emplace_back(corners.begin(), corners.end());
    for (int k = 0; k < 3; ++k) {
      // An edge that two triangles share is listed by the first.
      const int neighbour = mesh.neighbour(triangle, k);
      if (neighbour >= 0 && neighbour < triangle) continue;
      traced.edges.push_back(
          {corners[static_cast<std::size_t>(k)], corners[static_cast<std::size_t>((k + 1) % 3)]});
    }
  }
  const Aabb<S> bounds = mesh.tree.bounds();
  traced.center_of_mass = bounds.center().template cast<double>();
}

template <class S>
trace::Shape traced_shape(const ScenarioShape& shape, const Shape<S>& rounded) {
  trace::Shape traced;
  traced.name = shape.name;
  traced.type = shape.type;
  const auto describe_kind = [&](const auto& kind) { describe(kind, traced); };
  if (shape.is_moved())
    std::visit(describe_kind, *shape.geometry);
  else
    std::visit(describe_kind, rounded);
  return traced;
}

const ScenarioShape& mesh_of(const Scenario& scenario, const ScenarioPair& pair) {
  const ScenarioShape& a = scenario.shapes[static_cast<std::size_t>(pair.a)];
  const ScenarioShape& b = scenario.shapes[static_cast<std::size_t>(pair.b)];
  return kind_of(*a.geometry) == ShapeKind::Mesh ? a : b;
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
      shows_stability_(shows_stability(scenario.views)),
      shows_plots_(shows_plots(scenario.views)),
      memories_(scenario.pairs.size()),
      dynamic_(std::ranges::any_of(
          scenario.shapes, [](const ScenarioShape& shape) { return shape.body.has_value(); })),
      acts_(acting_pairs(scenario)) {
  if (scenario.scalar == Scalar::Double)
    shapes_ = rounded_shapes<double>(scenario);
  else
    shapes_ = rounded_shapes<float>(scenario);
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
      [&](const auto& shapes) {
        for (std::size_t i = 0; i < shapes.size(); ++i)
          header.shapes.push_back(traced_shape(scenario_->shapes[i], shapes[i]));
      },
      shapes_);
  return header;
}

/// One pair in one frame, written into `record` where there is one; goes by what `memory` holds of
/// the frame before, and leaves this frame's in it. Whichever shape a file names first as `a`, the
/// pipeline gets them in the order of its table, and shapes of one type in that of the file: then
/// trading a and b mirrors every result, and what a reducer remembers is what it has seen.
template <class S>
Manifolds<S> Runner::collide_pair(const std::vector<Shape<S>>& shapes, const ScenarioPair& pair,
                                  const Pose<S>& of_a, const Pose<S>& of_b, int frame,
                                  Memory& memory, trace::Pair* record) const {
  const auto place = [&](int shape) {
    return std::pair(kind_of(shapes[static_cast<std::size_t>(shape)]), shape);
  };
  const bool mirrored = place(pair.a) > place(pair.b);
  const auto a = static_cast<std::size_t>(mirrored ? pair.b : pair.a);
  const auto b = static_cast<std::size_t>(mirrored ? pair.a : pair.b);
  const Pose<S>& pose_a = mirrored ? of_b : of_a;
  const Pose<S>& pose_b = mirrored ? of_a : of_b;
  CollideOptions<S> options = options_of<S>(pair.pipeline);
  if (scenario_->shapes[a].body || scenario_->shapes[b].body)
    options.margin =
        std::max(options.margin, static_cast<S>(scenario_->solver.speculative_margin.value_or(0)));
  options.reduction.previous = memory.kept;
  PairCache<S>* const cache =
      pair.pipeline.cache ? std::get_if<PairCache<S>>(&memory.cache) : nullptr;

  Manifolds<S> manifolds;
  const Recording recording{pair.pipeline.reducer.c_str(), stages_, mirrored};
  if (pair.pipeline.manifold == ManifoldKind::Incremental) {
    const IncrementalOptions incremental{pair.pipeline.incremental, pair.pipeline.penetration};
    auto& persistent = std::get<PersistentManifold<S>>(memory.persistent);
    if (record == nullptr)
      collide_incremental(shapes[a], pose_a, shapes[b], pose_b, options, incremental, persistent,
                          manifolds);
    else
      collide_incremental(shapes[a], pose_a, shapes[b], pose_b, options, incremental, persistent,
                          manifolds, recording, *record);
  } else if (record == nullptr) {
    collide(shapes[a], pose_a, shapes[b], pose_b, options, manifolds, cache);
  } else {
    collide(shapes[a], pose_a, shapes[b], pose_b, options, manifolds, recording, *record, cache);
  }

  memory.frame = frame;
  memory.kept.clear();
  for (const Manifold<S>& manifold : manifolds)
    for (const ContactPoint<S>& point : manifold.points) memory.kept.push_back(point.id);
  if (mirrored)
    for (Manifold<S>& manifold : manifolds) mirror(manifold);
  return manifolds;
}

template <class S>
Runner::Memory Runner::new_memory(const ScenarioPair& pair) const {
  Memory memory;
  memory.cache = PairCache<S>();
  memory.persistent = PersistentManifold<S>();
  memory.settings = pair.pipeline;
  return memory;
}

/// What the frame before left; nothing in frame 0, and where the pair has no use for it.
template <class S>
Runner::Memory Runner::memory_before(const std::vector<Shape<S>>& shapes, std::size_t pair,
                                     int frame) const {
  const ScenarioPair& facts = scenario_->pairs[pair];
  const bool caches =
      facts.pipeline.cache && can_cache(kind_of(shapes[static_cast<std::size_t>(facts.a)]),
                                        kind_of(shapes[static_cast<std::size_t>(facts.b)]));
  const bool persists = facts.pipeline.manifold == ManifoldKind::Incremental;
  Memory memory = new_memory<S>(facts);
  if (frame == 0 || !(caches || persists || remembers(facts.pipeline.reducer))) return memory;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const Memory& last = memories_[pair];
    if (last.frame >= 0 && last.frame < frame && last.settings == facts.pipeline) memory = last;
  }
  while (memory.frame < frame - 1) {
    const int next = memory.frame + 1;
    const double time = next * scenario_->dt;
    const auto pose = [&](int shape) {
      return collider_pose_at(scenario_->shapes[static_cast<std::size_t>(shape)], time)
          .template cast<S>();
    };
    collide_pair<S>(shapes, facts, pose(facts.a), pose(facts.b), next, memory, nullptr);
  }
  return memory;
}

void Runner::record_stability(const ScenarioPair& pair, const trace::Frame& frame,
                              trace::Pair& record) const {
  if (!stages_.stability) return;
  if (!shows_stability_ && pair.pipeline.manifold != ManifoldKind::Incremental) return;
  const Vec3d up = scenario_->up == "z" ? Vec3d::UnitZ() : Vec3d::UnitY();
  const auto center = [&](int index) {
    const auto i = static_cast<std::size_t>(index);
    return std::visit(
        [&](const auto& shapes) {
          return frame.poses[i].second.transform(
              traced_shape(scenario_->shapes[i], shapes[i]).center_of_mass);
        },
        shapes_);
  };
  const auto rests = [&](int index) {  // false of what cannot fall
    const ShapeKind kind = kind_of(*scenario_->shapes[static_cast<std::size_t>(index)].geometry);
    return kind != ShapeKind::Plane && kind != ShapeKind::Mesh;
  };
  const auto dynamic = [&](int index) {
    return scenario_->shapes[static_cast<std::size_t>(index)].body.has_value();
  };
  const auto rank = [&](int index) { return std::pair(rests(index), dynamic(index)); };
  const bool higher_a = center(pair.a).dot(up) > center(pair.b).dot(up);
  const int body =
      rank(pair.a) > rank(pair.b) || (rank(pair.a) == rank(pair.b) && higher_a) ? pair.a : pair.b;
  if (!rests(body)) return;
  const double epsilon = scenario_->scalar == Scalar::Double
                             ? std::numeric_limits<double>::epsilon()
                             : static_cast<double>(std::numeric_limits<float>::epsilon());
  record.stability = stability_of(record, scenario_->shapes[static_cast<std::size_t>(body)].name,
                                  center(body), epsilon);
}

template <class S>
Manifolds<S> Runner::add_pair(const std::vector<Shape<S>>& shapes, const ScenarioPair& pair,
                              const Pose<S>& pose_a, const Pose<S>& pose_b, bool recorded,
                              Memory& memory, trace::Frame& frame) const {
  trace::Pair record;
  record.a = scenario_->shapes[static_cast<std::size_t>(pair.a)].name;
  record.b = scenario_->shapes[static_cast<std::size_t>(pair.b)].name;
  record.label = pair.label;
  Manifolds<S> manifolds =
      collide_pair(shapes, pair, pose_a, pose_b, frame.frame, memory, recorded ? &record : nullptr);
  if (recorded) {
    const ScenarioShape& mesh = mesh_of(*scenario_, pair);
    if (record.tree && mesh.is_moved()) move_boxes(*record.tree, mesh.collider_origin);
    record_stability(pair, frame, record);
  } else {
    record.kind = pair_kind(shapes[static_cast<std::size_t>(pair.a)],
                            shapes[static_cast<std::size_t>(pair.b)]);
    keep_manifolds(manifolds, record);
  }
  frame.pairs.push_back(std::move(record));
  return manifolds;
}

template <class S>
trace::Frame Runner::run(const std::vector<Shape<S>>& shapes, int frame, bool recorded) const {
  if (dynamic_) return run_world(shapes, frame, recorded);
  trace::Frame result;
  result.frame = frame;
  result.time = frame * scenario_->dt;
  std::vector<Pose<S>> poses;
  for (const ScenarioShape& shape : scenario_->shapes) {
    poses.push_back(collider_pose_at(shape, result.time).template cast<S>());
    result.poses.emplace_back(shape.name,
                              told_pose(shape, result.time, poses.back().template cast<double>()));
  }
  for (std::size_t i = 0; i < scenario_->pairs.size(); ++i) {
    const ScenarioPair& pair = scenario_->pairs[i];
    Memory memory = memory_before(shapes, i, frame);
    add_pair(shapes, pair, poses[static_cast<std::size_t>(pair.a)],
             poses[static_cast<std::size_t>(pair.b)], recorded, memory, result);
    const std::lock_guard<std::mutex> lock(mutex_);
    memories_[i] = std::move(memory);
  }
  return result;
}

#define CONTACTSCOPE_INSTANTIATE(S)                                                             \
  template Manifolds<S> Runner::collide_pair(const std::vector<Shape<S>>&, const ScenarioPair&, \
                                             const Pose<S>&, const Pose<S>&, int, Memory&,      \
                                             trace::Pair*) const;                               \
  template Manifolds<S> Runner::add_pair(const std::vector<Shape<S>>&, const ScenarioPair&,     \
                                         const Pose<S>&, const Pose<S>&, bool, Memory&,         \
                                         trace::Frame&) const;                                  \
  template Runner::Memory Runner::new_memory<S>(const ScenarioPair&) const;
CONTACTSCOPE_INSTANTIATE(float)
CONTACTSCOPE_INSTANTIATE(double)
#undef CONTACTSCOPE_INSTANTIATE

trace::Frame Runner::frame(int frame) const {
  trace::Frame result =
      std::visit([&](const auto& shapes) { return run(shapes, frame, true); }, shapes_);
  if (result.solver || shows_plots_) result.totals = trace::totals_of(result);
  return result;
}

trace::Frame Runner::frame_unrecorded(int frame) const {
  return std::visit([&](const auto& shapes) { return run(shapes, frame, false); }, shapes_);
}

trace::Header trace_header(const Scenario& scenario) {
  return Runner(scenario).header();
}

trace::Frame run_frame(const Scenario& scenario, int frame) {
  return Runner(scenario).frame(frame);
}

trace::Frame run_frame_unrecorded(const Scenario& scenario, int frame) {
  return Runner(scenario).frame_unrecorded(frame);
}

}  // namespace contactscope
