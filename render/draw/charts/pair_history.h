#pragma once

#include <string>
#include <vector>

#include "trace/trace.h"

/// One pair through the frames of a sequence: the same bodies under the same label.
namespace contactscope::draw {

bool same_pair(const trace::Pair& one, const trace::Pair& other);

/// The pair in every frame; null where a frame has none. Traces of other engines may leave out
/// pairs that are far apart.
std::vector<const trace::Pair*> pair_history(const std::vector<trace::Frame>& frames,
                                             const trace::Pair& wanted);

/// What a picture calls the pair: its label, or the names of both.
std::string pair_name(const trace::Pair& pair);

}  // namespace contactscope::draw
