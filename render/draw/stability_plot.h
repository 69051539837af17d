#pragma once

#include <cstddef>
#include <vector>

#include "draw/camera.h"
#include "draw/drawing.h"
#include "trace/trace.h"

namespace contactscope::draw {

/// The content of panel "stability": for each pair whose stability was recorded (the first three)
/// the contact plane seen along the normal, right as in `camera`'s picture, with the points, the
/// hull of them that a body can rest on, its projected centre of mass and how far that is from the
/// border; what that means in words; then the margin over the frames up to `moment`, and the
/// verdicts, a row each. One scale in all frames and pairs. Without room for both, the map goes
/// first. `pixel`: one at 720 lines.
void draw_stability(const std::vector<trace::Frame>& frames, std::size_t moment,
                    const Camera& camera, const Rect& rect, float pixel, Drawing& drawing);

}  // namespace contactscope::draw
