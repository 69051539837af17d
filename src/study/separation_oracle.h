#pragma once

#include "geometry/obb.h"
#include "geometry/shape.h"

/// Separations of placed shapes in extended precision. The pipeline's input is taken as exact:
/// coordinates and radii unchanged, rotations normalised. Shares no code with the tested queries.
namespace contactscope {

/// An axis and the separation along it, metres, negative if overlapping.
struct OracleAxis {
  double separation = 0;
  Vec3d normal = Vec3d::UnitX();  // unit, from A to B, in A's frame
};

/// The axis of largest separation of two hulls, over all faces of their Minkowski difference. For
/// overlapping hulls; for separated ones it is a lower bound of the distance.
///
/// Source: Gregorius, "The Separating Axis Test between Convex Polyhedra", GDC 2013. Steps: each
/// face plane of either hull against every vertex of the other; each pair of edges whose arcs cross
/// on the Gauss map by the talk's IsMinkowskiFace, its distance by the talk's Project. Face normals
/// are recomputed from the vertices.
OracleAxis oracle_axis(const Hull<double>& a, const Hull<double>& b, const Pose<double>& b_in_a);

/// The largest separation of two boxes over their fifteen axes, metres, negative in overlap. Cross
/// products too short for long double are below 1e-16, where faces suffice.
template <class S> double box_separation(const Obb<S>& a, const Obb<S>& b);

/// A placed shape for the oracle.
struct OracleBody {
  using Real = long double;
  using Vec = Vec3<Real>;

  /// A convex shape without its radius.
  struct Core {
    std::vector<Vec> vertices;
    std::vector<std::pair<Vec, Vec>> edges;  // a point is an edge of length 0
    std::vector<std::vector<Vec>> faces;     // counter-clockwise from outside
    std::vector<Vec> normals;                // of the faces
    Real radius = 0;
  };

  std::vector<Core> cores;  // one per triangle for a mesh
  bool is_plane = false;
  Vec normal = Vec::Zero();  // for a plane
  Real offset = 0;
  Real reach = 0;
};

/// The signed distance of two placed shapes of any kinds.
///
/// A sphere is a point with a radius, a capsule a segment with one; the distance is that of the
/// cores minus the radii. Separated cores: the minimum distance over all vertices, edges and faces.
/// Overlapping cores: the largest separation over all axes (face normals of both and cross products
/// of all pairs of edges), each measured over all vertices. A triangle of a mesh is a core with two
/// faces; a mesh is as far as its nearest triangle.
class SeparationOracle {
 public:
  template <class S>
  SeparationOracle(const Shape<S>& a, const Pose<S>& pose_a, const Shape<S>& b,
                   const Pose<S>& pose_b);

  /// Metres, negative if overlapping.
  double separation() const;

  /// Along a normal from A to B, metres: at most separation() up to rounding, equal along a normal
  /// of least overlap. `triangle`: the mesh's, or -1. A plane penalises normals other than its own.
  double separation_along(const Vec3d& normal, int triangle) const;

  /// Factor >= 1 by which the direction of a normal may magnify rounding. A normal between closest
  /// points of separated cores is as accurate as the points over their distance, so it is scale()
  /// over that distance (+infinity if they meet). 1 for axes of faces and edges.
  double leverage() const;

  /// Magnitude of the coordinates, metres: each shape's reach, plus the distance of their origins.
  double scale() const { return static_cast<double>(scale_); }

 private:
  OracleBody a_, b_;             // relative to A
  Mat3<OracleBody::Real> to_a_;  // rotates directions from the world into A's frame
  OracleBody::Real scale_ = 0;
};

}  // namespace contactscope
