#include "geometry/obj.h"

#include <tiny_obj_loader.h>

#include <charconv>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>

#include "core/input_error.h"
#include "core/spell.h"
#include "geometry/triangulate.h"

namespace contactscope {
namespace {

/// Statements of the format's specification (Wavefront, "Object Files", version 3.0). A line that
/// starts with anything else means that the file is not .obj.
constexpr std::array<std::string_view, 46> kStatements = {
    "v",        "vt",   "vn",         "vp",        "f",      "fo",     "l",      "p",
    "o",        "g",    "s",          "mg",        "usemtl", "mtllib", "usemap", "maplib",
    "cstype",   "deg",  "bmat",       "step",      "curv",   "curv2",  "surf",   "parm",
    "trim",     "hole", "scrv",       "sp",        "end",    "con",    "bevel",  "c_interp",
    "d_interp", "lod",  "shadow_obj", "trace_obj", "ctech",  "stech",  "call",   "csh",
    "bsp",      "bzp",  "cdc",        "cdp",       "res",    "vw"};

/// Cutting a face with more corners into triangles would take minutes.
constexpr std::size_t kMaxCorners = 10'000;

struct Contents {
  std::vector<Vec3d> vertices;
  std::vector<std::vector<int>> faces;  // vertex indices from 0, in file order
  std::vector<int> lines;               // line of each face, from 1
};

/// Validates what tinyobjloader silently replaces by zero: vertices without three finite numbers,
/// faces with vertices that do not exist. Also reads whole faces: its triangulation depends on the
/// position of the origin and loses parts of concave faces.
class Checker {
 public:
  /// `text`: with continued lines joined by join_lines(), which keeps every byte's position;
  /// `written`: the original text, for line and column numbers.
  Checker(const std::string& path, std::string_view text, std::string_view written)
      : path_(path), text_(text), written_(written) {}

  /// Returns the faces and their lines. Throws InputError with line and column.
  Contents run() {
    while (next_line()) {
      const std::string_view statement = next_word();
      if (statement.empty() || statement[0] == '#') continue;
      if (std::ranges::find(kStatements, statement) == kStatements.end())
        fail(quoted(statement) +
             " is not a keyword of the .obj format; expected v, f or another one");
      if (statement == "v") check_vertex();
      if (statement == "f") check_face();
    }
    if (vertices_ == 0)
      throw InputError(path_, 0, 0, "the file has no vertex; a shape needs 'v x y z' lines");
    if (largest_index_ > vertices_)
      throw InputError(path_, line_of_largest_, 1,
                       "the face names vertex " + std::to_string(largest_index_) +
                           ", but the file has " + std::to_string(vertices_));
    return std::move(contents_);
  }

 private:
  /// Throws an error at the last word read.
  [[noreturn]] void fail(const std::string& message) const {
    int line = line_number_;
    std::size_t begin = line_begin_;
    for (std::size_t end = begin; (end = end_of_line(end)) <= word_; begin = end) ++line;
    throw InputError(path_, line, static_cast<int>(word_ - begin) + 1, message);
  }

  /// End of the line of the original text that contains `at`, including its line break.
  std::size_t end_of_line(std::size_t at) const {
    const std::size_t end = std::min(written_.find_first_of("\r\n", at), written_.size());
    return end + (written_.substr(end, 2) == "\r\n" ? 2 : 1);
  }

  bool next_line() {
    // Count joined lines as well.
    for (; line_begin_ < at_; line_begin_ = end_of_line(line_begin_)) ++line_number_;
    if (at_ >= text_.size()) return false;
    const std::size_t end = std::min(text_.find_first_of("\r\n", at_), text_.size());
    line_ = text_.substr(at_, end - at_);
    at_ = end + (text_.substr(end, 2) == "\r\n" ? 2 : 1);
    in_line_ = 0;
    return true;
  }

  std::string_view next_word() {
    const std::size_t begin = std::min(line_.find_first_not_of(" \t", in_line_), line_.size());
    in_line_ = std::min(line_.find_first_of(" \t", begin), line_.size());
    word_ = line_begin_ + begin;
    return line_.substr(begin, in_line_ - begin);
  }

