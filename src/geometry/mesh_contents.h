#pragma once

#include "core/vec3.h"

/// Readers of mesh files, one for each format. They throw InputError, with line and column in texts.
namespace contactscope {

/// Cutting a face with more corners into triangles would take minutes.
inline constexpr std::size_t kMaxCorners = 10'000;

struct MeshContents {
  std::vector<Vec3d> vertices;          // finite
  std::vector<std::vector<int>> faces;  // vertex indices from 0, in file order
  std::vector<int> lines{};             // of the faces, from 1; empty: unknown
};

/// Wavefront .obj. A backslash at the end of a line joins it with the next one.
MeshContents read_obj(const std::string& path, const std::string& written);
/// STL, as text or binary. Equal vertices are one.
MeshContents read_stl(const std::string& path, const std::string& written);
/// Object File Format of Geomview, as text.
MeshContents read_off(const std::string& path, const std::string& written);
/// PLY (Turk 1994), as text or binary. Reads the elements vertex and face.
MeshContents read_ply(const std::string& path, const std::string& written);

/// The words of a text with '#' comments.
class FileWords {
 public:
  /// Both outlive it.
  FileWords(const std::string& path, std::string_view text) : path_(path), text_(text) {}

  /// Empty at the end.
  std::string_view next();
  /// Goes to the next line, and returns where it begins.
  std::size_t skip_line();
  /// The next word as a finite number; `what`: "a coordinate".
  double number(const char* what);
  /// The next word as a whole number from 0.
  int count(const char* what);
  /// Throws an error at the last word.
  [[noreturn]] void fail(const std::string& message) const;

  /// A word for a message: no control characters, no foreign bytes, limited length.
  static std::string quoted(std::string_view word);

 private:
  const std::string& path_;
  std::string_view text_;
  std::size_t at_ = 0, word_ = 0;
};

}  // namespace contactscope
