#pragma once

#include <memory>
#include <optional>
#include <string>

#include "app/trace_checks.h"
#include "trace/read_trace.h"

namespace contactscope::app {

/// Whether a file is a trace and no scenario: it is named *.jsonl, or begins with '{', as no TOML
/// does; "-", the standard input, is one. False where there is no such file.
bool is_trace_file(const std::string& path);

/// What to say of a file in a known format that is not read, as foreign_format_remedy() has it; else empty.
std::string foreign_in(const std::string& path);

/// A trace, ours or another engine's, that is read and checked a frame at a time; "-" is the standard input.
/// Every function throws InputError, with the line and what would be right, where the trace cannot be read or does
/// not fit together: a shape without vertices, a frame without a pose for each shape, a pair of shapes
/// that are not there, a normal that is no unit vector, an index beyond a shape's faces.
class TraceFile {
 public:
  enum class Passes { One, Several };

  /// Reads the header. For several passes the standard input is kept in a temporary file.
  explicit TraceFile(const std::string& path, Passes passes = Passes::One);
  /// The same of text that was read already. `name`: of where it is from, in messages.
  TraceFile(std::unique_ptr<std::istream> text, const std::string& name);

  TraceFile(const TraceFile&) = delete;
  TraceFile& operator=(const TraceFile&) = delete;

  /// As messages name it.
  const std::string& name() const { return name_; }
  /// With faces for hulls that were written without, and with the shapes that frames brought up to here. Without
  /// `impulses`: frames have them in newton seconds on b, however the file does. `frames` is 0 until the last one was read where the file does not say.
  const trace::Header& header() const { return header_; }

  /// Empty after the last one; there is at least one.
  std::optional<trace::Frame> next();
  /// How long the line of the last one was.
  std::size_t bytes() const { return reader_->bytes(); }
  /// Passes over one without looking at it, which was looked at in an earlier pass.
  void skip() { reader_->skip(); }
  void rewind();

  /// Where the last line is cut off, which happens where the process that wrote it died. Known after the last frame.
  const std::optional<trace::Torn>& torn() const { return reader_->torn(); }
  /// Says that on the standard error.
  void tell_torn() const;

 private:
  void begin();

  std::string name_;
  std::unique_ptr<std::istream> own_;  // null of the standard input
  std::optional<trace::TraceReader> reader_;
  trace::Header header_;
  std::optional<TraceChecks> checks_;
  int frames_ = 0;         // read in this pass
  bool is_known_ = false;  // it was read to its end once
};

/// All of a trace at once. Torn files are read up to where they are cut off, which is told on the standard error.
trace::Trace load_trace(const std::string& path);

/// The same of text that was read already.
trace::Trace parse_trace(const std::string& text, const std::string& name);

}  // namespace contactscope::app
