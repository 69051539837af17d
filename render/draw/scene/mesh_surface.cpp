#include "draw/scene/mesh_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "core/convex_polygon.h"
#include "draw/scene/shading.h"
#include "draw/scene/swatches.h"

namespace contactscope::draw {
namespace {

// Lengths of an edge on the screen, pixels, between which the lines inside of a surface fade.
constexpr double kFaded = 5;
constexpr double kFull = 60;
constexpr float kThinAlpha = 0.45f;
// A mesh of so few triangles is drawn like a hull: all are parted exactly, creases are strong.
constexpr std::size_t kFewTriangles = 120;
constexpr std::size_t kSampled = 400;  // edges are enough to know how long they are

// How strong the lines between triangles are.
float thin_alpha(const Scene& scene, const PlacedShape& shape) {
  const std::vector<ShapeMesh::Edge>& edges = shape.mesh->edges;
  const std::size_t step = std::max<std::size_t>(1, edges.size() / kSampled);
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < edges.size(); i += step) {
    const Vec3d& from = shape.vertices[static_cast<std::size_t>(edges[i].from)];
    const Vec3d& to = shape.vertices[static_cast<std::size_t>(edges[i].to)];
    const Vec3d middle = 0.5 * (from + to);
    if (!scene.camera.project(middle)) continue;
    sum += (to - from).norm() * scene.camera.pixels_per_metre(middle);
    ++count;
  }
  if (count == 0) return 0;
  const double share = (sum / count - kFaded) / (kFull - kFaded);
  return kThinAlpha * static_cast<float>(std::clamp(share, 0.0, 1.0));
}

// How far apart two lines at least are on the screen, pixels, that both stay: closer ones make a
// moiré.
constexpr double kTooClose = 3;
constexpr double kFarEnough = 11;

// The share that is left of a line between triangles which stand closer and closer on the screen
// towards the horizon.
float distance_fade(const Scene& scene, const PlacedShape& shape, const ShapeMesh::Edge& edge) {
  const std::optional<Point2> from =
      scene.camera.project(shape.vertices[static_cast<std::size_t>(edge.from)]);
  const std::optional<Point2> to =
      scene.camera.project(shape.vertices[static_cast<std::size_t>(edge.to)]);
  if (!from || !to) return 1;
  const Vec2d along(to->x - from->x, to->y - from->y);
  const double length = along.norm();
  if (length <= 0) return 0;
  double spacing = std::numeric_limits<double>::infinity();
  for (const int face : {edge.left, edge.right}) {
    if (face < 0) continue;
    for (const int v : shape.mesh->shape->faces[static_cast<std::size_t>(face)]) {
      if (v == edge.from || v == edge.to) continue;
      const std::optional<Point2> apex =
          scene.camera.project(shape.vertices[static_cast<std::size_t>(v)]);
      if (!apex) continue;
      const Vec2d way(apex->x - from->x, apex->y - from->y);
      spacing = std::min(spacing, std::abs(cross(along, way)) / length);
    }
  }
  const double share = (spacing / scene.scales.pixel - kTooClose) / (kFarEnough - kTooClose);
  return static_cast<float>(std::clamp(share, 0.0, 1.0));
}

// What the other shapes reach: there triangles have to be parted exactly.
struct Reach {
  Vec3d low = Vec3d::Constant(1e300), high = Vec3d::Constant(-1e300);

  Reach(const Scene& scene, const PlacedShape& mesh) {
    for (const PlacedShape& other : scene.shapes) {
      if (&other == &mesh || other.mesh->shape->type == "mesh") continue;
      for (const Vec3d& p : extent_points(other)) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
      }
    }
  }
  bool meets(const std::vector<Vec3d>& polygon) const {
    Vec3d from = polygon.front(), to = from;
    for (const Vec3d& p : polygon) {
      from = from.cwiseMin(p);
      to = to.cwiseMax(p);
    }
    return (from.array() <= high.array()).all() && (to.array() >= low.array()).all();
  }
};

}  // namespace

