#pragma once

#include <string>
#include <vector>

#include "draw/scene/quantity.h"
#include "trace/trace.h"
#include "view/title.h"
#include "view/view.h"

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

/// Texts for the moment of a frame: "frame 12, t = 0.200 s", or "step 3 of 5" for an algorithm
/// shown in steps. Frame k of an algorithm shows the result of step k; frame 0 is the start. If the
/// time equals the frame number, frames are pictures, and the first is picture 1.
class Moments {
 public:
  /// Without frames: texts with frame and time.
  Moments() = default;
  /// All frames of a sequence, or a subset of a long one that includes the first and the last.
  Moments(const std::vector<trace::Frame>& frames, Story story);

  std::string of(const trace::Frame& frame) const;

 private:
  bool steps_ = false;
  const char* word_ = "step";
  int before_first_ = 0;  // added to the number of a frame
  int last_ = 0;          // last step
};

}  // namespace contactscope::draw
