#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "draw/scene/camera.h"
#include "draw/scene/drawing.h"
#include "trace/trace.h"

namespace contactscope::draw {

/// The content of panel "stability": for each pair whose stability was recorded (the first three)
/// the contact plane seen along the normal, right as in `camera`'s picture, with the points, the
/// hull of them that a body can rest on, its projected centre of mass and how far that is from the
/// border; what that means in words; then the margin over the time up to `moment`, and in which
/// row, one a verdict, each pair is. One scale in all frames and pairs. Without room for both, the map goes
/// first. `pixel`: one at 720 lines.
void draw_stability(const std::vector<trace::Frame>& frames, std::size_t moment,
                    const Camera& camera, const Rect& rect, float pixel, Drawing& drawing);

/// A margin as the panel and the layer "support" both spell it: in millimetres, as the panel's chart
/// has them, unless that would be a strange number of them.
std::string spell_margin(double metres);

}  // namespace contactscope::draw
