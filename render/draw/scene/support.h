#pragma once

#include "draw/scene/legend.h"
#include "trace/trace.h"

/// What a body stands on, in words.
namespace contactscope::draw {

/// The support, and the axis about which a body turns that is not stable.
void explain_support(const trace::Stability& stability, bool turns, Legend& legend);

}  // namespace contactscope::draw
