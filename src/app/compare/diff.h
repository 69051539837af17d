#pragma once

#include "app/cli/verbs.h"
#include "image/image.h"
#include "snapshot/compare_runs.h"

namespace contactscope::app {

class Renderer;

/// "frame 12, crate-floor".
std::string place_of(const snapshot::Parting& parting);

/// Both runs in the frame in which they part, with one camera on the pair or shape that differs,
/// below their distance over time. They must part in a frame, not in their headers. `headers` and
/// `names` are those of the runs.
Image diff_picture(const snapshot::RunComparison& runs, const std::array<trace::Header, 2>& headers,
                   const std::array<std::string, 2>& names, const std::optional<Size>& size,
                   Renderer& renderer);

}  // namespace contactscope::app
