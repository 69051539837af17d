#pragma once

#include <span>

#include "core/vec3.h"
#include "geometry/hull.h"
#include "geometry/shape_error.h"

namespace contactscope {

struct HullOptions {
  /// Points with equal coordinates count once. Off, they are an error that names two of them: in a
  /// hand-written list a repeated vertex is a slip of the pen. File formats that repeat vertices on
  /// purpose turn it on (or weld while reading, as load_obj_vertices does).
  bool weld_duplicates = false;

  /// Off, every face is left in triangles (see triangulate_faces), as by a builder that does not
  /// merge. For comparison: clipping then misses parts of a manifold. Quickhull merges all the same
  /// while it grows, because the planes of slivers say nothing, and the faces are cut afterwards.
  /// The two faces of a flat hull stay whole.
  bool merge_coplanar = true;

  /// Points within rounding of one plane, three of them or more, make a flat hull: their convex
  /// polygon, without corners on the line between their neighbours. Off, they are an error.
  bool allow_flat = false;
};

/// Convex hull of `points` (metres, any frame, any order; points inside or on the surface are left
/// out). Faces are merged where they are coplanar or concave within a tolerance: hull_tolerance of
/// the points, less for a hull thinner than a hundred of those. A vertex lies on its faces' planes,
/// and no point above any plane, within ten times that. Every face's outline is convex; for the
/// sake of that, points whose noise is about the tolerance can leave coplanar neighbours unmerged.
/// Vertices keep their coordinates and their order; the same points always give the same hull.
///
/// Throws ShapeError for too few points, as given or when welded; a coordinate that is not finite; a
/// repeated point; points in one place, on one line, or on one plane unless allowed; a face of more
/// than kMaxFaceVertices; and should no tolerance give a convex hull.
///
/// Source: Gregorius, "Implementing Quickhull", GDC 2014.
Hull<double> build_hull(std::span<const Vec3d> points, const HullOptions& options = {});

/// How far a point may be off a plane and still count as on it, metres: what single precision
/// leaves uncertain about points of this extent. hull_builder.cpp says why.
double hull_tolerance(std::span<const Vec3d> points);

/// The same solid with every face cut into triangles: what a hull is whose coplanar faces nobody
/// merged. Vertices, centroid and radius stay; triangles follow each other in the order of the
/// faces that they come from. Each keeps the plane of its face, so that the triangles of one face
/// tie exactly and a sliver is not tilted by its rounding. All other promises of Hull hold, but one:
/// an edge inside a face joins two faces with one plane.
///
/// A face stays whole where cutting it would join two vertices that have an edge already. That takes
/// faces that overlap within the hull builder's tolerance, or a hull without volume.
///
/// Clipping then sees only a part of the incident face, and is cut by a part of the reference face:
/// Gregorius 2015, "Hull vs Hull: Coplanar Faces".
Hull<double> triangulate_faces(const Hull<double>& hull);

}  // namespace contactscope
