#pragma once

#include "draw/scene/scene.h"

/// How shapes are drawn: polyhedra, round ones, triangle meshes and planes.
namespace contactscope::draw {

/// The faces that show their outside, or where `both_sides` all. Tells of each whether it shows its
/// outside.
std::vector<bool> draw_faces(const Camera& camera, const PlacedShape& shape, const Color& fill,
                             bool both_sides, Sketch& sketch);

/// Faces, silhouette and edges of a polyhedron: hidden lines are faint.
void draw_solid(const Camera& camera, const PlacedShape& shape, const Color& fill, Sketch& sketch);

/// The surface of a round body and its outline; neither of them for an eye inside of it.
void draw_body(const Camera& camera, const RoundBody& body, const Color& fill,
               const LineStyle& outline, Sketch& sketch);

/// A body, and inside of it the core that all is measured from: Gregorius 2015 draws spheres and
/// capsules as points and segments with a radius.
void draw_round(const Camera& camera, const PlacedShape& shape, const Color& fill, Sketch& sketch);

/// Surfaces of the triangles, of a step in a staircase or of ten thousand; strong lines where the
/// surface ends, bends or turns away from the eye, thin ones between triangles, which fade as these
/// become small on the screen. Both sides of an open mesh are drawn, for both collide.
void draw_mesh(const Scene& scene, const PlacedShape& shape, const Color& fill, Sketch& sketch);

/// Highlights the triangles of meshes that have a manifold with any shape, each once: as a reference
/// face, or as an incident face where the reference is a face of the other shape.
void draw_touched_triangles(const Scene& scene, Sketch& sketch);

/// The patch of a half-space's plane, its border, and ticks that hang into the solid from the borders
/// that face the viewer: the sign for solid ground. Seen from inside of the solid, only the border.
void draw_plane(const Camera& camera, const PlacedShape& shape, const Color& fill, Sketch& sketch);

/// Fits the drawn patch of a plane to a sequence, frame by frame: under the finite shapes of all
/// frames and a margin around them, with edges that are level in the first frame. Without finite
/// shapes it is a square of two metres.
struct PatchFit {
  PlanePatch square;            // about the foot of the origin, with the edges of the result
  Eigen::AlignedBox2d found{};  // of the points, along them
  std::vector<Pose<double>> poses{};

  /// `pose`: in the first frame; `up`: of the world.
  PatchFit(const trace::HalfSpace& plane, const Pose<double>& pose, const Vec3d& up);
  /// `points`: of the finite shapes in a frame in which the plane stands at `pose`.
  void add(const Pose<double>& pose, const std::vector<Vec3d>& points);
  PlanePatch patch() const;
};

/// World.
std::vector<Vec3d> patch_corners(const PlanePatch& patch, const Pose<double>& pose);

/// Whether some of the shape is in the picture. Planes and meshes count as such.
bool in_view(const Camera& camera, const PlacedShape& shape);

}  // namespace contactscope::draw
