#include "geometry/obj.h"

#include <tiny_obj_loader.h>

#include <cassert>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <system_error>
#include <tuple>
#include <utility>

#include "core/input_error.h"
#include "geometry/obj_checks.h"
#include "geometry/triangulate_polygon.h"

namespace contactscope {
namespace {

/// What tinyobjloader reports. It can triangulate, but by a test that depends on where the origin
/// is: it loses part of concave faces. So faces are taken whole, in the order of the file.
struct Contents {
  std::vector<Vec3d> vertices;
  std::vector<std::vector<int>> faces;  // vertex indices, counted from 0

  void add_face(const tinyobj::index_t* indices, int count) {
    std::vector<int>& face = faces.emplace_back();
    for (int i = 0; i < count; ++i) {
      const int index = indices[i].vertex_index;  // from 1, or from -1 backwards
      face.push_back(index > 0 ? index - 1 : static_cast<int>(vertices.size()) + index);
    }
  }
};

Contents parse(const std::string& path, const std::string& text) {
  tinyobj::callback_t callbacks;
  callbacks.vertex_cb = [](void* contents, double x, double y, double z, double) {
    static_cast<Contents*>(contents)->vertices.emplace_back(x, y, z);
  };
  callbacks.index_cb = [](void* contents, tinyobj::index_t* indices, int count) {
    static_cast<Contents*>(contents)->add_face(indices, count);
  };
  Contents contents;
  std::istringstream stream(text);
  std::string error;
  if (!tinyobj::LoadObjWithCallback(stream, callbacks, &contents, nullptr, nullptr, &error)) {
    throw InputError(path, 0, 0, "the file cannot be read as .obj: " + error);
  }
  return contents;
}

std::string read_file(const std::string& path) {
  // A folder opens like a file and fails only when read.
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    throw InputError(path, 0, 0, "this is a folder; expected a Wavefront .obj file");
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(path, 0, 0, "the file cannot be opened; is its name right?");
  std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (text.empty()) throw InputError(path, 0, 0, "the file is empty; expected a Wavefront .obj");
  return text;
}

}  // namespace

std::vector<Vec3d> load_obj_vertices(const std::string& path) {
  const std::string text = read_file(path);
  check_obj(path, text);
  const Contents contents = parse(path, text);
  std::vector<bool> used(contents.vertices.size(), contents.faces.empty());
  for (const std::vector<int>& face : contents.faces) {
    for (const int vertex : face) used[static_cast<std::size_t>(vertex)] = true;
  }

  std::vector<Vec3d> points;
  std::map<std::tuple<double, double, double>, bool> seen;
  for (std::size_t i = 0; i < contents.vertices.size(); ++i) {
    const Vec3d& vertex = contents.vertices[i];
    if (used[i] && seen.try_emplace({vertex.x(), vertex.y(), vertex.z()}, true).second) {
      points.push_back(vertex);
    }
  }
  return points;
}

ObjMesh load_obj_mesh(const std::string& path) {
  const std::string text = read_file(path);
  const std::vector<int> lines = check_obj(path, text);
  Contents contents = parse(path, text);
  assert(lines.size() == contents.faces.size());
  if (contents.faces.empty()) {
    throw InputError(path, 0, 0,
                     "the file has no face; a mesh needs 'f' lines besides its 'v' lines");
  }

  ObjMesh mesh;
  mesh.vertices = std::move(contents.vertices);
  std::vector<Vec3d> corners;
  for (std::size_t i = 0; i < contents.faces.size(); ++i) {
    const std::vector<int>& face = contents.faces[i];
    if (face.size() < 3) {
      throw InputError(path, lines[i], 1,
                       "the face has " + std::to_string(face.size()) +
                           (face.size() == 1 ? " vertex" : " vertices") +
                           "; a face of a mesh has at least three");
    }
    corners.clear();
    for (const int vertex : face)
      corners.push_back(mesh.vertices[static_cast<std::size_t>(vertex)]);
    for (const std::array<int, 3>& ear : triangulate_polygon(corners)) {
      std::array<int, 3>& triangle = mesh.triangles.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) triangle[k] = face[static_cast<std::size_t>(ear[k])];
      mesh.lines.push_back(lines[i]);
    }
  }
  return mesh;
}

}  // namespace contactscope
