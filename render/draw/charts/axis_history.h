#pragma once

#include <string>
#include <vector>

#include "trace/trace.h"

namespace contactscope::draw {

/// The axis that made the contact of a pair in one frame, or kept it apart. Empty where nothing
/// says.
std::string axis_of(const trace::Pair& pair);

struct AxisMoment {
  const trace::Pair* pair = nullptr;  // nullptr where no axis is known
  std::string axis;
  bool switched = false;  // to another axis, or to another face or pair of edges on the same one
};

/// `pairs`: the pair in each frame, nullptr where a frame has none. What a cache answers with is what
/// the last test chose, as long as it is on the same axis.
std::vector<AxisMoment> axis_history(const std::vector<const trace::Pair*>& pairs);

}  // namespace contactscope::draw
