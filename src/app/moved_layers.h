#pragma once

#include <string>
#include <vector>

#include "draw/staging.h"
#include "trace/trace.h"

namespace contactscope::app {

/// The layers, panels and insets whose drawing differs between two versions of a frame, both drawn by this
/// program with one camera: what in a picture moved because the facts did. In the order of the drawing.
std::vector<std::string> moved_layers(const draw::Staging& staging, const trace::Frame& expected,
                                      const trace::Frame& actual);

}  // namespace contactscope::app
