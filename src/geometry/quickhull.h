#pragma once

#include "geometry/hull.h"

namespace contactscope::quickhull {

enum class Status {
  Done,
  Coincident,  // all points are within the tolerance of one point
  Collinear,   // ... of one line
  Coplanar,    // ... of one plane
  Unresolved,  // merging left no polyhedron, or one that is not convex within kSlack tolerances
};

/// Convexity limit, in tolerances: the largest distance of any input point above any plane, and of
/// a face's own vertices from its plane. Merged planes are fitted to points that may each be a
/// tolerance off, and the centroid test extrapolates from a face's centre to its rim.
inline constexpr double kSlack = 10;

struct Result {
  Status status = Status::Done;
  std::vector<std::vector<int>> faces{};  // point indices, counter-clockwise seen from outside
  double shortest_edge = 0;
  double steepest_edge = 0;  // largest sine between an edge and the plane of an adjacent face
};

/// Quickhull. `points` differ, surround the origin, and are of magnitude 1, as is `tolerance`.
Result run(std::span<const Vec3d> points, double tolerance);

/// Largest sine between an edge and its faces. A steeper edge disagrees with the direction of its
/// faces, and a Gauss map crossing that is off by this much is invalid. Merging can leave such an
/// edge if points lie within some thousand tolerances of each other.
inline constexpr double kSteepest = 1.0 / 4096;

/// For points so close together: the growing hull merges only differences within rounding, and then
/// neighbours coplanar within `tolerance`, unless an edge would become steeper than kSteepest.
Result run_with_near_points(std::span<const Vec3d> points, double tolerance);

// Steps of run().

struct Simplex {
  Status status = Status::Done;  // Done, Coincident, Collinear or Coplanar
  std::array<int, 4> points{};   // face 0, 1, 2 is counter-clockwise seen from outside
  double thickness = 0;          // distance of the fourth point from that face
};

/// Four points that span a large tetrahedron, after Gregorius, "Implementing Quickhull": the two
/// extreme points along the axes with the largest distance, the point farthest from their line, and
/// the point farthest from the plane of these three. If a step finds nothing farther than
/// `tolerance`, the points have no volume, and `status` names the degeneracy.
Simplex initial_simplex(std::span<const Vec3d> points, double tolerance);

// The growing polyhedron: half-edges that can be cut and sewn, and faces with conflict lists.

struct Edge {
  int origin;  // point where it starts
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
  Vec3d centroid = Vec3d::Zero();  // mean of all vertices
  double area = 0;

  std::vector<int> conflicts;  // points above this face, assigned to no other face
  int farthest = -1;           // point of `conflicts` with the largest distance
  double farthest_distance = 0;
};

/// Indices are stable: removed elements are only marked or become unreferenced. Every vertex and
/// every face has at least three edges, unless broken().
class Mesh {
 public:
  explicit Mesh(std::span<const Vec3d> points);
  std::span<const Vec3d> points() const { return points_; }
  const Vec3d& point(int i) const { return at(points_, i); }
  /// Includes removed faces.
  int face_count() const { return count_of(faces_); }
  /// Indices of the faces that are not removed.
  std::vector<int> faces() const;
  Face& face(int i) { return at(faces_, i); }
  const Face& face(int i) const { return at(faces_, i); }
  const Edge& edge(int i) const { return at(edges_, i); }
  int target(int i) const { return edge(edge(i).next).origin; }
  int neighbour(int i) const { return edge(edge(i).twin).face; }
  /// Vertices of a face in order.
  std::vector<int> loop(int face) const;
  /// Edges of one face: starting with edge `first`, or all edges of a given face.
  auto ring_from(int first) const {
    return EdgeRing{first, [this](int e) { return edge(e).next; }};
  }
  auto around(int face_index) const { return ring_from(face(face_index).edge); }
  /// Sine of the angle between an edge and a plane.
  double slope(int i, const Vec3d& normal) const {
    const Vec3d along = point(target(i)) - point(edge(i).origin);
    return std::abs(normal.dot(along)) / along.norm();
  }
  double distance(int face_index, int point_index) const {
    return face(face_index).plane.distance(point(point_index));
  }

  /// Adds the face a, b, c, counter-clockwise seen from outside, and computes its plane. Returns
  /// its first edge, a-b; the others follow by `next`. The caller sews the twins.
  int add_triangle(int a, int b, int c);
  /// Makes two half-edges twins of each other.
  void sew(int one, int other);

  /// Removes `edge`, so that its face absorbs the face across it. A vertex left with two edges is
  /// removed too, and then a face left with two edges: the fix-ups of Gregorius, "Implementing
  /// Quickhull", "Topological invariants". Changed faces are measured again. All changed or removed
  /// faces are appended to `touched` once each. Returns false and changes nothing if the two faces
  /// also meet elsewhere, because their union would not be a polygon.
  bool merge_across(int edge, std::vector<int>& touched);

  /// Splits a face along the line between two of its non-adjacent vertices, each given by the edge
  /// of the face that leaves it. The part that begins with `one` becomes a new face, the last one.
  void split(int one, int other);

  /// True if the mesh bounds no solid, after a fix-up or for a caller; do not use it any further.
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
  std::vector<int> leaving_;  // one outgoing half-edge per point
  bool broken_ = false;
};

/// Merges the `fresh` faces of a new cone with each other and with their neighbours, until each is
/// convex towards all of its neighbours by more than `tolerance`. Changed or removed faces, fresh
/// or not, are appended to `touched`.
void merge_cone(Mesh& mesh, const std::vector<int>& fresh, double tolerance,
                std::vector<int>& touched);

/// The same for the whole mesh: the neighbour of a settled face may have changed later. Does not
/// merge faces if the union would have an edge steeper than `steepest`.
void merge_all(Mesh& mesh, double tolerance, double steepest = 1);

/// Reflex corner of a face.
struct Notch {
  int edge = -1;     // edge of the face that leaves the corner; -1 if there are no corners
  double depth = 0;  // distance of the corner inside the line between its neighbours
};

/// The deepest reflex corner; `depth` is negative or 0 for a convex outline.
Notch deepest_notch(const Mesh& mesh, int face);

/// Splits faces at reflex corners deeper than `tolerance`, until none is left.
void split_notched_faces(Mesh& mesh, double tolerance);

}  // namespace contactscope::quickhull
