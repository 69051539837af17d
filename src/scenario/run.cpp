#include "scenario/run.h"

#include <algorithm>

#include "core/feature_id.h"
#include "manifold/collide_hull_hull.h"

namespace contactscope {
namespace {

template <class S>
std::vector<Hull<S>> rounded_hulls(const Scenario& scenario) {
  std::vector<Hull<S>> hulls;
  hulls.reserve(scenario.shapes.size());
  for (const ScenarioShape& shape : scenario.shapes) hulls.push_back(hull_cast<S>(*shape.hull));
  return hulls;
}

template <class S>
CollideOptions<S> options_of(const PipelineSettings& settings) {
  CollideOptions<S> options;
  options.margin = static_cast<S>(settings.margin);
  options.preference = settings.preference;
  options.reducer = find_reducer<S>(settings.reducer);
  options.reduction.max_points = settings.max_points;
  return options;
}

/// What an engine that records nothing still knows of a pair.
template <class S>
void keep_manifold(const Manifold<S>& manifold, trace::Pair& pair) {
  pair.kind = "hull-hull";
  pair.state = manifold.points.empty() ? "separated" : "touching";
  if (manifold.points.empty()) return;
  trace::Manifold kept;
  kept.normal = manifold.normal.template cast<double>();
  kept.axis = to_string(manifold.axis);
  for (const ContactPoint<S>& point : manifold.points)
    kept.points.push_back({point.position.template cast<double>(),
                           static_cast<double>(point.separation), to_string(point.id)});
  pair.separation = std::ranges::min(kept.points, {}, &trace::Point::separation).separation;
  pair.manifolds.push_back(std::move(kept));
}

bool remembers(const std::string& reducer) {
  const auto found = std::ranges::find(reducers(), reducer, &ReducerInfo::name);
  return found != reducers().end() && found->remembers;
}

template <class S>
trace::Shape traced_shape(const ScenarioShape& shape, const Hull<S>& hull) {
  trace::Shape traced;
  traced.name = shape.name;
  traced.type = shape.type;
  for (const Vec3<S>& vertex : hull.vertices)
    traced.vertices.push_back(vertex.template cast<double>());
  for (int face = 0; face < hull.face_count(); ++face)
    traced.faces.push_back(face_vertices(hull, face));
  for (std::size_t edge = 0; edge < hull.half_edges.size(); edge += 2)
    traced.edges.push_back({hull.half_edges[edge].origin, hull.half_edges[edge + 1].origin});
  traced.center_of_mass = hull.centroid.template cast<double>();
  return traced;
}

}  // namespace

Runner::Runner(const Scenario& scenario, const trace::Stages& stages)
    : scenario_(&scenario), stages_(stages), memories_(scenario.pairs.size()) {
  if (scenario.scalar == Scalar::Double)
    hulls_ = rounded_hulls<double>(scenario);
  else
    hulls_ = rounded_hulls<float>(scenario);
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
      [&](const auto& hulls) {
        for (std::size_t i = 0; i < hulls.size(); ++i)
          header.shapes.push_back(traced_shape(scenario_->shapes[i], hulls[i]));
      },
      hulls_);
  return header;
}

/// Ids that the reducer of a pair kept in the frame before; none in frame 0, after a frame without
/// contact, and where the reducer has no use for them.
template <class S>
std::vector<FeatureId> Runner::kept_before(const std::vector<Hull<S>>& hulls, std::size_t pair,
                                           int frame) const {
  const ScenarioPair& facts = scenario_->pairs[pair];
  if (frame == 0 || !remembers(facts.pipeline.reducer)) return {};
  Memory memory;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const Memory& last = memories_[pair];
    if (last.frame < frame && last.settings == facts.pipeline) memory = last;
  }
  while (memory.frame < frame - 1) {
    ++memory.frame;
    const double time = memory.frame * scenario_->dt;
    const auto a = static_cast<std::size_t>(facts.a);
    const auto b = static_cast<std::size_t>(facts.b);
    CollideOptions<S> options = options_of<S>(facts.pipeline);
    options.reduction.previous = memory.kept;
    const Manifold<S> manifold = collide_hull_hull(
        hulls[a], pose_at(scenario_->shapes[a], time).template cast<S>(), hulls[b],
        pose_at(scenario_->shapes[b], time).template cast<S>(), options);
    memory.kept.clear();
    for (const ContactPoint<S>& point : manifold.points) memory.kept.push_back(point.id);
  }
  memory.settings = facts.pipeline;
  const std::lock_guard<std::mutex> lock(mutex_);
  memories_[pair] = memory;
  return memory.kept;
}

template <class S>
trace::Frame Runner::run(const std::vector<Hull<S>>& hulls, int frame, bool recorded) const {
  trace::Frame result;
  result.frame = frame;
  result.time = frame * scenario_->dt;
  std::vector<Pose<S>> poses;
  for (const ScenarioShape& shape : scenario_->shapes) {
    poses.push_back(pose_at(shape, result.time).template cast<S>());
    result.poses.emplace_back(shape.name, poses.back().template cast<double>());
  }
  for (std::size_t i = 0; i < scenario_->pairs.size(); ++i) {
    const ScenarioPair& pair = scenario_->pairs[i];
    const auto a = static_cast<std::size_t>(pair.a);
    const auto b = static_cast<std::size_t>(pair.b);
    const std::vector<FeatureId> before = kept_before(hulls, i, frame);
    CollideOptions<S> options = options_of<S>(pair.pipeline);
    options.reduction.previous = before;
    trace::Pair record;
    record.a = scenario_->shapes[a].name;
    record.b = scenario_->shapes[b].name;
    record.label = pair.label;
    if (recorded)
      collide_hull_hull(hulls[a], poses[a], hulls[b], poses[b], options,
                        pair.pipeline.reducer.c_str(), stages_, record);
    else
      keep_manifold(collide_hull_hull(hulls[a], poses[a], hulls[b], poses[b], options), record);
    result.pairs.push_back(std::move(record));
  }
  return result;
}

trace::Frame Runner::frame(int frame) const {
  return std::visit([&](const auto& hulls) { return run(hulls, frame, true); }, hulls_);
}

trace::Frame Runner::frame_unrecorded(int frame) const {
  return std::visit([&](const auto& hulls) { return run(hulls, frame, false); }, hulls_);
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
