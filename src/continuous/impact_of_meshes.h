#pragma once

#include <cstdint>
#include <span>

#include "continuous/moving_features.h"
#include "geometry/mesh.h"

namespace contactscope {

/// A mesh that deforms or moves in a step, each vertex on a straight line. Refers to both.
template <class S>
struct MovingMesh {
  const Mesh<S>& start;          // vertices and tree at time 0
  std::span<const Vec3<S>> end;  // where its vertices are at time 1, in the same frame, metres
};

/// What the search for the first time cost.
struct MeshImpactCounts {
  std::int64_t node_pairs = 0;      // swept boxes of nodes tested against each other
  std::int64_t triangle_pairs = 0;  // triangles whose swept boxes overlap before the best time
  std::int64_t feature_pairs = 0;   // of these: vertex against face and edge against edge
};

struct MeshImpact {
  FeatureImpact impact;                  // of the features that are first
  int triangle_a = -1, triangle_b = -1;  // to which they belong; -1 when Separated
  /// Corner 0 to 2 of the triangle, or its edge from that corner on; -1 where the feature is its face,
  /// and of both where triangles overlap at the start.
  int feature_a = -1, feature_b = -1;
  bool is_edges = false;  // else a vertex against a face, or the other way round
  MeshImpactCounts counts;
};

/// The first time in a step at which two meshes that deform are within `gap` metres of each other, both
/// in one frame. Never late, as impact_of_vertex_face() and impact_of_edges() are not: triangles that
/// are apart at the start meet first by one of these. Triangles that share a point at the start, which
/// is found exactly, are Overlapping, whatever comes later. A Near that is before every Hit is the
/// answer. Both have to have as many ends as vertices.
///
/// Boxes of the same node at the start and at the end, with the straight way between them, hold what
/// is below the node at every time. So two nodes are asked from the time on at which such boxes first
/// overlap, the earlier first, and none after the best time. A vertex or an edge that triangles
/// share is asked once: one of its triangles owns it (Curtis, Tamstorf and Manocha 2008, "Fast
/// Collision Detection for Deformable Models Using Representative-Triangles").
template <class S>
MeshImpact impact_of_meshes(const MovingMesh<S>& a, const MovingMesh<S>& b, double gap = 0);

}  // namespace contactscope
