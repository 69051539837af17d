#include "core/input_error.h"
#include "geometry/mesh_contents.h"

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

/// Reads vertices and faces, and names what is wrong by its place: a vertex without three finite
/// numbers, a face with vertices that do not exist, a line of another format.
class Reader {
 public:
  /// `text`: with continued lines joined by join_lines(), which keeps every byte's position;
  /// `written`: the original text, for line and column numbers.
  Reader(const std::string& path, std::string_view text, std::string_view written)
      : path_(path), text_(text), written_(written) {}

  /// Throws InputError with line and column.
  MeshContents run() {
    while (next_line()) {
      const std::string_view statement = next_word();
      if (statement.empty() || statement[0] == '#') continue;
      if (std::ranges::find(kStatements, statement) == kStatements.end()) {
        fail(FileWords::quoted(statement) +
             " is not a keyword of the .obj format; expected v, f or another one");
      }
      if (statement == "v") read_vertex();
      if (statement == "f") read_face();
    }
    if (vertices_ == 0)
      throw InputError(path_, 0, 0, "the file has no vertex; a shape needs 'v x y z' lines");
    if (largest_index_ > vertices_) {
      throw InputError(path_, line_of_largest_, 1,
                       "the face names vertex " + std::to_string(largest_index_) +
                           ", but the file has " + std::to_string(vertices_));
    }
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

  void read_vertex() {
    Vec3d& vertex = contents_.vertices.emplace_back();
    for (const int axis : {0, 1, 2}) {
      std::string_view word = next_word();
      if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
      double value = 0;
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
      if (error != std::errc{} || end != word.data() + word.size() || !std::isfinite(value)) {
        fail(std::string("the vertex's ") + "xyz"[axis] +
             (word.empty() ? " is missing" : " is " + FileWords::quoted(word)) +
             "; a vertex is 'v' and three finite numbers");
      }
      vertex[axis] = value;
    }
    ++vertices_;
  }

  void read_face() {
    contents_.lines.push_back(line_number_);
    std::vector<int>& face = contents_.faces.emplace_back();
    std::string_view word = next_word();
    if (word.empty()) fail("the face has no vertex; a face is 'f' and at least three of them");
    for (; !word.empty(); word = next_word()) {
      long index = 0;
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), index);
      const bool number_ends = end == word.data() + word.size() || *end == '/';
      if (error != std::errc{} || !number_ends || index == 0 || index < -vertices_)
        fail(FileWords::quoted(word) +
             " names no vertex; vertices count from 1, or from -1 backwards");
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
  MeshContents contents_;
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

}  // namespace

MeshContents read_obj(const std::string& path, const std::string& written) {
  const std::string text = join_lines(written);
  return Reader(path, text, written).run();
}

}  // namespace contactscope
