#pragma once

#include "core/input_error.h"
#include "geometry/hull.h"

namespace contactscope {

/// Builds a half-edge hull from its boundary polygons: `faces` are vertex indices,
/// counter-clockwise seen from outside. Vertices and faces keep their order, face_edges[f] starts
/// at faces[f][0], and edges are numbered by first use in the faces. Planes are computed by
/// Newell's method through the mean of the face's vertices; centroid and radius belong to the
/// solid. Two faces make a flat hull, on the plane of the first.
///
/// The caller guarantees convexity and planarity. Throws ShapeError if the polygons do not bound
/// one solid without handles, leave a vertex unused, or if a face has more than kMaxFaceVertices.
Hull<double> hull_from_polygons(std::vector<Vec3d> vertices,
                                const std::vector<std::vector<int>>& faces);

struct HullOptions {
  /// Merge points with equal coordinates. Otherwise they are an error that names two of them: in a
  /// hand-written list a repeated vertex is a typo. Turn it on for file formats that repeat
  /// vertices on purpose (or weld while reading, as load_vertices does).
  bool weld_duplicates = false;

  /// Allow three or more points within rounding of one plane to make a flat hull: their convex
  /// polygon without collinear corners. Otherwise they are an error.
  bool allow_flat = false;

  /// Precision of the coordinates, relative to the points' extent.
  double epsilon = std::numeric_limits<float>::epsilon();

  /// The hull is for float arithmetic. If its edges are so short that rounding would turn them, the
  /// points are rounded first and the faces are built from the rounded points.
  bool for_float = false;
};

/// Convex hull of `points` (metres, any frame, any order; points inside or on the surface are
/// dropped). Merges faces that are coplanar or concave within a tolerance: hull_tolerance of the
/// points, less for a hull thinner than a hundred tolerances. Vertices lie on the planes of their
/// faces, and no point lies above any plane, within ten times that. If points are so close together
/// that merging would turn the edges between them, only merges that do not are done (see
/// quickhull::kSteepest). The outline of every face is convex; to ensure this, points with noise of
/// about the tolerance can leave coplanar neighbours unmerged. Vertices keep their coordinates and
/// order. The same points always give the same hull.
///
/// Throws ShapeError for too few points (also after welding), a coordinate that is not finite, a
/// repeated point, points that coincide, are collinear, or are coplanar unless allowed, a face with
/// more than kMaxFaceVertices, and if no tolerance gives a convex hull.
///
/// Source: Gregorius, "Implementing Quickhull", GDC 2014.
Hull<double> build_hull(std::span<const Vec3d> points, const HullOptions& options = {});

/// HullOptions::epsilon for double arithmetic, derived from the number of decimal digits: float's
/// epsilon for up to nine digits or if every coordinate is a float; otherwise one unit in the last
/// digit, but no less than what a few operations in double lose.
double epsilon_of_digits(std::span<const Vec3d> points);

/// Distance from a plane within which a point counts as on it, metres: the uncertainty of points of
/// this extent in single precision. Derived in hull_builder.cpp.
double hull_tolerance(std::span<const Vec3d> points,
                      double epsilon = std::numeric_limits<float>::epsilon());

}  // namespace contactscope
