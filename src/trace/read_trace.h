#pragma once

#include <ios>

#include "core/workers.h"
#include "trace/json.h"

namespace contactscope::trace {

class JsonLine;

/// Parts of a frame to read; the others stay empty. Reading contacts alone takes a fraction of the
/// time of all stages.
struct Parts {
  bool poses = true;
  bool pairs = true;
  bool stages = true;  // of pairs, and the solver, the broad phase and other facts of the frame
};

/// The text of a frame.
struct FrameText {
  std::string text;
  int line = 0;          // from 1
  bool is_open = false;  // the file ends in it, without a newline
};

/// An incomplete last line, left by a writer that died.
struct Torn {
  int line = 0, column = 0;  // where valid JSON ends, from 1
  std::string why{};
};

/// One line for each problem, the second and further ones with their place in front.
std::string in_lines(const std::vector<std::string>& problems, const std::string& place);

/// Reads a trace frame by frame: memory depends on the largest frame, not on their number.
class TraceReader {
 public:
  /// Reads the header. The stream must outlive the reader. `name` is the file's name in messages.
  /// Throws InputError as read_trace() does; problems within the header are appended to `problems`
  /// instead, if it is not null.
  TraceReader(std::istream& in, std::string name, std::vector<std::string>* problems = nullptr);
  ~TraceReader();

  /// `frames` is 0 if the file does not contain it.
  const Header& header() const { return header_; }

  /// Keys of the header's shapes that are not read, and that resemble keys that are.
  const std::vector<std::string>& doubts() const { return doubts_; }

  /// The next frame, with derived values filled in; empty after the last one, also if a torn line
  /// follows. Throws InputError.
  std::optional<Frame> next();

  /// The next frame without parsing it; false after the last line.
  bool take(FrameText& next);

  /// Parses such texts, the next ones in order, on several threads. Fewer frames than texts if the
  /// last one is torn. Throws InputError.
  std::vector<Frame> read(std::vector<FrameText>& texts, const Parts& parts, Workers& workers);

  /// Skips the next frame without parsing it; false after the last line.
  bool skip();

  /// Back to the first frame; needs a stream that can seek.
  void rewind();

  /// Number of the last line read, from 1.
  int line() const { return number_; }

  /// Length of that line.
  std::size_t bytes() const { return line_.size(); }

  /// The torn last line, once next() got there. It is an error before any frame.
  const std::optional<Torn>& torn() const { return torn_; }

 private:
  void know(const std::vector<Shape>& shapes);
  template <class Read> bool next_line(const Read& read_it);
  void finish(Frame& frame, int line);

  std::istream& in_;
  std::string name_, line_;
  std::unique_ptr<JsonLine> json_;                  // parser of that line
  std::vector<std::unique_ptr<JsonLine>> parsers_;  // one for each thread
  int number_ = 0;                                  // number of the line
  std::streampos first_{};                          // position after the header
  int first_number_ = 0;
  int frames_ = 0;
  Header header_;
  std::vector<std::string> doubts_;
  Kinds kinds_;  // shapes of the header and of all frames so far
  std::optional<Torn> torn_;
};

}  // namespace contactscope::trace
