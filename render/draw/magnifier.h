#pragma once

#include <optional>
#include <string>
#include <vector>

#include "draw/scene/scene.h"

/// Magnifier for a subject that is smaller than its dots. It repeats a part of the picture enlarged
/// in a corner, and frames the source.
namespace contactscope::draw {

struct Magnifier {
  Rect frame;         // of the canvas
  double factor = 1;  // magnification: 2, 5, 10, ...
};

/// Places a magnifier if the view's subject is smaller than 20 pixels in all frames, but not zero.
/// The subject is the points of a pair, or the two ends of its axis or distance. `shapes`: points
/// of the shapes in view; the magnifier covers as few as possible.
std::optional<Magnifier> stage_magnifier(const View& view, const Camera& camera,
                                         const Layout& layout,
                                         const std::vector<trace::Frame>& frames,
                                         const std::vector<Vec3d>& shapes);

/// Middle of this frame's subject, world; nothing without a subject.
std::optional<Vec3d> magnified_middle(const View& view, const trace::Frame& frame);

/// Scales for the magnifier with which overlaps and gaps are about as long in it as in the view.
SequenceScales scales_within(const Magnifier& magnifier, const SequenceScales& scales);

/// Draws the sketch again, with its labels; `note` follows the factor.
void draw_magnified(const Magnifier& magnifier, const Vec3d& middle, Sketch sketch,
                    const std::string& note, const Camera& camera, const Layout& layout,
                    Drawing& drawing);

}  // namespace contactscope::draw
