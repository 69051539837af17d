#pragma once

#include <string>
#include <vector>

#include "core/title.h"
#include "draw/scene/quantity.h"
#include "trace/trace.h"

namespace contactscope::draw {

struct Staging;

/// A title that is filled in from frame to frame, with what it says of the whole sequence.
struct StagedTitle {
  Title title;
  /// For each placeholder that is about the sequence, in the order of the pieces, what stands for
  /// it; empty where it has no value.
  std::vector<std::string> of_sequence;
};

/// Looks through the frames where a placeholder is about all of them.
StagedTitle stage_title(const std::string& text, const std::vector<trace::Frame>& frames,
                        const LengthUnit& unit = {});

/// The first alternative of which this frame has all that its placeholders name; else the last one,
/// with "…" for what there is not.
std::string fill_title(const Staging& staging, const trace::Frame& frame);

/// The optional stages of the pipeline that a title looks at.
trace::Stages stages_of(const Title& title);

}  // namespace contactscope::draw
