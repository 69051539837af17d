#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "manifold.h"
#include "shape.h"

/// Traces: JSON lines with the facts of each frame, from contactscope or another engine.
namespace contactscope::package {

/// Invalid file or text. what() is "FILE:LINE:COLUMN: problem; remedy".
class InputError : public std::runtime_error {
 public:
  InputError(const std::string& what, std::string file, int line, int column, std::string remedy)
      : std::runtime_error(what),
        file_(std::move(file)),
        remedy_(std::move(remedy)),
        line_(line),
        column_(column) {}

  const std::string& file() const { return file_; }
  int line() const { return line_; }      // from 1; 0: the whole file
  int column() const { return column_; }  // as line()
  /// Empty if the message contains it without a separator.
  const std::string& remedy() const { return remedy_; }

 private:
  std::string file_, remedy_;
  int line_, column_;
};

/// The header of a trace.
struct TraceInfo {
  std::string scenario = "mine/contacts";  // GROUP/IDEA: folder of pictures and snapshots
  std::string title{}, source{};           // text above and below each picture
  Scalar scalar = Scalar::Double;          // precision of the pipeline
  std::string up = "y";                    // or "z"
  std::string engine{}, version{};         // source of the contacts; empty: this library
};

struct NamedShape {
  std::string name;
  Shape shape;
};

struct NamedPose {
  std::string name;  // name of a shape
  Pose pose{};
};

struct Pair {
  std::string a{}, b{};  // names of the shapes
  std::vector<Manifold> manifolds{};
};

struct Frame {
  int number = 0;
  double time = 0;                 // seconds
  std::vector<NamedPose> poses{};  // of each shape in the frame
  std::vector<Pair> pairs{};
};

/// A complete trace with all facts of its file (Frame has only the contacts). Copies share them.
class Trace {
 public:
  Trace();  // no shapes, no frames

  /// Throws InputError with the file name "trace" if the data is inconsistent: unknown shapes in a
  /// pair, a normal that is not unit, frame numbers that do not increase.
  Trace(const TraceInfo& info, const std::vector<NamedShape>& shapes,
        const std::vector<Frame>& frames);

  TraceInfo info() const;
  std::vector<std::string> shapes() const;  // names
  int frame_count() const;
  Frame frame(int index) const;  // 0 <= index < frame_count()

  /// Line at which the file breaks off because its writer died; 0 if the file is complete.
  int cut_off_in() const;

  struct Facts;
  explicit Trace(std::shared_ptr<const Facts> facts) : facts_(std::move(facts)) {}
  const Facts& facts() const { return *facts_; }

 private:
  std::shared_ptr<const Facts> facts_;
};

/// Reads a file of contactscope or another engine; "-" is standard input. Throws InputError.
Trace read_trace(const std::string& path);

/// Reads from text. `name` replaces the file name in messages.
Trace parse_trace(const std::string& text, const std::string& name = "trace");

/// One line for the header, one per frame. Throws std::domain_error for nan and infinity.
std::string to_json_lines(const Trace& trace);

/// Creates missing folders; the file is complete or absent. Throws
/// std::filesystem::filesystem_error, and std::domain_error as above.
void write_trace(const std::string& path, const Trace& trace);

}  // namespace contactscope::package
