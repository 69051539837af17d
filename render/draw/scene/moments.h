#pragma once

#include <string>
#include <vector>

#include "core/view.h"
#include "trace/trace.h"

namespace contactscope::draw {

/// How a sequence says where it is: "frame 12, t = 0.200 s", or where it is told in steps, "step 3 of
/// 5". Steps tell the stories of algorithms, whose frame k is what step k leaves, from 0, the start.
/// Sequences whose time counts the frames, one a second, have pictures: the first is picture 1.
class Moments {
 public:
  /// As time passes.
  Moments() = default;
  /// Frames of a whole sequence, or of a long one some of them, the first and the last among them.
  Moments(const std::vector<trace::Frame>& frames, Story story);

  std::string of(const trace::Frame& frame) const;

 private:
  bool steps_ = false;
  const char* word_ = "step";
  int before_first_ = 0;  // what is added to the number of a frame
  int last_ = 0;          // step
};

}  // namespace contactscope::draw
