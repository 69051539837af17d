#pragma once

#include <ios>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "trace/json.h"

namespace contactscope::trace {

class JsonLine;

/// The last line of a file whose writer died before its end.
struct Torn {
  int line = 0, column = 0;  // where it ends to be JSON, from 1
  std::string why{};
};

/// Reads a trace a frame at a time: memory depends on the largest frame, and not on how many there are.
class TraceReader {
 public:
  /// Reads the header; the stream outlives the reader. `name` is the file's name for messages. Throws InputError as
  /// read_trace() does.
  TraceReader(std::istream& in, std::string name);
  ~TraceReader();

  /// `frames` is 0 where the file does not say.
  const Header& header() const { return header_; }

  /// The next frame, with what follows from the rest filled in; empty after the last one, also where the line after
  /// it is torn. Throws InputError.
  std::optional<Frame> next();

  /// Passes over the next frame without looking at it; false after the last line.
  bool skip();

  /// Back to the first frame, of a stream that can seek.
  void rewind();

  /// Of the file, from 1: the one that was read last.
  int line() const { return number_; }

  /// Of that line.
  std::size_t bytes() const { return line_.size(); }

  /// Where the file is cut off within its last line, once next() got there. Before any frame that is an error.
  const std::optional<Torn>& torn() const { return torn_; }

 private:
  void know(const std::vector<Shape>& shapes);
  template <class Read>
  bool next_line(const Read& read_it);

  std::istream& in_;
  std::string name_, line_;
  std::unique_ptr<JsonLine> json_;  // what reads it
  int number_ = 0;                  // of the line
  std::streampos first_{};          // of what follows the header
  int first_number_ = 0;
  int frames_ = 0;
  Header header_;
  Kinds kinds_;  // of the shapes of the header and of all frames up to here
  std::optional<Torn> torn_;
};

}  // namespace contactscope::trace
