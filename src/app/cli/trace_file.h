#pragma once

#include "trace/read_trace.h"

namespace contactscope::app {

/// True for a trace rather than a scenario: the name is *.jsonl or "-" (standard input), or the
/// text starts with '{', which TOML never does. False if the file does not exist.
bool is_trace_file(const std::string& path);

/// Remedy for a file in a known but unsupported format, see foreign_format_remedy(); else empty.
std::string foreign_in(const std::string& path);
/// Whether a file is MJCF, URDF or SDF, or a scene of meshes: glTF, COLLADA or 3MF.
bool is_model(const std::string& path);

/// Validates the consistency of a trace, one frame at a time.
class TraceChecks {
 public:
  /// Problem and remedy.
  struct Wrong {
    std::string text;
  };

  /// Adds convex hull faces to hulls without faces. Keeps a reference to header. Throws Wrong with
  /// `problems`, those of reading it, and all others, each in a line; the second and further ones
  /// have `place` in front.
  TraceChecks(trace::Header& header, const std::string& place, std::vector<std::string> problems);

  /// Checks the next frame and adds its shapes to the header. Throws Wrong.
  void frame(trace::Frame& frame);
  /// Only its shapes.
  void shapes(trace::Frame& frame);

  int last_frame() const { return last_; }

 private:
  void add(trace::Shape shape);
  void facts(const trace::Frame& frame) const;
  void pair(std::size_t index, const trace::Pair& pair) const;
  /// `place` returns a text for where the name is used.
  template <class Place>
  const trace::Shape& named(const std::string& name, const Place& place) const;

  trace::Header& header_;
  std::unordered_map<std::string, std::size_t> places_;  // index of each shape in the header
  int last_ = -1;                                        // frame number
};

/// A trace of contactscope or another engine, read and checked frame by frame; "-" is standard
/// input. Every function throws InputError with line and remedy if the trace is unreadable or
/// inconsistent: a shape without vertices, a frame without a pose of each shape, a pair of unknown
/// shapes, a normal that is not unit, or an index beyond a shape's faces.
class TraceFile {
 public:
  enum class Passes { One, Several };

  /// Reads the header. For several passes, standard input is copied to a temporary file.
  explicit TraceFile(const std::string& path, Passes passes = Passes::One);
  /// Reads from text; `name` is its name in messages.
  TraceFile(std::unique_ptr<std::istream> text, const std::string& name);

  TraceFile& operator=(TraceFile&&) = delete;

  /// Name in messages.
  const std::string& name() const { return name_; }
  /// Hulls have faces, and shapes of the frames so far are included. `impulses` is unset: frames
  /// have newton seconds on b. `frames` may be 0 until the last frame was read.
  const trace::Header& header() const { return header_; }

  /// Nullopt after the last frame; there is at least one.
  std::optional<trace::Frame> next();
  /// Some of the next frames, of each only these parts, parsed on several threads; empty after the
  /// last one. Only their form and new shapes are checked. `impulses` are converted.
  std::vector<trace::Frame> next(const trace::Parts& parts, Workers& workers);
  /// Reads frames without checks.
  trace::TraceReader& reader() { return *reader_; }
  /// Length of the last frame's line.
  std::size_t bytes() const { return reader_->bytes(); }
  /// Skips a frame that an earlier pass has checked.
  void skip() { reader_->skip(); }
  void rewind();

  /// Truncated last line, after a crash of the writer. Known after the last frame.
  const std::optional<trace::Torn>& torn() const { return reader_->torn(); }
  /// Prints a warning about it to stderr.
  void report_torn() const;

 private:
  void begin();

  std::string name_;
  std::unique_ptr<std::istream> own_;  // null for standard input
  std::optional<trace::TraceReader> reader_;
  trace::Header header_;
  std::optional<TraceChecks> checks_;
  int frames_ = 0;         // read in this pass
  bool is_known_ = false;  // read to its end once
};

/// Reads a whole trace. Prints a warning to stderr if it is truncated.
trace::Trace load_trace(const std::string& path);

/// Reads from text.
trace::Trace parse_trace(const std::string& text, const std::string& name);

}  // namespace contactscope::app
