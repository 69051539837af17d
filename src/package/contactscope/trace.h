#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "manifold.h"
#include "shape.h"

/// Traces: JSON lines with the facts of each frame, ours or another engine's.
namespace contactscope::package {

/// A file, or a text that was given as one, is wrong. what() is "FILE:LINE:COLUMN: what is wrong, and what
/// would be right".
class InputError : public std::runtime_error {
 public:
  InputError(const std::string& what, std::string file, int line, int column, std::string remedy)
      : std::runtime_error(what),
        file_(std::move(file)),
        remedy_(std::move(remedy)),
        line_(line),
        column_(column) {}

  const std::string& file() const { return file_; }
  int line() const { return line_; }      // from 1; 0: of the file as a whole
  int column() const { return column_; }  // likewise
  /// What would be right; empty where the message has it among its words.
  const std::string& remedy() const { return remedy_; }

 private:
  std::string file_, remedy_;
  int line_, column_;
};

/// The head of a trace.
struct TraceInfo {
  std::string scenario = "mine/contacts";  // GROUP/IDEA: where pictures and snapshots go
  std::string title{}, source{};           // above and below each picture
  Scalar scalar = Scalar::Double;          // what the pipeline computed with
  std::string up = "y";                    // or "z"
  std::string engine{}, version{};         // who made the contacts; empty: this library
};

struct NamedShape {
  std::string name;
  Shape shape;
};

struct NamedPose {
  std::string name;  // of a shape
  Pose pose{};
};

/// Two shapes, and their contacts.
struct Pair {
  std::string a{}, b{};  // names of shapes
  std::vector<Manifold> manifolds{};
};

struct Frame {
  int number = 0;
  double time = 0;                 // seconds
  std::vector<NamedPose> poses{};  // of each shape that is there
  std::vector<Pair> pairs{};
};

/// A trace, whole. It holds all facts of its file, of which Frame tells the contacts alone. Copies share
/// them.
class Trace {
 public:
  Trace();  // without shapes and frames

  /// From plain data. Throws InputError, of a file "trace", where it does not fit together: a pair of
  /// shapes that are not there, a normal that is no unit vector, frames that do not rise.
  Trace(const TraceInfo& info, const std::vector<NamedShape>& shapes,
        const std::vector<Frame>& frames);

  TraceInfo info() const;
  std::vector<std::string> shapes() const;  // their names
  int frame_count() const;
  Frame frame(int index) const;  // 0 <= index < frame_count()

  /// The line of its file that is cut off, because the process that wrote it died: all before it was read. 0 where
  /// the file is whole.
  int cut_off_in() const;

  struct Facts;
  explicit Trace(std::shared_ptr<const Facts> facts) : facts_(std::move(facts)) {}
  const Facts& facts() const { return *facts_; }

 private:
  std::shared_ptr<const Facts> facts_;
};

/// Reads a file, ours or another engine's; "-" is the standard input. Throws InputError.
Trace read_trace(const std::string& path);

/// The same of text. `name` stands for the file in messages.
Trace parse_trace(const std::string& text, const std::string& name = "trace");

/// One line for the head, one a frame. Throws std::domain_error of a number that is not finite.
std::string to_json_lines(const Trace& trace);

/// Writes a file that is whole or absent, and the folders above it. Throws
/// std::filesystem::filesystem_error, and std::domain_error as above.
void write_trace(const std::string& path, const Trace& trace);

}  // namespace contactscope::package
