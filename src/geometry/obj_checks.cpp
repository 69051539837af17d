#include "geometry/obj_checks.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <system_error>
#include <utility>

#include "core/input_error.h"

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

/// tinyobjloader reads what it can and takes the rest as zero; this pass over the same text finds
/// what it would pass over, with its line.
class Checker {
 public:
  Checker(const std::string& path, std::string_view text) : path_(path), text_(text) {}

  /// Throws, or returns the line of each face.
  std::vector<int> run() {
    while (next_line()) {
      const std::string_view statement = next_word();
      if (statement.empty() || statement[0] == '#') continue;
      if (std::find(kStatements.begin(), kStatements.end(), statement) == kStatements.end()) {
        if (continued_) continue;
        fail(quoted(statement) +
             " opens no statement of the .obj format; expected v, f "
             "or another keyword of it");
      }
      if (statement == "v") check_vertex();
      if (statement == "f") check_face();
    }
    if (vertices_ == 0) {
      throw InputError(path_, 0, 0, "the file has no vertex; a shape needs 'v x y z' lines");
    }
    if (largest_index_ > vertices_) {
      line_number_ = line_of_largest_;
      column_ = 1;
      fail("the face names vertex " + std::to_string(largest_index_) + ", but the file has " +
           std::to_string(vertices_));
    }
    return std::move(face_lines_);
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
    face_lines_.push_back(line_number_);
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
  std::vector<int> face_lines_;
};

}  // namespace

std::vector<int> check_obj(const std::string& path, std::string_view text) {
  return Checker(path, text).run();
}

}  // namespace contactscope
