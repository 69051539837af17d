#include "shrink/shrink.h"

namespace contactscope::shrink {
namespace {

/// Converts a name to an unquoted TOML key.
std::string plain_name(const std::string& name) {
  std::string plain;
  for (const char c : name)
    plain += std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_' ? c : '_';
  return plain.empty() ? "shape" : plain;
}

/// The half extents of a box centred at its origin; empty for others.
std::optional<Vec3d> half_extents_of(const trace::Shape& shape) {
  if (shape.type != "box" || shape.vertices.size() != 8) return std::nullopt;
  const Vec3d half = shape.vertices.front().cwiseAbs();
  for (const Vec3d& vertex : shape.vertices)
    if (vertex.cwiseAbs() != half) return std::nullopt;
  return half;
}

std::optional<SmallShape> small_shape(const trace::Header& header, const trace::Frame& frame,
                                      const std::string& name) {
  const trace::Shape* traced = nullptr;
  for (const auto* const list : {&header.shapes, &frame.shapes})
    for (const trace::Shape& shape : *list)
      if (shape.name == name) traced = &shape;
  const auto pose =
      std::ranges::find(frame.poses, name, [](const auto& placed) { return placed.first; });
  if (traced == nullptr || pose == frame.poses.end() || traced->type == "sdf") return std::nullopt;

  SmallShape shape;
  shape.name = plain_name(name);
  shape.vertices = traced->vertices;
  for (const trace::Deformed& deformed : frame.deformed)
    if (deformed.name == name) shape.vertices = deformed.vertices;
  shape.radius = traced->radius;
  shape.position = pose->second.position;
  const Quatd& q = pose->second.rotation;
  if (q.coeffs() != Quatd::Identity().coeffs())
    shape.turn = {Turn::Form::Quaternion, {q.w(), q.x(), q.y(), q.z()}};
  if (traced->half_space) {
    shape.kind = SmallShape::Kind::Plane;
    shape.vertices.clear();
    shape.normal = traced->half_space->normal;
    shape.offset = traced->half_space->offset;
  } else if (const auto half = half_extents_of(*traced)) {
    shape.kind = SmallShape::Kind::Box;
    shape.vertices.clear();
    shape.half_extents = *half;
  } else if (traced->type == "sphere" && traced->vertices.size() == 1) {
    shape.kind = SmallShape::Kind::Sphere;
    shape.position = pose->second.transform(traced->vertices.front());
    shape.vertices.clear();
  } else if (traced->type == "capsule" && traced->vertices.size() == 2) {
    shape.kind = SmallShape::Kind::Capsule;
  } else if (traced->type == "mesh") {
    shape.kind = SmallShape::Kind::Mesh;
    for (const std::vector<int>& face : traced->faces)
      for (std::size_t k = 2; k < face.size(); ++k)
        shape.triangles.push_back({face[0], face[k - 1], face[k]});
  }
  return shape;
}

/// The keys of [pipeline] that differ from the defaults.
std::vector<Setting> settings_of(const PipelineSettings& settings) {
  const PipelineSettings usual;
  std::vector<Setting> keys;
  const auto word = [&](const char* key, const auto& value, const auto& otherwise) {
    if (value != otherwise) keys.emplace_back(key, quoted(to_string(value)));
  };
  if (settings.scalar == Scalar::Double) keys.emplace_back("scalar", "\"double\"");
  if (settings.manifold == ManifoldKind::Incremental)
    keys.emplace_back("manifold", "\"incremental\"");
  if (settings.reducer != usual.reducer) keys.emplace_back("reducer", quoted(settings.reducer));
  if (settings.max_points != usual.max_points)
    keys.emplace_back("max_points", std::to_string(settings.max_points));
  if (settings.margin != usual.margin) keys.emplace_back("margin", spell(settings.margin));
  word("preference", settings.preference, usual.preference);
  word("degenerate", settings.degenerate, usual.degenerate);
  word("penetration", settings.penetration, usual.penetration);
  word("mesh_manifolds", settings.mesh_manifolds, usual.mesh_manifolds);
  if (settings.triangle >= 0) keys.emplace_back("triangle", std::to_string(settings.triangle));
  if (!settings.internal_edges) keys.emplace_back("internal_edges", "false");
  const Question& requested = settings.question;
  word("query", requested.kind, usual.question.kind);
  word("distance", requested.distance, usual.question.distance);
  if (requested.bounds) keys.emplace_back("bounds", quoted(to_string(*requested.bounds)));
  word("comparison", requested.comparison, usual.question.comparison);
  if (requested.tolerance > 0) keys.emplace_back("tolerance", spell(requested.tolerance));
  return keys;
}

const PipelineSettings& pipeline_of(const Scenario& scenario, const trace::Pair& pair) {
  for (const ScenarioPair& one : scenario.pairs)
    if (scenario.shape(one.a).name == pair.a && scenario.shape(one.b).name == pair.b &&
        one.label == pair.label)
      return one.pipeline;
  return scenario.pipeline;
}

bool is_dynamic(const Scenario& scenario, const std::string& name) {
  const auto found = std::ranges::find(scenario.shapes, name, &ScenarioShape::name);
  return found != scenario.shapes.end() && found->dynamic();
}

/// Expected contacts and answers of the pair in the frame; several entries are merged.
std::vector<Setting> expectation_of(const Scenario& scenario, const trace::Frame& frame,
                                    const trace::Pair& pair) {
  std::vector<Setting> keys;
  for (const Expectation& expected : scenario.expectations) {
    if (scenario.shape(expected.a).name != pair.a || scenario.shape(expected.b).name != pair.b ||
        expected.label != pair.label || frame.frame < expected.first_frame ||
        frame.frame > expected.last_frame)
      continue;
    const auto add = [&](const char* key, const std::string& value) {
      if (std::ranges::count(keys, key, &Setting::first) == 0) keys.emplace_back(key, value);
    };
    if (expected.state) add("state", quoted(*expected.state));
    if (expected.overlap) add("overlap", *expected.overlap ? "true" : "false");
    if (expected.touching) add("touching", *expected.touching ? "true" : "false");
    if (expected.points) add("points", std::to_string(*expected.points));
    if (expected.axis) add("axis", quoted(*expected.axis));
    if (expected.type) add("type", quoted(*expected.type));
    if (expected.normal) add("normal", spell(*expected.normal));
    if (expected.separation) add("separation", spell(*expected.separation));
    if (expected.normal || expected.separation) add("tolerance", spell(expected.tolerance));
  }
  return keys;
}

}  // namespace

std::optional<PairOfTwo> pair_of_frame(const trace::Header& header, const trace::Frame& frame,
                                       const trace::Pair& pair, const Scenario* scenario) {
  std::optional<SmallShape> a = small_shape(header, frame, pair.a);
  std::optional<SmallShape> b = small_shape(header, frame, pair.b);
  if (!a || !b) return std::nullopt;
  PairOfTwo two{header.up, *a, *b, {}, {}, {}};
  if (two.a.name == two.b.name) two.b.name += "_2";
  if (scenario != nullptr) {
    PipelineSettings settings = pipeline_of(*scenario, pair);
    settings.scalar = scenario->scalar;
    if (is_dynamic(*scenario, pair.a) || is_dynamic(*scenario, pair.b))
      settings.margin = std::max(settings.margin, scenario->solver.speculative_margin.value_or(0));
    two.settings = settings_of(settings);
    two.expectation = expectation_of(*scenario, frame, pair);
    return two;
  }
  if (header.scalar == "double") two.settings.emplace_back("scalar", "\"double\"");
  const Pose<double> pose = two.a.pose();
  std::vector<trace::Manifold>& claims = two.claims.emplace(pair.manifolds);
  for (trace::Manifold& manifold : claims) {
    manifold.normal = pose.inverse_rotate(manifold.normal);
    for (trace::Point& point : manifold.points) {
      point.position = pose.inverse_transform(point.position);
      point.on_a.reset();
      point.on_b.reset();
      point.impulse.reset();
      point.relative_velocity.reset();
    }
  }
  return two;
}

}  // namespace contactscope::shrink
