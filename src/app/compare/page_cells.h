#pragma once

#include <vector>

#include "draw/scene/drawing.h"
#include "draw/staging.h"
#include "image/image.h"

/// Scenes in the cells of a page, see draw::RolloutPage.
namespace contactscope::app {

/// A canvas with a view, without captions and legend, in the size of a cell.
draw::Staging stage_cell(const trace::Header& header, const std::vector<trace::Frame>& frames,
                         const View& view, const draw::Rect& cell);

/// Copies the centre of a crop to the centre of a cell.
void paste(const Image& from, const draw::Rect& part, const draw::Rect& cell, Image& to);

}  // namespace contactscope::app
