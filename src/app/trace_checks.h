#pragma once

#include <string>
#include <unordered_map>

#include "trace/trace.h"

namespace contactscope::app {

/// Whether the parts of a trace fit together: what a reader of JSON does not know. Sees a frame at a time.
class TraceChecks {
 public:
  /// What is wrong, and what would be right.
  struct Wrong {
    std::string text;
  };

  /// Hulls without faces get those of the convex hull of their vertices. The header outlives the checks. Throws Wrong.
  explicit TraceChecks(trace::Header& header);

  /// The frames in their order; the shapes that one brings are added to the header. Throws Wrong.
  void frame(trace::Frame& frame);

  int last_frame() const { return last_; }

 private:
  void add(trace::Shape shape);
  void facts(const trace::Frame& frame) const;
  void pair(std::size_t index, const trace::Pair& pair) const;
  /// `place` makes the words for where it is named.
  template <class Place>
  const trace::Shape& named(const std::string& name, const Place& place) const;

  trace::Header& header_;
  std::unordered_map<std::string, std::size_t> places_;  // of the shapes in the header
  int last_ = -1;                                        // frame
};

}  // namespace contactscope::app
