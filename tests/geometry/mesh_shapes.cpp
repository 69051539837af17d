#include "mesh_shapes.h"

#include <cmath>
#include <numbers>

namespace contactscope::test {
namespace {

Vec3d in_cube(Random& random, double side) {
  return {random.uniform(-side / 2, side / 2), random.uniform(-side / 2, side / 2),
          random.uniform(-side / 2, side / 2)};
}

}  // namespace

void MeshInput::add(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const int first = static_cast<int>(vertices.size());
  vertices.insert(vertices.end(), {a, b, c});
  triangles.push_back({first, first + 1, first + 2});
}

MeshInput random_soup(Random& random, int count, double side, double size, const Vec3d& center) {
  MeshInput soup;
  for (int i = 0; i < count; ++i) {
    const Vec3d at = center + in_cube(random, side);
    soup.add(at, at + in_cube(random, size), at + in_cube(random, size));
  }
  return soup;
}

MeshInput random_slivers(Random& random, int count, double side, const Vec3d& center) {
  MeshInput soup;
  for (int i = 0; i < count; ++i) {
    const Vec3d a = center + in_cube(random, side);
    const Vec3d b = center + in_cube(random, side);
    // On the line through both, anywhere between them, and a little off it.
    const Vec3d on_line = a + random.uniform(0, 1) * (b - a);
    soup.add(a, b, on_line + side * random.decade(-6, 0) * random.unit_vector());
  }
  return soup;
}

MeshInput skewed_mesh(Random& random, int count) {
  MeshInput mesh;
  double scale = 1e-3;
  for (int i = 0; i < count; ++i) {
    const Vec3d at = scale * random.unit_vector();
    mesh.add(at, at + 0.3 * scale * random.unit_vector(), at + 0.3 * scale * random.unit_vector());
    scale *= i % 20 == 0 ? 1.1 : 1;
  }
  return mesh;
}

MeshInput triangles_of(const Hull<double>& hull) {
  MeshInput mesh{hull.vertices, {}};
  for (int f = 0; f < hull.face_count(); ++f) {
    const std::vector<int> face = face_vertices(hull, f);
    mesh.triangles.push_back({face.at(0), face.at(1), face.at(2)});
  }
  return mesh;
}

MeshInput moebius_strip(int quads) {
  MeshInput strip;
  for (int i = 0; i < quads; ++i) {
    const double turn = 2 * std::numbers::pi * i / quads;
    const Vec3d out(std::cos(turn), 0, std::sin(turn));
    const Vec3d across = std::cos(turn / 2) * Vec3d::UnitY() + std::sin(turn / 2) * out;
    strip.vertices.emplace_back(3 * out + across);
    strip.vertices.emplace_back(3 * out - across);
  }
  for (int i = 0; i < quads; ++i) {
    const bool seam = i + 1 == quads;
    const int next = seam ? 0 : 2 * i + 2;
    const int upper = seam ? 1 : next;
    const int lower = seam ? 0 : next + 1;
    strip.triangles.push_back({2 * i, 2 * i + 1, upper});
    strip.triangles.push_back({2 * i + 1, lower, upper});
  }
  return strip;
}

MeshInput hinge(double angle) {
  MeshInput mesh;
  mesh.vertices = {Vec3d(0, 0, 0), Vec3d(0, 0, -1), Vec3d(-1, 0, 0),
                   Vec3d(std::cos(angle), -std::sin(angle), 0)};
  mesh.triangles = {{0, 1, 2}, {1, 0, 3}};
  return mesh;
}

}  // namespace contactscope::test
