#pragma once

#include <unordered_map>

#include "trace/trace.h"

namespace contactscope::app {

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

}  // namespace contactscope::app
