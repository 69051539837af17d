#include "geometry/obj.h"

#include <tiny_obj_loader.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <string_view>
#include <system_error>
#include <tuple>
#include <utility>

#include "core/at.h"
#include "core/input_error.h"
#include "geometry/triangulate.h"

namespace contactscope {
namespace {

/// Statements of the format's specification (Wavefront, "Object Files", version 3.0). A line that
/// opens with anything else means that the file is not .obj at all.
constexpr std::array<std::string_view, 46> kStatements = {
    "v",        "vt",   "vn",         "vp",        "f",      "fo",     "l",      "p",
    "o",        "g",    "s",          "mg",        "usemtl", "mtllib", "usemap", "maplib",
    "cstype",   "deg",  "bmat",       "step",      "curv",   "curv2",  "surf",   "parm",
    "trim",     "hole", "scrv",       "sp",        "end",    "con",    "bevel",  "c_interp",
    "d_interp", "lod",  "shadow_obj", "trace_obj", "ctech",  "stech",  "call",   "csh",
    "bsp",      "bzp",  "cdc",        "cdp",       "res",    "vw"};

/// What a file has.
struct Contents {
  std::vector<Vec3d> vertices;
  std::vector<std::vector<int>> faces;  // vertex indices, counted from 0, in the order of the file
  std::vector<int> lines;               // of each face, from 1
};

/// tinyobjloader reads what it can and takes the rest as zero; this pass over the same text finds
/// what it would pass over: a vertex without three finite numbers, a face that names a vertex that
/// does not exist. It reads the faces as well, whole: tinyobjloader can triangulate, but by a test that
/// depends on where the origin is, which loses part of concave faces.
class Checker {
 public:
  Checker(const std::string& path, std::string_view text) : path_(path), text_(text) {}

  /// Throws InputError with line and column, or returns the faces and their lines.
  Contents run() {
    while (next_line()) {
      const std::string_view statement = next_word();
      if (statement.empty() || statement[0] == '#') continue;
      if (std::ranges::find(kStatements, statement) == kStatements.end()) {
        if (continued_) continue;
        fail(quoted(statement) +
             " opens no statement of the .obj format; expected v, f or another keyword of it");
      }
      if (statement == "v") check_vertex();
      if (statement == "f") check_face();
    }
    if (vertices_ == 0) {
      throw InputError(path_, 0, 0, "the file has no vertex; a shape needs 'v x y z' lines");
    }
    if (largest_index_ > vertices_) {
      throw InputError(path_, line_of_largest_, 1,
                       "the face names vertex " + std::to_string(largest_index_) +
                           ", but the file has " + std::to_string(vertices_));
    }
    return std::move(contents_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(path_, line_number_, column_, message);
  }

  bool next_line() {
    if (at_ >= text_.size()) return false;
    const std::size_t end = std::min(text_.find_first_of("\r\n", at_), text_.size());
    continued_ = !line_.empty() && line_.back() == '\\';
    line_ = text_.substr(at_, end - at_);
    at_ = end + (text_.substr(end, 2) == "\r\n" ? 2 : 1);
    in_line_ = 0;
    ++line_number_;
    return true;
  }

  std::string_view next_word() {
    const std::size_t begin = std::min(line_.find_first_not_of(" \t", in_line_), line_.size());
    in_line_ = std::min(line_.find_first_of(" \t", begin), line_.size());
    column_ = static_cast<int>(begin) + 1;
    return line_.substr(begin, in_line_ - begin);
  }

  void check_vertex() {
    for (const char* axis : {"x", "y", "z"}) {
      std::string_view word = next_word();
      if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
      double value = 0;
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
      if (error != std::errc{} || end != word.data() + word.size() || !std::isfinite(value)) {
        fail(std::string("the vertex's ") + axis +
             (word.empty() ? " is missing" : " is " + quoted(word)) +
             "; a vertex is 'v' and three finite numbers");
      }
    }
    ++vertices_;
  }

  void check_face() {
    contents_.lines.push_back(line_number_);
    std::vector<int>& face = contents_.faces.emplace_back();
    std::string_view word = next_word();
    if (word.empty()) fail("the face has no vertex; a face is 'f' and at least three of them");
    for (; !word.empty(); word = next_word()) {
      if (word == "\\") fail("the face goes on on the next line; put it on one line");
      long index = 0;
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), index);
      const bool number_ends = end == word.data() + word.size() || *end == '/';
      if (error != std::errc{} || !number_ends || index == 0 || index < -vertices_) {
        fail(quoted(word) + " names no vertex; vertices count from 1, or from -1 backwards");
      }
      face.push_back(static_cast<int>(index > 0 ? index - 1 : vertices_ + index));
      if (index > largest_index_) {
        largest_index_ = index;
        line_of_largest_ = line_number_;
      }
    }
  }

