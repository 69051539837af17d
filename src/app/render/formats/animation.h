#pragma once

#include <memory>

#include "app/render/formats/format.h"

namespace contactscope::app {

/// Display time of a picture. Milliseconds of a sequence add up to its rounded duration.
struct Duration {
  double seconds = 0;
  int milliseconds = 0;
};

/// An animated raster file being written.
class Animation {
 public:
  Animation() = default;
  virtual ~Animation() = default;
  Animation(const Animation&) = delete;
  Animation& operator=(const Animation&) = delete;

  virtual void add(const Image& image, const Duration& shown) = 0;
  virtual void finish() = 0;
};

/// Feeds pictures to an animation on another thread, one behind the caller. Each is shown until the
/// time of the next frame; the last as long as the one before it.
std::unique_ptr<Reel> reel_of(const ReelPlan& plan, std::unique_ptr<Animation> animation);

}  // namespace contactscope::app
