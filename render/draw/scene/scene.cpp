#include "draw/scene/scene.h"

#include "draw/scene/points.h"

namespace contactscope::draw {
namespace {

// Facets of a tessellated round surface meet at small angles. Their common edge is drawn faintly.
constexpr double kSmoothCosine = 0.90;  // 26 degrees

std::vector<Vec3d> corners_of(const std::vector<int>& face, const std::vector<Vec3d>& vertices) {
  return mapped(face, [&](int v) { return at(vertices, v); });
}

/// Sets the deformed vertices of a frame and recomputes the normals.
void deform(const std::vector<Vec3d>& vertices, PlacedShape& placed) {
  trace::Shape shape = placed.traced();
  shape.vertices = vertices;
  shape.center_of_mass = box_around(vertices).center();
  placed.deformed = std::make_shared<const trace::Shape>(std::move(shape));
  placed.deformed_mesh = std::make_shared<const ShapeMesh>(make_mesh(*placed.deformed));
  placed.mesh = placed.deformed_mesh.get();
}

}  // namespace

ShapeMesh make_mesh(const trace::Shape& shape) {
  ShapeMesh mesh;
  mesh.shape = &shape;
  std::map<std::pair<int, int>, std::size_t> known;
  for (int f = 0; f < count_of(shape.faces); ++f) {
    const std::vector<int>& face = at(shape.faces, f);
    mesh.normals.push_back(newell_normal(corners_of(face, shape.vertices)).normalized());
    for (std::size_t i = 0; i < face.size(); ++i) {
      const int from = face[i], to = face[(i + 1) % face.size()];
      const auto [entry, is_new] = known.try_emplace(std::minmax(from, to), mesh.edges.size());
      if (is_new)
        mesh.edges.push_back({from, to, f, -1, false});
      else
        mesh.edges[entry->second].right = f;
    }
  }
  for (ShapeMesh::Edge& edge : mesh.edges) {
    if (edge.right < 0) continue;
    edge.smooth = at(mesh.normals, edge.left).dot(at(mesh.normals, edge.right)) > kSmoothCosine;
  }
  for (const Vec3d& v : shape.vertices)
    mesh.radius = std::max(mesh.radius, (v - shape.center_of_mass).norm());
  mesh.radius += shape.radius;
  if (shape.half_space) mesh.radius = std::numeric_limits<double>::infinity();
  return mesh;
}

std::vector<Vec3d> extent_points(const PlacedShape& shape) {
  const double radius = shape.traced().radius;
  if (radius == 0) return shape.vertices;
  std::vector<Vec3d> points;
  for (const Vec3d& center : shape.vertices) {
    for (int i = 0; i < 27; ++i) {
      if (i == 13) continue;
      const Vec3d direction(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
      points.push_back(center + radius * direction.normalized());
    }
  }
  return points;
}

std::vector<Vec3d> PlacedShape::polygon(int face) const {
  return corners_of(at(mesh->shape->faces, face), vertices);
}

std::optional<std::array<Vec3d, 2>> PlacedShape::edge(int index) const {
  const trace::Shape& shape = mesh->core != nullptr ? *mesh->core : *mesh->shape;
  if (is_mesh() && index >= 0 && index < 3 * count_of(shape.faces)) {
    const std::vector<int>& corners = at(shape.faces, index / 3);
    return std::array{vertex(at(corners, index % 3)), vertex(at(corners, (index + 1) % 3))};
  }
  if (index < 0 || index >= count_of(shape.edges)) return std::nullopt;
  const auto& [from, to] = at(shape.edges, index);
  if (mesh->core == nullptr) return std::array{vertex(from), vertex(to)};
  return std::array{pose.transform(at(shape.vertices, from)),
                    pose.transform(at(shape.vertices, to))};
}

ShapeMeshes::ShapeMeshes(const std::vector<trace::Shape>& shapes) {
  for (const trace::Shape& shape : shapes) {
    places_.emplace(shape.name, size());
    if (!(shape.margin > 0) || shape.faces.empty()) {
      push_back(make_mesh(shape));
      continue;
    }
    const auto drawn = std::make_shared<const trace::Shape>(rounded(shape));
    push_back(make_mesh(*drawn));
    back().rounded = drawn;
    back().core = &shape;
    for (ShapeMesh::Edge& edge : back().edges) edge.smooth = true;  // it has no other edges
  }
}

std::optional<std::size_t> ShapeMeshes::find(std::string_view name) const {
  const auto found = places_.find(name);
  return found == places_.end() ? std::nullopt : std::optional(found->second);
}

double ShapeMeshes::smallest_radius() const {
  double smallest = std::numeric_limits<double>::infinity();
  for (const ShapeMesh& mesh : *this)
    if (mesh.radius > 0) smallest = std::min(smallest, mesh.radius);
  return smallest;
}

const PlacedShape* Scene::find(std::string_view name) const {
  const std::optional<std::size_t> place = meshes.find(name);
  if (!place) return nullptr;
  const auto found = std::ranges::lower_bound(shapes, *place, {}, &PlacedShape::place);
  return found != shapes.end() && found->place == *place ? &*found : nullptr;
}

bool Scene::is_context(const PlacedShape& shape) const {
  return crowded() && !view.focus_on.empty() &&
         std::ranges::find(view.focus_on, shape.traced().name) == view.focus_on.end();
}

std::span<const trace::Body> Scene::bodies() const {
  if (!frame.solver) return {};
  return frame.solver->bodies;
}

const trace::Body* Scene::body(std::string_view name) const {
  const auto found = std::ranges::find(bodies(), name, &trace::Body::name);
  return found == bodies().end() ? nullptr : &*found;
}

double Scene::noise(const trace::Pair& pair) const { return noise_of(header, meshes, frame, pair); }

double noise_of(const trace::Header& header, const ShapeMeshes& meshes, const trace::Frame& frame,
                const trace::Pair& pair) {
  const double half_digit = header.scalar == "float"    ? 0x1p-24
                            : header.scalar == "double" ? 0x1p-53
                                                        : 0;
  if (half_digit == 0) return 0;
  double smaller = std::numeric_limits<double>::infinity(), reach = 0;
  for (const std::string* name : {&pair.a, &pair.b}) {
    const std::optional<std::size_t> place = meshes.find(*name);
    if (!place || !(meshes[*place].radius < smaller)) continue;
    const auto pose =
        std::ranges::find(frame.poses, *name, [](const auto& placed) { return placed.first; });
    if (pose == frame.poses.end()) continue;
    smaller = meshes[*place].radius;
    reach = pose->second.position.cwiseAbs().maxCoeff();
  }
  if (!std::isfinite(smaller)) return 0;
  for (const trace::Manifold& manifold : pair.manifolds) {
    for (const trace::Point& point : manifold.points)
      return half_digit * std::max(point.position.cwiseAbs().maxCoeff(), smaller);
  }
  return half_digit * std::max(reach, smaller);
}

Vec3d up_axis(const trace::Header& header) {
  return header.up == "z" ? Vec3d::UnitZ() : Vec3d::UnitY();
}

std::vector<trace::Body> scripted_bodies(const ShapeMeshes& meshes,
                                         std::span<const trace::Placement> now,
                                         std::span<const trace::Placement> later, double seconds) {
  std::vector<trace::Body> bodies;
  for (const auto& [name, pose] : now) {
    const std::optional<std::size_t> place = meshes.find(name);
    const auto then = std::ranges::find(later, name, &trace::Placement::first);
    if (!place || then == later.end() || seconds == 0) continue;
    const Vec3d& middle = meshes[*place].shape->center_of_mass;
    trace::Body body{.name = name, .center_of_mass = pose.transform(middle)};
    const Eigen::AngleAxisd turn(then->second.rotation * pose.rotation.conjugate());
    body.velocity = (then->second.transform(middle) - body.center_of_mass) / seconds;
    body.angular_velocity = turn.angle() / seconds * turn.axis();
    if (!body.velocity.isZero(0) || turn.angle() != 0) bodies.push_back(std::move(body));
  }
  return bodies;
}

std::vector<PlacedShape> place_shapes(const ShapeMeshes& meshes, const trace::Frame& frame) {
  std::vector<PlacedShape> placed(meshes.size());
  std::vector<bool> has_role(meshes.size(), false);
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    placed[i].mesh = &meshes[i];
    placed[i].place = i;
  }
  std::vector<bool> is_here(meshes.size(), false);
  for (const auto& [name, pose] : frame.poses) {
    const auto place = meshes.find(name);
    if (!place) continue;
    placed[*place].pose = pose;
    is_here[*place] = true;
  }
  for (const trace::Deformed& now : frame.deformed) {
    const auto place = meshes.find(now.name);
    if (place && now.vertices.size() == placed[*place].traced().vertices.size())
      deform(now.vertices, placed[*place]);
  }
  for (const trace::Pair& pair : frame.pairs) {
    for (const std::string* name : {&pair.a, &pair.b}) {
      const auto place = meshes.find(*name);
      // If a broad phase chooses pairs, a role would change from frame to frame.
      if (!place || has_role[*place] || frame.broad_phase) continue;
      placed[*place].is_a = name == &pair.a;
      has_role[*place] = true;
    }
  }
  std::erase_if(placed, [&](const PlacedShape& shape) { return !is_here[shape.place]; });
  for (PlacedShape& shape : placed) {
    shape.vertices =
        mapped(shape.traced().vertices, [&](const Vec3d& v) { return shape.pose.transform(v); });
  }
  return placed;
}

std::vector<Vec3d> extent_points(const std::vector<PlacedShape>& shapes) {
  std::vector<Vec3d> points, of_meshes;
  for (const PlacedShape& shape : shapes)
    append(shape.is_mesh() ? of_meshes : points, extent_points(shape));
  if (points.empty()) return of_meshes;
  const Eigen::AlignedBox3d box = box_around(points);
  const Vec3d around = Vec3d::Constant(0.5 * box.sizes().maxCoeff());
  for (const Vec3d& p : of_meshes)
    points.push_back(p.cwiseMax(box.min() - around).cwiseMin(box.max() + around));
  return points;
}

}  // namespace contactscope::draw
