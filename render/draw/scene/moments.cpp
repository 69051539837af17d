#include "draw/scene/moments.h"

#include <algorithm>

#include "core/at.h"
#include "draw/scene/quantity.h"
#include "draw/scene/simplex_steps.h"

namespace contactscope::draw {
namespace {

/// Whether the time of each frame is its number. False for a single frame, which proves nothing.
bool counts_frames(const std::vector<trace::Frame>& frames) {
  for (const trace::Frame& frame : frames) {
    if (frame.time != frame.frame) return false;
  }
  return frames.size() > 1;
}

/// Number of steps of the story's algorithm, maximum over all frames; 0 if no frame has recorded
/// it.
int recorded_steps(const std::vector<trace::Frame>& frames, Story story) {
  View view;
  view.story = story;
  int most = 0;
  for (const trace::Frame& frame : frames) {
    for (const trace::Pair& pair : frame.pairs) {
      if (story == Story::ClipSteps) {
        // The step after the side planes drops points above the reference face.
        if (pair.clip) most = std::max(most, count_of(pair.clip->steps) + 1);
      } else if (const auto step = simplex_step(view, frame, pair)) {
        most = std::max(most, step->steps);
      }
    }
  }
  return most;
}

}  // namespace

Moments::Moments(const std::vector<trace::Frame>& frames, Story story) {
  if (frames.empty()) return;
  const bool record = story != Story::None;
  steps_ = record || counts_frames(frames);
  word_ = record ? "step" : "picture";
  before_first_ = record ? 0 : 1;
  last_ = record ? recorded_steps(frames, story) : 0;
  if (last_ == 0) last_ = frames.back().frame + before_first_;
}

std::string Moments::of(const trace::Frame& frame) const {
  if (!steps_) return printed("frame %d, t = %.3f s", frame.frame, frame.time);
  return printed("%s %d of %d", word_, std::min(frame.frame + before_first_, last_), last_);
}

}  // namespace contactscope::draw
