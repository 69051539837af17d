#pragma once

#include "draw/scene/scene.h"

/// Clipping in steps: frame 0 shows the two faces, frame k what the k-th side plane cuts away, and
/// the frame after the last plane the points that are kept. Gregorius 2015, "Hull vs Hull: Face
/// Contact Clipping".
namespace contactscope::draw {

bool has_clip_story(const Scene& scene, const trace::Pair& pair);

/// Number of side planes that have cut in this frame; all of them if the view does not show steps.
std::size_t clip_steps_to_show(const Scene& scene, const trace::Pair& pair);

/// Whether all side planes have cut before this frame. It then shows the points that the reference
/// face drops. Always false if the view does not show steps.
bool all_planes_have_cut(const Scene& scene, const trace::Pair& pair);

/// Corner of the clipped polygon. Corners are numbered in the order in which the side planes create
/// them. Corners of the incident face have no number.
struct NumberedCorner {
  Vec3d position;
  int number = 0;       // from 1
  bool is_new = false;  // made by the last plane
};

/// Corners that the first `steps` side planes created and that still exist.
std::vector<NumberedCorner> numbered_corners(const trace::Clip& clip, std::size_t steps);

/// Polygon that the side plane of step `step` cuts away; empty if it cuts nothing.
trace::Polygon cut_away(const trace::Clip& clip, std::size_t step);

/// Draws what the layers of side planes and polygons do not: the part cut away, the new corners,
/// and a heading that describes the step.
void draw_clip_story(const Scene& scene, const trace::Pair& pair, Sketch& sketch);

/// Hatches a convex polygon in its plane; `pixels` is the line spacing on the screen.
void hatch_in_space(const Camera& camera, const trace::Polygon& polygon, double pixels,
                    const LineStyle& style, Sketch& sketch);

}  // namespace contactscope::draw
