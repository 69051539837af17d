#pragma once

#include <memory>

#include "app/formats/format.h"

namespace contactscope::app {

/// How long a picture is shown. The milliseconds of a sequence add up to its time, rounded.
struct Duration {
  double seconds = 0;
  int milliseconds = 0;
};

/// An animated file of pixels in the making.
class Animation {
 public:
  Animation() = default;
  virtual ~Animation() = default;
  Animation(const Animation&) = delete;
  Animation& operator=(const Animation&) = delete;

  virtual void add(const Image& image, const Duration& shown) = 0;
  virtual void finish() = 0;
};

/// Shows pictures to an animation on a thread of its own, one behind the caller, each as long as it is
/// until the next frame's time; the last as long as the one before it.
std::unique_ptr<Reel> reel_of(const ReelPlan& plan, std::unique_ptr<Animation> animation);

}  // namespace contactscope::app
