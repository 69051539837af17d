#pragma once

#include "draw/scene/scene.h"

/// The story of clipping, a side plane a frame: frame 0 shows the two faces, frame k what the k-th side
/// plane cuts away, and the frame after the last plane which points are kept.
/// Gregorius 2015, "Hull vs Hull: Face Contact Clipping".
namespace contactscope::draw {

bool tells_clip_story(const Scene& scene, const trace::Pair& pair);

/// How many side planes have cut in this frame; of a view without the story all of them.
std::size_t clip_steps_to_show(const Scene& scene, const trace::Pair& pair);

/// Whether all side planes have cut before this frame: what is told is what the reference face takes away.
/// Never of a view without the story.
bool all_planes_have_cut(const Scene& scene, const trace::Pair& pair);

/// A corner of the polygon with its number: corners are numbered in the order in which side planes made
/// them, those of the incident face have none.
struct NumberedCorner {
  Vec3d position;
  int number = 0;       // from 1
  bool is_new = false;  // made by the last of the planes
};

/// Corners that the first `steps` side planes made and that are still there.
std::vector<NumberedCorner> numbered_corners(const trace::Clip& clip, std::size_t steps);

/// What the side plane of step `step` cuts away: empty where it cuts nothing.
trace::Polygon cut_away(const trace::Clip& clip, std::size_t step);

/// The part that side planes and polygons do not draw themselves: what is cut away, the corners that
/// are made, and in words which step this is.
void draw_clip_story(const Scene& scene, const trace::Pair& pair, Sketch& sketch);

/// Parallel lines over a convex polygon in its plane, `pixels` apart on the screen.
void hatch_in_space(const Camera& camera, const trace::Polygon& polygon, double pixels,
                    const LineStyle& style, Sketch& sketch);

}  // namespace contactscope::draw
