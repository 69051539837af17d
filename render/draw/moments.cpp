#include "draw/moments.h"

#include "draw/scene/quantity.h"

namespace contactscope::draw {
namespace {

/// Whether the time of each frame is its number; of one frame alone it tells nothing.
bool counts_frames(const std::vector<trace::Frame>& frames) {
  for (const trace::Frame& frame : frames) {
    if (frame.time != frame.frame) return false;
  }
  return frames.size() > 1;
}

}  // namespace

Moments::Moments(const std::vector<trace::Frame>& frames, Story story) {
  if (frames.empty()) return;
  const bool told = story != Story::None;
  steps_ = told || counts_frames(frames);
  before_first_ = told ? 0 : 1;
  last_ = frames.back().frame + before_first_;
}

std::string Moments::of(const trace::Frame& frame) const {
  if (!steps_) return printed("frame %d, t = %.3f s", frame.frame, frame.time);
  return printed("step %d of %d", frame.frame + before_first_, last_);
}

}  // namespace contactscope::draw
