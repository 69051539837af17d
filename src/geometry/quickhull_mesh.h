#pragma once

#include <span>
#include <vector>

#include "core/at.h"
#include "core/plane.h"
#include "core/vec3.h"

/// The growing polyhedron of quickhull: half-edges that can be cut and sewn, faces with conflict
/// lists. Internal to the hull builder.
namespace contactscope::quickhull {

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
  /// The face across an edge.
  int neighbour(int i) const { return edge(edge(i).twin).face; }
  /// Vertices of a face in order.
  std::vector<int> loop(int face) const;
  /// Calls visit(edge) around a face.
  template <class Visit>
  void for_each_edge(int face_index, const Visit& visit) const {
    const int first = face(face_index).edge;
    int e = first;
    do {
      visit(e);
      e = edge(e).next;
    } while (e != first);
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
  bool meet_in_one_edge(int one, int other);
  void measure(int face);
  void follow(int edge, int next);
  void restore_invariants(std::vector<int> vertices, std::vector<int>& changed);
  void remove_vertex(int vertex, std::vector<int>& vertices, std::vector<int>& changed);
  void remove_two_gon(int face, std::vector<int>& vertices);

  std::span<const Vec3d> points_;
  std::vector<Edge> edges_;
  std::vector<Face> faces_;
  std::vector<int> leaving_;  // for each point one half-edge that leaves it
  std::vector<int> stamps_;   // for each point the last query that saw it
  int stamp_ = 0;
  bool broken_ = false;
};

}  // namespace contactscope::quickhull