void draw_mesh(const Scene& scene, const PlacedShape& shape, Sketch& sketch) {
  const trace::Shape& surface = *shape.mesh->shape;
  const Vec3d light = key_light(scene.camera);
  const Color base = shape.is_a ? kShapeA : kShapeB;
  const std::vector<ShapeMesh::Edge>& edges = shape.mesh->edges;
  const bool open =
      std::ranges::any_of(edges, [](const ShapeMesh::Edge& edge) { return edge.right < 0; });
  const bool many = surface.faces.size() > kFewTriangles;
  const Reach reach(scene, shape);

  std::vector<bool> front(surface.faces.size());
  for (std::size_t f = 0; f < surface.faces.size(); ++f) {
    const std::vector<Vec3d> polygon = shape.polygon(static_cast<int>(f));
    const Vec3d normal = shape.normal(static_cast<int>(f));
    front[f] = scene.camera.faces(polygon.front(), normal);
    if (!front[f] && !open) continue;
    sketch.occluders.push_back(polygon);
    const double lit = front[f] ? normal.dot(light) : -normal.dot(light);
    sketch.surfaces.push_back(
        {polygon, toned(base, lit), many && !reach.meets(polygon) ? kSmallSurface : kFlatSurface});
  }

  const LineStyle border{1.5f, with_alpha(kShapeEdge, 0.85f), false, LineStyle::Hidden::Faint};
  const LineStyle silhouette{2.0f, kShapeEdge, false,
                             many ? LineStyle::Hidden::Gone : LineStyle::Hidden::Faint};
  const LineStyle crease{1.5f, with_alpha(kShapeEdge, 0.85f), false,
                         many ? LineStyle::Hidden::Gone : LineStyle::Hidden::Faint};
  const LineStyle thin{1.0f, with_alpha(kShapeEdge, thin_alpha(scene, shape)), false,
                       LineStyle::Hidden::Gone};
  for (const ShapeMesh::Edge& edge : edges) {
    const bool left = front[static_cast<std::size_t>(edge.left)];
    const bool right = edge.right >= 0 && front[static_cast<std::size_t>(edge.right)];
    const LineStyle* style = &thin;
    if (edge.right < 0) {
      style = &border;
    } else if (left != right) {
      style = &silhouette;
    } else if (!edge.smooth && !many) {
      style = &crease;
    }
    LineStyle faded = thin;
    if (style == &thin) {
      if (thin.color.a <= 0 || (!left && !open)) continue;
      if (many) faded.color.a *= distance_fade(scene, shape, edge);
      if (faded.color.a < 0.01f) continue;
      style = &faded;
    }
    sketch.line(shape.vertex(edge.from), shape.vertex(edge.to), *style);
  }
}

namespace {

// A triangle of a mesh with the strongest role that a manifold gives it.
struct Touched {
  const PlacedShape* mesh = nullptr;
  int triangle = -1;
  bool incident = false;
};

std::vector<Touched> touched_triangles(const Scene& scene) {
  std::vector<Touched> touched;
  std::map<std::pair<const PlacedShape*, int>, std::size_t> places;  // in `touched`
  for (const trace::Pair& pair : scene.frame.pairs) {
    for (const std::string& name : {pair.a, pair.b}) {
      const PlacedShape* mesh = scene.find(name);
      if (mesh == nullptr || mesh->mesh->shape->type != "mesh") continue;
      const int triangles = static_cast<int>(mesh->mesh->shape->faces.size());
      for (const trace::Manifold& manifold : pair.manifolds) {
        const int triangle = manifold.triangle.value_or(-1);
        if (triangle < 0 || triangle >= triangles) continue;
        const bool incident = manifold.axis == (name == pair.a ? "face_b" : "face_a");
        const auto [known, is_new] = places.try_emplace({mesh, triangle}, touched.size());
        if (is_new)
          touched.push_back({mesh, triangle, incident});
        else if (!incident)
          touched[known->second].incident = false;
      }
    }
  }
  return touched;
}

}  // namespace

void draw_touched_triangles(const Scene& scene, Sketch& sketch) {
  const std::vector<Touched> touched = touched_triangles(scene);
  const float width = touched.size() > 6 ? 1.5f : touched.size() > 2 ? 2.0f : 3.0f;
  for (const auto& [mesh, triangle, incident] : touched) {
    const Color color = incident ? kIncidentFace : kReferenceFace;
    // On a landscape what stands before a triangle hides it.
    const bool many = mesh->mesh->shape->faces.size() > kFewTriangles;
    sketch.face(
        mesh->polygon(triangle), with_alpha(color, 0.35f),
        {width, color, incident, many ? LineStyle::Hidden::Faint : LineStyle::Hidden::Same});
  }
}

void explain_touched_triangles(const Scene& scene, Legend& legend) {
  for (const Touched& touched : touched_triangles(scene)) {
    legend.explain(touched.incident ? kIncidentFaceSwatch : kReferenceFaceSwatch,
                   touched.incident ? "triangle touched, incident" : "triangle touched");
  }
}

}  // namespace contactscope::draw
