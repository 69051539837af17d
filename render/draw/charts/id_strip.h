#pragma once

#include <cstddef>
#include <vector>

#include "draw/scene/camera.h"
#include "draw/scene/drawing.h"

namespace contactscope::draw {

/// What became of a contact id in one frame.
enum class IdState { Absent, Dropped, Kept };

/// Ids over time: one row an id, each with a state for every frame; grey while the point is there,
/// vermilion while it is kept. A line marks frame `moment`. `pixel`: of a pixel at 720 lines.
void draw_id_strip(const std::vector<std::vector<IdState>>& rows, std::size_t frames,
                   std::size_t moment, const Rect& strip, float pixel, Drawing& drawing);

/// The same where rows would be too many to tell apart: one band a pair, as high as it has kept
/// points of the most that it ever had, and cut where one of them becomes another. `pairs`: of each
/// row its pair.
void draw_id_bands(const std::vector<std::vector<IdState>>& rows,
                   const std::vector<std::size_t>& pairs, std::size_t frames, std::size_t moment,
                   const Rect& strip, float pixel, Drawing& drawing);

/// The line alone.
void draw_moment(const Rect& strip, std::size_t frames, std::size_t moment, float pixel,
                 Drawing& drawing);

}  // namespace contactscope::draw
