#pragma once

#include <limits>
#include <span>
#include <vector>

#include "core/input_error.h"
#include "core/vec3.h"
#include "geometry/hull.h"

namespace contactscope {

/// Half-edge hull from the polygons that bound it: `faces` are vertex indices, counter-clockwise
/// seen from outside. Vertices and faces keep their order, face_edges[f] leaves faces[f][0], and
/// edges are numbered in the order in which the faces first name them. Planes by Newell's method
/// through the mean of all vertices of the face; centroid and radius from the solid. Two faces make a
/// flat hull, on the plane of the first.
///
/// Topology is checked, convexity and planarity are the caller's promise. Throws ShapeError when the
/// polygons do not bound one solid without handles or leave a vertex unused, and for a face with more
/// than kMaxFaceVertices.
Hull<double> hull_from_polygons(std::vector<Vec3d> vertices,
                                const std::vector<std::vector<int>>& faces);

struct HullOptions {
  /// Points with equal coordinates count once. Off, they are an error that names two of them: in a
  /// hand-written list a repeated vertex is a slip of the pen. File formats that repeat vertices on
  /// purpose turn it on (or weld while reading, as load_obj_vertices does).
  bool weld_duplicates = false;

  /// Points within rounding of one plane, three of them or more, make a flat hull: their convex
  /// polygon, without corners on the line between their neighbours. Off, they are an error.
  bool allow_flat = false;

  /// How exact the coordinates are, as a part of the points' extent.
  double epsilon = std::numeric_limits<float>::epsilon();

  /// The hull is for float arithmetic. Where it has edges so short that rounding their vertices would
  /// turn them, its points are rounded first, and its faces are those of the rounded points.
  bool for_float = false;
};

/// Convex hull of `points` (metres, any frame, any order; points inside or on the surface are left
/// out). Faces are merged where they are coplanar or concave within a tolerance: hull_tolerance of
/// the points, less for a hull thinner than a hundred of those. A vertex lies on its faces' planes,
/// and no point above any plane, within ten times that. Where points lie so close together that merging
/// would turn the edges between them, only faces are merged that do not (see quickhull::kSteepest).
/// Every face's outline is convex; for the sake of that, points whose noise is about the tolerance
/// can leave coplanar neighbours unmerged.
/// Vertices keep their coordinates and their order; the same points always give the same hull.
///
/// Throws ShapeError for too few points, as given or when welded; a coordinate that is not finite; a
/// repeated point; points in one place, on one line, or on one plane unless allowed; a face of more
/// than kMaxFaceVertices; and should no tolerance give a convex hull.
///
/// Source: Gregorius, "Implementing Quickhull", GDC 2014.
Hull<double> build_hull(std::span<const Vec3d> points, const HullOptions& options = {});

/// HullOptions::epsilon of points for double arithmetic, by the digits that they are written with: that
/// of float for up to nine digits, and where every coordinate is a float; else one in the last digit, but
/// not less than what some operations in double lose.
double epsilon_of_digits(std::span<const Vec3d> points);

/// How far a point may be off a plane and still count as on it, metres: what single precision
/// leaves uncertain about points of this extent. hull_builder.cpp says why.
double hull_tolerance(std::span<const Vec3d> points,
                      double epsilon = std::numeric_limits<float>::epsilon());

}  // namespace contactscope
