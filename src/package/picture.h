#pragma once

#include <functional>
#include <vector>

#include "image/image.h"
#include "package/contactscope/render.h"
#include "trace/trace.h"

namespace contactscope::package {

/// Draws the frames with the indices `which`, with the camera fitted to the frames `fitted`, and
/// passes each picture to `take`. Throws as render() does.
void draw_frames(const contactscope::trace::Header& header,
                 const std::vector<contactscope::trace::Frame>& fitted,
                 const std::vector<contactscope::trace::Frame>& frames,
                 const std::vector<std::size_t>& which, const RenderOptions& options,
                 const std::function<void(std::size_t, Image)>& take);

}  // namespace contactscope::package
