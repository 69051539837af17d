#pragma once

#include <array>
#include <string>

#include "app/cli/verbs.h"
#include "image/image.h"
#include "snapshot/compare_runs.h"

namespace contactscope::app {

class Renderer;

/// The frame in which two runs part, of both, with one camera on the pair or shape that differs,
/// below the distance of the runs over time. `headers` and `names` are those of the runs; the
/// header of the parting itself has no frame, so the comparison must have frames.
Image diff_picture(const snapshot::RunComparison& runs, const std::array<trace::Header, 2>& headers,
                   const std::array<std::string, 2>& names, const std::optional<Size>& size,
                   Renderer& renderer);

}  // namespace contactscope::app
