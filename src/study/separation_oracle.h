#pragma once

#include <utility>
#include <vector>

#include "core/pose.h"
#include "geometry/shape.h"

/// Separations of placed shapes in extended precision, taking what the pipeline is given as exact:
/// coordinates and radii as they are, rotations made unit. They share nothing with the queries that
/// they judge.
namespace contactscope {

/// An axis and the separation along it, metres, negative in overlap.
struct OracleAxis {
  double separation = 0;
  Vec3d normal = Vec3d::UnitX();  // unit, from A to B, in A's frame
};

/// The axis of largest separation of two hulls, over all faces of their Minkowski difference. Meant
/// for hulls that overlap; of separated ones it is a lower bound of the distance.
///
/// Source: Gregorius, "The Separating Axis Test between Convex Polyhedra", GDC 2013. Steps: each
/// face plane of either hull against every vertex of the other; each pair of edges whose arcs cross
/// on the Gauss map by the talk's IsMinkowskiFace, its distance by the talk's Project. Face normals
/// are made anew from the vertices.
OracleAxis oracle_axis(const Hull<double>& a, const Hull<double>& b, const Pose<double>& b_in_a);

/// A placed shape as an oracle sees it.
struct OracleBody {
  using Real = long double;
  using Vec = Vec3<Real>;

  /// What is left of a convex shape without its radius.
  struct Core {
    std::vector<Vec> vertices;
    std::vector<std::pair<Vec, Vec>> edges;  // a point is an edge without length
    std::vector<std::vector<Vec>> faces;     // counter-clockwise from outside
    std::vector<Vec> normals;                // of the faces
    Real radius = 0;
  };

  std::vector<Core> cores;  // of a mesh one a triangle
  bool is_plane = false;
  Vec normal = Vec::Zero();  // of a plane
  Real offset = 0;
  Real reach = 0;
};

/// The signed distance of two placed shapes of any kinds.
///
/// A sphere is a point with a radius, a capsule a segment with one; the distance is that of the
/// cores less the radii. Cores apart: the least distance over all vertices, edges and faces.
/// Cores that overlap: the largest separation over all axes, which are the face normals of both and
/// the cross products of all pairs of edges, each measured over all vertices. A triangle of a mesh
/// is a core with two faces, and the mesh as far as its nearest triangle.
class SeparationOracle {
 public:
  template <class S>
  SeparationOracle(const Shape<S>& a, const Pose<S>& pose_a, const Shape<S>& b,
                   const Pose<S>& pose_b);

  /// Metres, negative in overlap.
  double separation() const;

  /// Along a normal from A to B, metres: never more than separation() but for rounding, and as much
  /// along a normal of least overlap. `triangle` is the mesh's, -1 where there is none. Against a
  /// plane only its own normal counts: any other one costs what it is off.
  double separation_along(const Vec3d& normal, int triangle) const;

  /// How far the direction of a normal may magnify rounding, >= 1. That between closest points is
  /// known as well as the points over their distance, so it is scale() over the distance of the cores
  /// where these are apart (+infinity where they meet), and 1 for axes of faces and edges.
  double leverage() const;

  /// Coordinates of the pair that round, metres: how far each shape reaches from its own origin,
  /// and the way between the origins.
  double scale() const { return static_cast<double>(scale_); }

 private:
  OracleBody a_, b_;             // as seen from A
  Mat3<OracleBody::Real> to_a_;  // turns directions of the world into it
  OracleBody::Real scale_ = 0;
};

}  // namespace contactscope
