#pragma once

#include <string>
#include <vector>

#include "draw/staging.h"
#include "trace/trace.h"

namespace contactscope::app {

/// What in a picture moved because the facts did.
struct MovedLayers {
  std::vector<std::string> names;  // of layers, panels and insets, in the order of the drawing
  /// An SVG of them as large as the picture: for each a group of class "expected", and one of class "actual", with
  /// its name as another class. Empty where none moved.
  std::string svg;
};

/// Of two versions of a frame, both drawn by this program with one camera.
MovedLayers moved_layers(const draw::Staging& staging, const trace::Frame& expected,
                         const trace::Frame& actual);

}  // namespace contactscope::app
