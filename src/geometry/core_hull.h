#pragma once

#include <vector>

#include "core/feature_id.h"
#include "geometry/hull.h"

namespace contactscope {

/// The core of a hull with a margin: all of its faces moved inward by the margin.
struct CoreHull {
  Hull<double> hull;     // own frame of the original
  double margin = 0;     // metres; how far the faces were moved
  bool reduced = false;  // less than was asked for

  // The feature of the original hull that each vertex, edge and face of the core stands for, owner
  // A. Where moving the faces splits a vertex of four or more, the edge between the parts stands
  // for the vertex.
  std::vector<FeatureRef> vertices;
  std::vector<FeatureRef> edges;
  std::vector<FeatureRef> faces;
};

/// A core no thinner than this leaves room for the closest points: the margin is at most this share
/// of the distance from the centroid to the nearest face.
inline constexpr double kLargestCoreShare = 0.5;

/// The half-spaces behind the moved faces, intersected. Vertices, faces and (where no feature is
/// lost or split) edges are in the order of the original's. `margin` in metres, >= 0 and finite: 0
/// gives the hull itself. A margin that is too large is reduced to kLargestCoreShare; where no core
/// can be built at all, as of a vertex with more than kMaxFaceVertices faces, it is reduced to zero.
///
/// Vertices are on the moved planes within rounding where three faces meet. Where more than three
/// do within the tolerance of the hull builder there is one vertex, nearest to all of them: measured
/// up to 5e-6 of the hull's radius off a plane, at corners of ten to one.
CoreHull core_hull(const Hull<double>& hull, double margin);

}  // namespace contactscope
