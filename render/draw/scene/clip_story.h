#pragma once

#include "draw/scene/scene.h"

/// Clipping in steps: frame 0 shows the two faces, frame k what the k-th side plane cuts away, and
/// the frame after the last plane the points that are kept. Gregorius 2015, "Hull vs Hull: Face
/// Contact Clipping".
///
/// The step of GJK or EPA that a frame shows.
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

/// State of the algorithm in the Minkowski difference, as a frame shows it.
struct SimplexStep {
  enum class Of { Gjk, Epa, Mpr } of = Of::Gjk;
  std::vector<trace::SimplexVertex> vertices;
  /// For each vertex, its place in the order of discovery; it is constant from step to step.
  std::vector<int> numbers;
  const trace::Polytope* polytope = nullptr;  // of EPA
  std::optional<trace::SimplexVertex> next;   // support point that the next step adds
  int step = 0;                               // from 1; 0: before the first
  int steps = 0;                              // number of steps
  bool last() const { return step == steps; }
};

/// If the view shows steps, frame k shows the state after step k, `later` after step k + 1, and
/// later frames the last step. Otherwise the last step. Nothing if the pair has no such record.
std::optional<SimplexStep> simplex_step(const View& view, const trace::Frame& frame,
                                        const trace::Pair& pair, bool later = false);

/// Point nearest to the origin in the convex hull of one to four points.
Vec3d nearest_to_origin(const std::vector<Vec3d>& points);

/// Point of the Minkowski difference.
inline Vec3d difference(const trace::SimplexVertex& vertex) { return vertex.b - vertex.a; }

/// Face of a hull on which a sphere or a capsule rests.
struct FaceOfRound {
  const PlacedShape* round = nullptr;
  std::vector<Vec3d> polygon;  // world, metres
  Vec3d normal;                // outward, unit
};

/// The face of a pair whose trace has one manifold with a face axis; nothing for other pairs.
std::optional<FaceOfRound> face_of_round(const Scene& scene, const trace::Pair& pair);

/// Axis of a capsule, clipped against the side planes of a hull's face. World, metres.
struct ClippedSegment {
  std::vector<Vec3d> face;   // of the hull
  Vec3d normal;              // of the face, outward, unit
  std::vector<Vec3d> sides;  // outward unit normals of the planes through each edge along `normal`
  Vec3d axis_from, axis_to;  // of the capsule
  Vec3d from, to;            // the clipped axis

  /// Whether that side plane cuts off part of the axis.
  bool cuts(std::size_t side) const;
};

/// The clipped axis of a capsule on a hull's face; nothing for other pairs or an empty result.
std::optional<ClippedSegment> clipped_segment(const Scene& scene, const trace::Pair& pair);

}  // namespace contactscope::draw
