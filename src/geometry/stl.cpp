#include "core/input_error.h"
#include "geometry/mesh_contents.h"

namespace contactscope {
namespace {

/// Faces of corners in any order, each vertex once.
class Welded {
 public:
  void add(const Vec3d& corner) {
    const auto [entry, is_new] =
        known_.try_emplace({corner.x(), corner.y(), corner.z()}, count_of(contents.vertices));
    if (is_new) contents.vertices.push_back(corner);
    contents.faces.back().push_back(entry->second);
  }

  MeshContents contents;

 private:
  std::map<std::array<double, 3>, int> known_;
};

/// Eighty bytes, the number of triangles, and for each its normal, three corners and two bytes.
MeshContents read_binary(const std::string& path, const std::string& bytes) {
  constexpr std::size_t kHeader = 84, kTriangle = 50, kNormal = 12;
  Welded welded;
  for (std::size_t begin = kHeader; begin < bytes.size(); begin += kTriangle) {
    std::array<float, 9> corners{};
    std::memcpy(corners.data(), bytes.data() + begin + kNormal, sizeof corners);
    if (!std::ranges::all_of(corners, [](float x) { return std::isfinite(x); }))
      throw InputError(path, 0, 0,
                       "a corner of triangle " + std::to_string(welded.contents.faces.size()) +
                           " is not finite");
    welded.contents.faces.emplace_back();
    for (std::size_t k = 0; k < 9; k += 3)
      welded.add(Vec3d(corners[k], corners[k + 1], corners[k + 2]));
  }
  return std::move(welded.contents);
}

}  // namespace

MeshContents read_stl(const std::string& path, const std::string& written) {
  if (foreign_format(std::string_view(written).substr(0, 84), written.size()) == "binary STL")
    return read_binary(path, written);
  FileWords words(path, written);
  Welded welded;
  if (words.next() != "solid")
    words.fail(
        "the file is no STL: as a text it begins with 'solid', and with binary triangles it "
        "has 84 bytes and 50 for each");
  words.skip_line();
  for (std::string_view word; !(word = words.next()).empty();) {
    if (word == "vertex") {
      if (welded.contents.faces.empty()) words.fail("a vertex comes after 'outer loop'");
      const double x = words.number("x"), y = words.number("y");
      welded.add({x, y, words.number("z")});
      if (welded.contents.faces.back().size() > kMaxCorners)
        words.fail("the loop has too many corners; split it into facets");
    } else if (word == "outer") {
      welded.contents.faces.emplace_back();
    } else if (word == "facet" || word == "solid" || word == "endsolid") {
      words.skip_line();  // a normal, a name
    } else if (word != "loop" && word != "endloop" && word != "endfacet") {
      words.fail(FileWords::quoted(word) +
                 " is no word of STL; expected facet, outer loop, vertex or their ends");
    }
  }
  return std::move(welded.contents);
}

MeshContents read_off(const std::string& path, const std::string& written) {
  FileWords words(path, written);
  const std::string_view kind = words.next();
  if (!kind.ends_with("OFF") || kind.find_first_not_of("STCN") + 3 != kind.size())
    words.fail("an .off file begins with 'OFF', or 'COFF' with colours or 'NOFF' with normals");
  const int vertices = words.count("the number of vertices");
  const int faces = words.count("the number of faces");
  words.count("the number of edges");
  MeshContents contents;
  for (int i = 0; i < vertices; ++i) {
    const double x = words.number("x"), y = words.number("y");
    contents.vertices.emplace_back(x, y, words.number("z"));
    if (kind != "OFF") words.skip_line();  // its colour, normal, texture coordinates
  }
  for (int i = 0; i < faces; ++i) {
    std::vector<int>& face = contents.faces.emplace_back();
    const int corners = words.count("the number of corners");
    if (std::size_t(corners) > kMaxCorners) words.fail("the face has too many corners; split it");
    for (int k = 0; k < corners; ++k) face.push_back(words.count("a vertex"));
    words.skip_line();  // a colour
  }
  return contents;
}

}  // namespace contactscope
