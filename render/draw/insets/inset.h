#pragma once

#include <string>
#include <vector>

#include "draw/scene/layout.h"
#include "draw/scene/scene.h"

/// A second viewport beside the shapes, into a space of its own: the Minkowski difference, or the
/// sphere of directions. A view asks for it by naming the panel.
namespace contactscope::draw {

struct Inset {
  Panel panel;    // Minkowski or GaussMap
  Rect frame;     // of the canvas, with its heading
  Camera camera;  // looks from where the camera of the shapes does, so that directions agree
};

/// What an inset shows of one frame.
struct InsetPicture {
  std::string heading;
  std::string note;  // beside the heading
  Sketch sketch;
};

/// Takes the panels that are insets out of the view's, in their order.
std::vector<Panel> take_insets(View& view);

/// Fits a camera to all that an inset shows in a sequence, beside the view of `camera`.
/// `layout.insets` are their places.
std::vector<Inset> stage_insets(const std::vector<Panel>& panels, const Vec3d& world_up,
                                const Camera& camera, const Layout& layout,
                                const std::vector<trace::Frame>& frames);

InsetPicture sketch_inset(const Inset& inset, const Scene& scene);

/// Frame, heading and contents.
void draw_inset(const Inset& inset, const InsetPicture& picture, const Layout& layout,
                Drawing& drawing);

// The spaces, one file each.

/// Metres; the origin is always among them.
std::vector<Vec3d> minkowski_extent(const std::vector<trace::Frame>& frames);
InsetPicture sketch_minkowski(const Inset& inset, const Scene& scene);

/// Direction to look against so that the best axis of the sequence is in front; near `usual`.
Vec3d gauss_map_direction(const std::vector<trace::Frame>& frames, const Vec3d& usual);
InsetPicture sketch_gauss_map(const Inset& inset, const Scene& scene);

}  // namespace contactscope::draw
