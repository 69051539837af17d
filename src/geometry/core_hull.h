#pragma once

#include "core/feature_id.h"
#include "geometry/hull.h"

namespace contactscope {

/// The core of a hull for collision with a margin: all faces moved inward by the margin.
struct CoreHull {
  Hull<double> hull;     // in the frame of the original
  double margin = 0;     // metres; the distance by which the faces were moved
  bool reduced = false;  // `margin` is less than requested

  // The original feature, owner A, of each vertex, edge and face of the core. If moving the faces
  // splits a vertex with four or more, the new edges are that vertex.
  std::vector<FeatureRef> vertices;
  std::vector<FeatureRef> edges;
  std::vector<FeatureRef> faces;
};

/// Maximum margin, as a fraction of the distance from the centroid to the nearest face. The
/// remaining core is thick enough for closest points.
inline constexpr double kLargestCoreShare = 0.5;

/// Intersects the half-spaces behind the moved faces. Vertices, faces and (if no feature is lost or
/// split) edges keep the original's order. `margin` in metres, >= 0 and finite; 0 returns the hull.
/// A margin that is too large is reduced to kLargestCoreShare, or to zero if no core can be built
/// at all, for example if a vertex has more than kMaxFaceVertices faces.
///
/// A vertex of three faces is on the moved planes within rounding. More than three faces that meet
/// within the hull builder's tolerance give one vertex, closest to all of them; it was measured up
/// to 5e-6 of the hull's radius off a plane, at corners of ten to one.
CoreHull core_hull(const Hull<double>& hull, double margin);

}  // namespace contactscope
