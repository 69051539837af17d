#pragma once

#include "draw/scene/quantity.h"
#include "trace/trace.h"
#include "view/title.h"

namespace contactscope::draw {

struct Staging;

/// A title with placeholders, and their values over the whole sequence.
struct StagedTitle {
  Title title;
  /// Text of each placeholder over the sequence, in order of the pieces; empty without a value.
  std::vector<std::string> of_sequence;
};

/// Examines the frames if a placeholder refers to all of them.
StagedTitle stage_title(const std::string& text, const std::vector<trace::Frame>& frames,
                        const LengthUnit& unit = {});

/// The first alternative for which this frame has all values; otherwise the last, with "…" for
/// others.
std::string fill_title(const Staging& staging, const trace::Frame& frame);

/// Adds the optional stages of the pipeline that a title needs.
void add_stages(const Title& title, trace::Stages& stages);

}  // namespace contactscope::draw
