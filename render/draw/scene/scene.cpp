#include "draw/scene/scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace contactscope::draw {
namespace {

// Facets of a tessellated round surface meet at small angles; their common edge is drawn faintly.
constexpr double kSmoothCosine = 0.90;  // 26 degrees

}  // namespace

void Sketch::explain(LegendKind kind, const std::string& text) {
  for (const LegendEntry& entry : legend) {
    if (entry.kind == kind && entry.text == text) return;
  }
  legend.push_back({kind, text});
}

ShapeMesh make_mesh(const trace::Shape& shape) {
  ShapeMesh mesh;
  mesh.shape = &shape;
  std::map<std::pair<int, int>, std::size_t> known;
  for (std::size_t f = 0; f < shape.faces.size(); ++f) {
    const std::vector<int>& face = shape.faces[f];
    Vec3d normal = Vec3d::Zero();
    const Vec3d& origin = shape.vertices[static_cast<std::size_t>(face[0])];
    for (std::size_t i = 0; i < face.size(); ++i) {
      const int from = face[i];
      const int to = face[(i + 1) % face.size()];
      normal += (shape.vertices[static_cast<std::size_t>(from)] - origin)
                    .cross(shape.vertices[static_cast<std::size_t>(to)] - origin);
      const auto [entry, is_new] = known.try_emplace(std::minmax(from, to), mesh.edges.size());
      if (is_new) {
        mesh.edges.push_back({from, to, static_cast<int>(f), -1, false});
      } else {
        mesh.edges[entry->second].right = static_cast<int>(f);
      }
    }
    mesh.normals.push_back(normal.normalized());
  }
  for (ShapeMesh::Edge& edge : mesh.edges) {
    if (edge.right < 0) continue;
    edge.smooth = mesh.normals[static_cast<std::size_t>(edge.left)].dot(
                      mesh.normals[static_cast<std::size_t>(edge.right)]) > kSmoothCosine;
  }
  for (const Vec3d& v : shape.vertices) {
    mesh.radius = std::max(mesh.radius, (v - shape.center_of_mass).norm());
  }
  mesh.radius += shape.radius;
  if (shape.half_space) mesh.radius = std::numeric_limits<double>::infinity();
  return mesh;
}

std::vector<Vec3d> extent_points(const PlacedShape& shape) {
  const double radius = shape.mesh->shape->radius;
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
  std::vector<Vec3d> result;
  for (const int v : mesh->shape->faces[static_cast<std::size_t>(face)]) {
    result.push_back(vertices[static_cast<std::size_t>(v)]);
  }
  return result;
}

const PlacedShape* Scene::find(const std::string& name) const {
  for (const PlacedShape& shape : shapes) {
    if (shape.mesh->shape->name == name) return &shape;
  }
  return nullptr;
}

std::vector<PlacedShape> place_shapes(const std::vector<ShapeMesh>& meshes,
                                      const trace::Frame& frame) {
  std::vector<PlacedShape> placed;
  for (const ShapeMesh& mesh : meshes) {
    PlacedShape shape;
    shape.mesh = &mesh;
    const std::string& name = mesh.shape->name;
    for (const auto& [posed, pose] : frame.poses) {
      if (posed == name) shape.pose = pose;
    }
    for (const Vec3d& v : mesh.shape->vertices) shape.vertices.push_back(shape.pose.transform(v));
    for (const trace::Pair& pair : frame.pairs) {
      if (pair.a != name && pair.b != name) continue;
      shape.is_a = pair.a == name;
      break;
    }
    placed.push_back(std::move(shape));
  }
  return placed;
}

std::vector<Vec3d> extent_points(const std::vector<PlacedShape>& shapes) {
  std::vector<Vec3d> points;
  const auto add = [&](bool meshes) {
    for (const PlacedShape& shape : shapes) {
      if ((shape.mesh->shape->type == "mesh") != meshes) continue;
      const std::vector<Vec3d> own = extent_points(shape);
      points.insert(points.end(), own.begin(), own.end());
    }
  };
  add(false);
  const std::size_t bodies = points.size();
  Vec3d low = Vec3d::Constant(std::numeric_limits<double>::max());
  Vec3d high = -low;
  for (const Vec3d& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  add(true);
  if (bodies == 0) return points;
  const Vec3d around = Vec3d::Constant(0.5 * (high - low).maxCoeff());
  for (std::size_t i = bodies; i < points.size(); ++i) {
    points[i] = points[i].cwiseMax(low - around).cwiseMin(high + around);
  }
  return points;
}

}  // namespace contactscope::draw
