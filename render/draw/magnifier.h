#pragma once

#include <optional>
#include <string>
#include <vector>

#include "draw/scene/scene.h"

/// What a picture is about may be smaller than its dots: then a part of the picture is drawn again,
/// many times as large, in a corner, with a frame where it comes from.
namespace contactscope::draw {

struct Magnifier {
  Rect frame;         // of the canvas
  double factor = 1;  // 2, 5, 10, ...
};

/// Where the view's subject, the points of a pair or the two places that its axis or distance is
/// between, is under 20 pixels in all frames, and more than nothing.
/// `shapes`: points of what the view shows, which it covers as little of as it can.
std::optional<Magnifier> stage_magnifier(const View& view, const Camera& camera,
                                         const Layout& layout,
                                         const std::vector<trace::Frame>& frames,
                                         const std::vector<Vec3d>& shapes);

/// The middle of this frame's subject, world; nothing where it has none.
std::optional<Vec3d> magnified_middle(const View& view, const trace::Frame& frame);

/// Those with which overlaps and gaps are about as long in its frame as in the view.
SequenceScales scales_within(const Magnifier& magnifier, const SequenceScales& scales);

/// The sketch again, with the words that it has; `note` stands behind the factor.
void draw_magnified(const Magnifier& magnifier, const Vec3d& middle, Sketch sketch,
                    const std::string& note, const Camera& camera, const Layout& layout,
                    Drawing& drawing);

}  // namespace contactscope::draw