  /// What of a word a message can show: no control characters, no foreign bytes, not too long.
  static std::string quoted(std::string_view word) {
    std::string shown = "'";
    for (const char c : word.substr(0, 24)) shown += c >= ' ' && c <= '~' ? c : '?';
    if (word.size() > 24) shown += "...";
    shown += "'";
    return shown;
  }

  std::string path_;
  std::string_view text_;
  std::size_t at_ = 0;
  std::string_view line_;
  std::size_t in_line_ = 0;
  int line_number_ = 0;
  int column_ = 1;
  bool continued_ = false;
  long vertices_ = 0;
  long largest_index_ = 0;
  int line_of_largest_ = 0;
  Contents contents_;
};

Contents read(const std::string& path) {
  const auto refuse = [&](const std::string& message) { throw InputError(path, 0, 0, message); };
  // A folder opens like a file and fails only when read.
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    refuse("this is a folder; expected a Wavefront .obj file");
  std::ifstream file(path, std::ios::binary);
  if (!file) refuse("the file cannot be opened; is its name right?");
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (text.empty()) refuse("the file is empty; expected a Wavefront .obj");

  Contents contents = Checker(path, text).run();
  tinyobj::callback_t callbacks;
  callbacks.vertex_cb = [](void* to, double x, double y, double z, double) {
    static_cast<Contents*>(to)->vertices.emplace_back(x, y, z);
  };
  std::istringstream stream(text);
  std::string error;
  if (!tinyobj::LoadObjWithCallback(stream, callbacks, &contents, nullptr, nullptr, &error))
    refuse("the file cannot be read as .obj: " + error);
  return contents;
}

}  // namespace

std::vector<Vec3d> load_obj_vertices(const std::string& path) {
  const Contents contents = read(path);
  std::vector<bool> used(contents.vertices.size(), contents.faces.empty());
  for (const std::vector<int>& face : contents.faces) {
    for (const int vertex : face) at(used, vertex) = true;
  }

  std::vector<Vec3d> points;
  std::set<std::tuple<double, double, double>> seen;
  for (std::size_t i = 0; i < contents.vertices.size(); ++i) {
    const Vec3d& vertex = contents.vertices[i];
    if (used[i] && seen.emplace(vertex.x(), vertex.y(), vertex.z()).second)
      points.push_back(vertex);
  }
  return points;
}

ObjMesh load_obj_mesh(const std::string& path) {
  Contents contents = read(path);
  if (contents.faces.empty()) {
    throw InputError(path, 0, 0,
                     "the file has no face; a mesh needs 'f' lines besides its 'v' lines");
  }

  ObjMesh mesh;
  mesh.vertices = std::move(contents.vertices);
  for (std::size_t i = 0; i < contents.faces.size(); ++i) {
    const std::vector<int>& face = contents.faces[i];
    if (face.size() < 3) {
      throw InputError(path, contents.lines[i], 1,
                       "the face has " + std::to_string(face.size()) +
                           (face.size() == 1 ? " vertex" : " vertices") +
                           "; a face of a mesh has at least three");
    }
    const auto place = [&](int vertex) { return at(mesh.vertices, vertex); };
    for (const std::array<int, 3>& ear : triangulate_polygon(mapped(face, place)))
      mesh.triangles.push_back({at(face, ear[0]), at(face, ear[1]), at(face, ear[2])});
  }
  return mesh;
}

}  // namespace contactscope
