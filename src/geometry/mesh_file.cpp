#include "geometry/mesh_file.h"

#include "core/spell.h"
#include "geometry/mesh.h"
#include "geometry/mesh_contents.h"

namespace contactscope {
namespace {

struct Format {
  std::string_view extension;
  MeshContents (*read)(const std::string& path, const std::string& written);
};
constexpr std::array kFormats = {Format{".obj", read_obj}, Format{".stl", read_stl},
                                 Format{".ply", read_ply}, Format{".off", read_off}};

/// nullptr: none.
const Format* format_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  const auto* const found = std::ranges::find(kFormats, extension, &Format::extension);
  return found == kFormats.end() ? nullptr : found;
}

MeshContents read(const std::string& path) {
  const auto refuse = [&](const std::string& message) { throw InputError(path, 0, 0, message); };
  const std::string expected = "expected a mesh: .obj, .stl, .ply or .off";
  // A folder opens like a file and fails only when it is read.
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) refuse("this is a folder; " + expected);
  require_regular_file(path, expected);
  const Format* const format = format_of(path);
  if (format == nullptr) refuse("the file has another extension; " + expected);
  std::ifstream file(path, std::ios::binary);
  if (!file) refuse("the file cannot be opened; is its name right?");
  const std::string written{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (written.empty()) refuse("the file is empty; " + expected);
  MeshContents contents = format->read(path, written);
  if (contents.vertices.empty()) refuse("the file has no vertex; a shape needs some");
  for (std::size_t i = 0; i < contents.faces.size(); ++i)
    for (const int vertex : contents.faces[i])
      if (vertex < 0 || vertex >= count_of(contents.vertices))
        refuse("face " + std::to_string(i) + " names vertex " + std::to_string(vertex) +
               " from 0, but the file has " + std::to_string(contents.vertices.size()));
  return contents;
}

}  // namespace

bool is_mesh_file(const std::string& path) { return format_of(path) != nullptr; }

std::vector<Vec3d> load_vertices(const std::string& path) {
  const MeshContents contents = read(path);
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

FileMesh load_mesh(const std::string& path) {
  MeshContents contents = read(path);
  if (contents.faces.empty())
    throw InputError(path, 0, 0, "the file has no face; a mesh needs faces as well as vertices");
  FileMesh mesh;
  mesh.vertices = std::move(contents.vertices);
  for (std::size_t i = 0; i < contents.faces.size(); ++i) {
    const std::vector<int>& face = contents.faces[i];
    if (face.size() < 3)
      throw InputError(path, contents.lines.empty() ? 0 : contents.lines[i], 1,
                       "the face has " + counted(face.size(), "vertex", "vertices") +
                           "; a face of a mesh has at least three");
    const auto place = [&](int vertex) { return at(mesh.vertices, vertex); };
    for (const std::array<int, 3>& ear : triangulate_polygon(mapped(face, place)))
      mesh.triangles.push_back({at(face, ear[0]), at(face, ear[1]), at(face, ear[2])});
  }
  return mesh;
}

// ---- Words of a text

std::string_view FileWords::next() {
  constexpr std::string_view kBlank = " \t\r\n\f\v";
  for (;;) {
    word_ = std::min(text_.find_first_not_of(kBlank, at_), text_.size());
    if (word_ == text_.size() || text_[word_] != '#') break;
    at_ = word_, skip_line();
  }
  at_ = std::min(text_.find_first_of(kBlank, word_), text_.size());
  return text_.substr(word_, at_ - word_);
}

std::size_t FileWords::skip_line() {
  return at_ = std::min(text_.find('\n', at_), text_.size() - 1) + 1;
}

double FileWords::number(const char* what) {
  std::string_view word = next();
  const std::string read = word.empty() ? " is missing" : " is " + quoted(word);
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size() || !std::isfinite(value))
    fail(what + read + "; expected a finite number");
  return value;
}

int FileWords::count(const char* what) {
  const double value = number(what);
  if (!(value >= 0 && value <= 2e9) || value != std::floor(value))
    fail(std::string(what) + " is no whole number from 0");
  return static_cast<int>(value);
}

void FileWords::fail(const std::string& message) const {
  const std::string_view before = text_.substr(0, word_);
  const auto line = 1 + std::ranges::count(before, '\n');
  const std::size_t begin = before.rfind('\n') + 1;  // npos + 1 is 0
  throw InputError(path_, static_cast<int>(line), static_cast<int>(word_ - begin) + 1, message);
}

std::string FileWords::quoted(std::string_view word) {
  std::string shown = "'";
  for (const char c : word.substr(0, 24)) shown += c >= ' ' && c <= '~' ? c : '?';
  return shown + (word.size() > 24 ? "...'" : "'");
}

}  // namespace contactscope
