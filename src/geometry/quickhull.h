#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/vec3.h"
#include "geometry/quickhull_mesh.h"

namespace contactscope::quickhull {

enum class Status {
  Done,
  Coincident,  // all points within the tolerance of one point
  Collinear,   // ... of one line
  Coplanar,    // ... of one plane
  Unresolved,  // merging left no polyhedron, or one that is not convex within kSlack tolerances
};

/// Largest distance, in tolerances, of any input point above any plane, and of a face's own
/// vertices from its plane, that counts as convex. Merged planes are fitted to points that each may
/// be a tolerance off, and the centroid test extrapolates from a face's middle to its rim.
inline constexpr double kSlack = 10;

struct Result {
  Status status = Status::Done;
  std::vector<std::vector<int>> faces;  // point indices, counter-clockwise seen from outside
};

/// Quickhull. `points` are about the origin with coordinates of magnitude 1, no two equal;
/// `tolerance` in the same unit.
Result run(std::span<const Vec3d> points, double tolerance);

// Its steps, a file each.

struct Simplex {
  Status status = Status::Done;  // or Coincident, Collinear, Coplanar
  std::array<int, 4> points{};   // face 0, 1, 2 is counter-clockwise seen from outside
  double thickness = 0;          // distance of the fourth point from that face
};

/// Four points that span a large tetrahedron, after Gregorius, "Implementing Quickhull": the two
/// extreme points along the axes that are farthest apart, the point farthest from their line, and
/// the point farthest from the plane of the three. Where a step finds nothing farther than
/// `tolerance`, the points have no volume, and the step says which kind of flat they are.
Simplex initial_simplex(std::span<const Vec3d> points, double tolerance);

/// What a point sees of the hull.
struct Horizon {
  std::vector<int> visible;  // faces
  std::vector<int> edges;    // around those, counter-clockwise, each of a visible face
};

/// The faces that `eye` is above by more than `tolerance`, as far as they hang together with
/// `face`, which it is above, and the loop of edges around them. `edges` is empty where tolerance
/// leaves the visible faces without a boundary, with a hole or pinched at a vertex, so that no cone
/// of triangles over it would close the hull.
Horizon find_horizon(const Mesh& mesh, int face, int eye, double tolerance);

/// Merges the `fresh` faces of a new cone with each other and with the faces around it, until each
/// is convex towards all of its neighbours by more than `tolerance`. Faces that changed or went,
/// fresh or not, are added to `touched`.
void merge_cone(Mesh& mesh, const std::vector<int>& fresh, double tolerance,
                std::vector<int>& touched);

/// The same over the whole mesh: a face that was settled may have a neighbour that changed later.
void merge_all(Mesh& mesh, double tolerance);

/// A corner of a face that turns inwards.
struct Notch {
  int edge = -1;     // of the face, leaving the corner; -1 for a face without corners to look at
  double depth = 0;  // how far the corner is inside the line between its neighbours
};

/// The corner that is farthest inside; its depth is negative or 0 for a convex outline.
Notch deepest_notch(const Mesh& mesh, int face);

/// Cuts faces at corners that turn inwards by more than `tolerance`, until no outline has any.
void split_notched_faces(Mesh& mesh, double tolerance);

}  // namespace contactscope::quickhull
