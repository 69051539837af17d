#pragma once

#include "draw/scene/scene.h"

/// A second viewport next to the shapes, with its own space: the Minkowski difference, or the
/// sphere of directions. A view requests it by naming the panel.
namespace contactscope::draw {

struct Inset {
  Panel panel;         // Minkowski or GaussMap
  Rect frame;          // on the canvas, including the heading
  Camera camera;       // same direction as the shapes' camera
  bool later = false;  // the step after the frame's
};

/// Contents of an inset for one frame.
struct InsetPicture {
  std::string heading;
  std::string note;  // next to the heading
  Sketch sketch;
};

/// Removes the panels that are insets from the view and returns them in order.
std::vector<Panel> take_insets(View& view);

/// Fits a camera to everything that an inset shows in a sequence, next to the view of `camera`.
/// `layout.insets` are the rectangles.
std::vector<Inset> stage_insets(const std::vector<Panel>& panels, const Vec3d& world_up,
                                const Camera& camera, const Layout& layout,
                                const std::vector<trace::Frame>& frames);

InsetPicture sketch_inset(const Inset& inset, const Scene& scene);

/// Draws frame, heading and contents.
void draw_inset(const Inset& inset, const InsetPicture& picture, const Layout& layout,
                Drawing& drawing);

// One file for each space.

/// Points in metres, including the origin.
std::vector<Vec3d> minkowski_extent(const std::vector<trace::Frame>& frames);
InsetPicture sketch_minkowski(const Inset& inset, const Scene& scene);

/// Viewing direction, near `usual`, that shows the best axis of the sequence in front.
Vec3d gauss_map_direction(const std::vector<trace::Frame>& frames, const Vec3d& usual);
InsetPicture sketch_gauss_map(const Inset& inset, const Scene& scene);

}  // namespace contactscope::draw
