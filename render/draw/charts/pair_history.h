#pragma once

#include <string>
#include <vector>

#include "trace/trace.h"

/// One pair through the frames of a sequence: the same bodies under the same label.
namespace contactscope::draw {

/// The first of a frame's pairs for which that holds; nullptr where there is none.
const trace::Pair* first_pair(const trace::Frame& frame, bool (*holds)(const trace::Pair&));

/// The pairs for which that holds in some frame, at the first one of each.
std::vector<const trace::Pair*> distinct_pairs(const std::vector<trace::Frame>& frames,
                                               bool (*holds)(const trace::Pair&));

/// The pair in every frame; null where a frame has none. Traces of other engines may leave out
/// pairs that are far apart.
std::vector<const trace::Pair*> pair_history(const std::vector<trace::Frame>& frames,
                                             const trace::Pair& wanted);

/// What a picture calls the pair: its label, or the names of both.
std::string pair_name(const trace::Pair& pair);

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
