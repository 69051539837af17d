#pragma once

#include "draw/scene/scene.h"

/// Drawing of shapes: polyhedra, round shapes, triangle meshes and planes; contacts of round shapes
/// and of heaps.
namespace contactscope::draw {

/// Draws faces that show their outside, or all if `both_sides`. Returns which show their outside.
std::vector<bool> draw_faces(const Camera& camera, const PlacedShape& shape, const Color& fill,
                             bool both_sides, Sketch& sketch);

/// Draws faces, silhouette and edges of a polyhedron; hidden lines are faint.
void draw_solid(const Camera& camera, const PlacedShape& shape, const Color& fill, Sketch& sketch);

/// The same for one of many opaque bodies: convex, with one shadow instead of one for each face.
void draw_small_solid(const Camera& camera, const PlacedShape& shape, const Color& fill,
                      Sketch& sketch);

/// Draws the surface of a round body and its outline; nothing if the eye is inside it.
void draw_body(const Camera& camera, const RoundBody& body, const Color& fill,
               const LineStyle& outline, Sketch& sketch);

/// Draws a body and inside it the core that contacts are measured from. Gregorius 2015 draws
/// spheres and capsules as points and segments with a radius.
void draw_round(const Camera& camera, const PlacedShape& shape, const Color& fill, Sketch& sketch);
/// The same for one of many small bodies: with fewer facets, and without its core.
void draw_small_round(const Camera& camera, const PlacedShape& shape, const Color& fill,
                      Sketch& sketch);

/// Draws the triangles of a mesh, from a staircase step to ten thousand. Lines are strong at
/// borders, creases and silhouettes, and thin between triangles; thin lines fade if triangles are
/// small on the screen. Both sides of an open mesh are drawn, because both collide.
void draw_mesh(const Scene& scene, const PlacedShape& shape, const Color& fill, Sketch& sketch);

/// Highlights each triangle of a mesh that has a manifold with any shape: as the reference face, or
/// as the incident face if the reference face belongs to the other shape.
void draw_touched_triangles(const Scene& scene, Sketch& sketch);

/// Draws the patch of a half-space's plane, its border, and ticks that point into the solid, the
/// symbol of solid ground, at borders that face the viewer. Seen from inside, only the border.
void draw_plane(const Camera& camera, const PlacedShape& shape, const Color& fill, Sketch& sketch);

/// Fits the patch of a plane to a sequence, frame by frame. It lies under the finite shapes of all
/// frames, with a margin and edges level in the first frame; two metres square without such shapes.
struct PatchFit {
  PlanePatch square;            // centred at the foot of the origin, same directions
  Eigen::AlignedBox2d found{};  // of the points, along these directions
  std::vector<Pose<double>> poses{};

  /// `pose`: in the first frame; `up`: world up.
  PatchFit(const trace::HalfSpace& plane, const Pose<double>& pose, const Vec3d& up);
  /// `points`: the finite shapes in a frame in which the plane has this pose.
  void add(const Pose<double>& pose, const std::vector<Vec3d>& points);
  PlanePatch patch() const;
};

/// World.
std::vector<Vec3d> patch_corners(const PlanePatch& patch, const Pose<double>& pose);

/// Measures the contact of a pair with a round shape. A sphere is a centre with a radius, a capsule
/// a segment with a radius. Marked are the nearest points of these cores and the ball about a
/// capsule's point (dashed: the virtual sphere). At the first point also the two radii, the
/// distance of the cores, and the sum that gives the overlap or gap. Meshes and planes have none.
void draw_radii(const Scene& scene, const trace::Pair& pair, Sketch& sketch);

/// Contact points among many shapes, instead of dots with whiskers. In a heap their area is in
/// proportion to the overlap, and one stands out: the point of the pair that the view focuses on,
/// otherwise the deepest one, with its normal, its bodies' outlines, their names and the overlap.
/// Next to the panel `worst` its other pairs have their numbers.
void draw_crowd(const Scene& scene, Sketch& sketch);

/// Whether part of the shape is in the picture. Always true for planes and meshes.
bool in_view(const Camera& camera, const PlacedShape& shape);

/// Turns the shape about `pivot` by `turn` (axis times radians), then moves it by `offset`. World,
/// metres.
PlacedShape moved(PlacedShape shape, const Vec3d& pivot, const Vec3d& offset, const Vec3d& turn);

/// Draws the silhouette; with a `fill` also the faces of a shape that has faces.
void draw_ghost(const Camera& camera, const PlacedShape& shape, const LineStyle& style,
                Sketch& sketch, const std::optional<Color>& fill = std::nullopt);

/// Draws a displacement, with an arrow head if it is long enough. It ends `before` metres before
/// `to`.
void draw_path(const Scene& scene, const Vec3d& from, const Vec3d& to, double before,
               const LineStyle& style, Sketch& sketch);

/// Radius of a ball, at which a displacement line to its centre ends; 0 for other shapes, metres.
double border_of_ball(const PlacedShape& shape);

}  // namespace contactscope::draw
