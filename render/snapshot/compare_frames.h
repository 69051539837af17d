#pragma once

#include <map>
#include <string>
#include <vector>

#include "snapshot/compare_facts.h"
#include "trace/trace.h"

namespace contactscope::snapshot {

/// Compares the frames of two traces, each by itself: several threads may share one. Names, ids,
/// indices and counts compare exactly; numbers within a few ulps of the expected trace's scalar at
/// the size and position of the shapes, as compare_traces() says. The tolerances follow from the
/// expected trace alone, so that wild values in the actual one do not widen them.
class FrameComparison {
 public:
  explicit FrameComparison(const trace::Header& expected);

  /// Adds shapes that a frame brings.
  void know(const std::vector<trace::Shape>& shapes);

  /// Settles `actual`; see Changes.
  std::vector<Difference> header(const trace::Header& expected, trace::Header& actual) const;
  std::vector<Difference> frame(const trace::Frame& expected, trace::Frame& actual) const;

 private:
  Tolerance of(const trace::Frame& frame, const std::string& a, const std::string& b) const;
  Tolerance of(const trace::Frame& frame) const;
  double extent_of(const std::string& shape) const;
  Tolerance make(double place, double extent) const;

  double ulp_;
  std::map<std::string, double> extents_;  // metres, largest local coordinate
};

}  // namespace contactscope::snapshot