  void check_vertex() {
    for (const char* axis : {"x", "y", "z"}) {
      std::string_view word = next_word();
      if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
      double value = 0;
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
      if (error != std::errc{} || end != word.data() + word.size() || !std::isfinite(value))
        fail(std::string("the vertex's ") + axis +
             (word.empty() ? " is missing" : " is " + quoted(word)) +
             "; a vertex is 'v' and three finite numbers");
    }
    ++vertices_;
  }

  void check_face() {
    contents_.lines.push_back(line_number_);
    std::vector<int>& face = contents_.faces.emplace_back();
    std::string_view word = next_word();
    if (word.empty()) fail("the face has no vertex; a face is 'f' and at least three of them");
    for (; !word.empty(); word = next_word()) {
      long index = 0;
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), index);
      const bool number_ends = end == word.data() + word.size() || *end == '/';
      if (error != std::errc{} || !number_ends || index == 0 || index < -vertices_)
        fail(quoted(word) + " names no vertex; vertices count from 1, or from -1 backwards");
      if (face.size() == kMaxCorners)
        fail("the face has more than " + std::to_string(kMaxCorners) +
             " corners; split it into faces");
      face.push_back(static_cast<int>(index > 0 ? index - 1 : vertices_ + index));
      if (index > largest_index_) {
        largest_index_ = index;
        line_of_largest_ = line_number_;
      }
    }
  }

  /// Sanitizes a word for a message: no control characters, no foreign bytes, limited length.
  static std::string quoted(std::string_view word) {
    std::string shown = "'";
    for (const char c : word.substr(0, 24)) shown += c >= ' ' && c <= '~' ? c : '?';
    if (word.size() > 24) shown += "...";
    shown += "'";
    return shown;
  }

  std::string path_;
  std::string_view text_, written_;
  std::size_t at_ = 0;
  std::string_view line_;
  std::size_t in_line_ = 0;
  std::size_t line_begin_ = 0, word_ = 0;  // in the original text
  int line_number_ = 1;                    // line at line_begin_
  long vertices_ = 0;
  long largest_index_ = 0;
  int line_of_largest_ = 0;
  Contents contents_;
};

/// Joins each line that ends in a backslash with the next one; both characters become blanks.
/// Comments are not joined, as they may end in a Windows path.
std::string join_lines(std::string text) {
  for (std::size_t line = 0; line < text.size();) {
    const std::size_t first = std::min(text.find_first_not_of(" \t", line), text.size() - 1);
    std::size_t end = text.find_first_of("\r\n", line);
    while (end != std::string::npos && end > line && text[end - 1] == '\\' && text[first] != '#') {
      const std::size_t width = text.compare(end, 2, "\r\n") == 0 ? 3 : 2;
      text.replace(end - 1, width, width, ' ');
      end = text.find_first_of("\r\n", end);
    }
    line = std::max(end, end + 1);  // npos stays npos
  }
  return text;
}

Contents read(const std::string& path) {
  const auto refuse = [&](const std::string& message) { throw InputError(path, 0, 0, message); };
  // A folder opens like a file and fails only when it is read.
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    refuse("this is a folder; expected a Wavefront .obj file");
  require_regular_file(path, "expected a Wavefront .obj file");
  std::ifstream file(path, std::ios::binary);
  if (!file) refuse("the file cannot be opened; is its name right?");
  const std::string written{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (written.empty()) refuse("the file is empty; expected a Wavefront .obj");
  const std::string text = join_lines(written);
  Contents contents = Checker(path, text, written).run();
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
  for (const std::vector<int>& face : contents.faces)
    for (const int vertex : face) at(used, vertex) = true;
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
  if (contents.faces.empty())
    throw InputError(path, 0, 0,
                     "the file has no face; a mesh needs 'f' lines as well as 'v' lines");
  ObjMesh mesh;
  mesh.vertices = std::move(contents.vertices);
  for (std::size_t i = 0; i < contents.faces.size(); ++i) {
    const std::vector<int>& face = contents.faces[i];
    if (face.size() < 3)
      throw InputError(path, contents.lines[i], 1,
                       "the face has " + counted(face.size(), "vertex", "vertices") +
                           "; a face of a mesh has at least three");
    const auto place = [&](int vertex) { return at(mesh.vertices, vertex); };
    for (const std::array<int, 3>& ear : triangulate_polygon(mapped(face, place)))
      mesh.triangles.push_back({at(face, ear[0]), at(face, ear[1]), at(face, ear[2])});
  }
  return mesh;
}

}  // namespace contactscope
