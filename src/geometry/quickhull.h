#pragma once

#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "core/at.h"
#include "core/plane.h"
#include "core/vec3.h"
#include "geometry/hull.h"

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
  std::vector<std::vector<int>> faces{};  // point indices, counter-clockwise seen from outside
  double shortest_edge = 0;
  double steepest_edge = 0;  // the largest sine of an edge against the plane of a face of its own
};

/// Quickhull. `points` are about the origin with coordinates of magnitude 1, no two equal;
/// `tolerance` in the same unit.
Result run(std::span<const Vec3d> points, double tolerance);

/// An edge steeper than this says another direction than its faces do, and a crossing of the Gauss map
/// that is off by as much is none. Where points lie closer to each other than some thousand tolerances,
/// merging can leave such an edge.
inline constexpr double kSteepest = 1.0 / 4096;

/// The same with points as close as that: nothing but rounding is merged while the hull grows, and in the
/// end neighbours that are coplanar within `tolerance`, where no edge becomes steeper than kSteepest.
Result run_with_near_points(std::span<const Vec3d> points, double tolerance);

// Its steps.

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

// The growing polyhedron: half-edges that can be cut and sewn, faces with conflict lists.

struct Edge {
  int origin;  // point that it leaves
  int next;    // around its face, counter-clockwise seen from outside
  int previous;
  int twin;
  int face;
};

struct Face {
  int edge = -1;  // one of its half-edges
  bool gone = false;
  bool suspect = false;            // the first merge pass found it concave towards a smaller face
  Plane<double> plane;             // Newell's, through the mean of all vertices
  Vec3d centroid = Vec3d::Zero();  // that mean
  double area = 0;

  std::vector<int> conflicts;  // points above it that no other face has taken
  int farthest = -1;           // of them
  double farthest_distance = 0;
};

/// Indices are stable: what is cut away is marked or never referred to again. No vertex has fewer
/// than three edges and no face fewer than three, unless broken().
class Mesh {
 public:
  explicit Mesh(std::span<const Vec3d> points);

  std::span<const Vec3d> points() const { return points_; }
  const Vec3d& point(int i) const { return at(points_, i); }
  /// With those that are gone.
  int face_count() const { return count_of(faces_); }
  /// Those that are not gone.
  std::vector<int> faces() const;
  Face& face(int i) { return at(faces_, i); }
  const Face& face(int i) const { return at(faces_, i); }
  const Edge& edge(int i) const { return at(edges_, i); }
  int target(int i) const { return edge(edge(i).next).origin; }
  /// The face across an edge.
  int neighbour(int i) const { return edge(edge(i).twin).face; }
  /// Vertices of a face in order.
  std::vector<int> loop(int face) const;
  /// The edges of the face of an edge, from that on, and those of a face.
  auto ring_from(int first) const {
    return EdgeRing{first, [this](int e) { return edge(e).next; }};
  }
  auto around(int face_index) const { return ring_from(face(face_index).edge); }
  /// The sine of an edge against a plane.
  double slope(int i, const Vec3d& normal) const {
    const Vec3d along = point(target(i)) - point(edge(i).origin);
    return std::abs(normal.dot(along)) / along.norm();
  }
  double distance(int face_index, int point_index) const {
    return face(face_index).plane.distance(point(point_index));
  }

  /// Adds the face a, b, c, counter-clockwise seen from outside, and measures it. Its first edge,
  /// a-b, is returned; the others follow by `next`. Twins are sewn by the caller.
  int add_triangle(int a, int b, int c);
  /// Makes two half-edges each other's twins.
  void sew(int one, int other);

  /// Takes `edge` away, so that its face swallows the one across it. A vertex that is left with two
  /// edges goes too, and a face that is left with two edges goes after it: the fix-ups of
  /// Gregorius, "Implementing Quickhull", "Topological invariants". Faces that keep their place but
  /// not their shape are measured anew; all that changed or went are added to `touched`, if not
  /// there yet. Returns false, and changes nothing, where the two faces also meet elsewhere, so
  /// that their union would be no polygon.
  bool merge_across(int edge, std::vector<int>& touched);

  /// Cuts a face in two along the line between two of its vertices that are not neighbours, given
  /// by the edges of the face that leave them. The part that begins with `one` becomes a new face,
  /// the last one.
  void split(int one, int other);

  /// A fix-up, or a caller, ended in something that bounds no solid; the mesh is of no further use.
  bool broken() const { return broken_; }
  void give_up() { broken_ = true; }

 private:
  Edge& edge_at(int i) { return at(edges_, i); }
  int& leaving(int vertex) { return at(leaving_, vertex); }
  bool meet_in_one_edge(int one, int other) const;
  void measure(int face);
  void follow(int edge, int next);
  void restore_invariants(std::vector<int> vertices, std::vector<int>& changed);
  void remove_vertex(int vertex, std::vector<int>& vertices, std::vector<int>& changed);
  void remove_two_gon(int face, std::vector<int>& vertices);

  std::span<const Vec3d> points_;
  std::vector<Edge> edges_;
  std::vector<Face> faces_;
  std::vector<int> leaving_;  // for each point one half-edge that leaves it
  bool broken_ = false;
};

/// Merges the `fresh` faces of a new cone with each other and with the faces around it, until each
/// is convex towards all of its neighbours by more than `tolerance`. Faces that changed or went,
/// fresh or not, are added to `touched`.
void merge_cone(Mesh& mesh, const std::vector<int>& fresh, double tolerance,
                std::vector<int>& touched);

/// The same over the whole mesh: a face that was settled may have a neighbour that changed later. Leaves
/// faces as they are whose union would have an edge steeper than `steepest`.
void merge_all(Mesh& mesh, double tolerance, double steepest = 1);

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
