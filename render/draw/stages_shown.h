#pragma once

#include <vector>

#include "core/view.h"
#include "trace/trace.h"

namespace contactscope::draw {

/// The optional stages of the pipeline that the layers and panels of these views look at. Manifolds
/// are always there.
trace::Stages stages_shown(const std::vector<View>& views);

}  // namespace contactscope::draw
