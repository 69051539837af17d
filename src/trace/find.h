#pragma once

#include "trace/trace.h"

/// Lookups in the facts of a frame.
namespace contactscope::trace {

/// Pose of a shape in a frame; nullptr if it is not there.
inline const Pose<double>* find_pose(const Frame& frame, const std::string& name) {
  const auto found = std::ranges::find(frame.poses, name, &Placement::first);
  return found == frame.poses.end() ? nullptr : &found->second;
}

/// State of a body in a frame's solver; nullptr if unknown.
inline const Body* find_body(const Frame& frame, const std::string& name) {
  if (!frame.solver) return nullptr;
  const auto found = std::ranges::find(frame.solver->bodies, name, &Body::name);
  return found == frame.solver->bodies.end() ? nullptr : &*found;
}

/// The point with the smallest separation in all manifolds of a pair; nullptr without points.
inline const Point* deepest_point(const Pair& pair) {
  const Point* deepest = nullptr;
  for (const Manifold& manifold : pair.manifolds)
    for (const Point& point : manifold.points)
      if (deepest == nullptr || point.separation < deepest->separation) deepest = &point;
  return deepest;
}

/// Overlap of a pair in contact, metres; 0 without points or overlap.
inline double overlap_of(const Pair& pair) {
  const Point* const deepest = deepest_point(pair);
  return deepest == nullptr ? 0 : std::max(0.0, -deepest->separation);
}

/// Sum of the normal impulses of a pair, newton seconds.
inline double impulse_of(const Pair& pair) {
  double sum = 0;
  for (const Manifold& manifold : pair.manifolds)
    for (const Point& point : manifold.points)
      if (point.impulse) sum += point.impulse->normal;
  return sum;
}

/// Ids of a pair's points, with the triangle for a mesh; points without an id are skipped.
inline std::multiset<std::string> point_ids(const Pair& pair) {
  std::multiset<std::string> ids;
  for (const Manifold& manifold : pair.manifolds)
    for (const Point& point : manifold.points)
      if (!point.id.empty())
        ids.insert(std::to_string(manifold.triangle.value_or(-1)) + " " + point.id);
  return ids;
}

// point_names.cpp

/// Creates ids from geometry for pairs without any, in the format of FeatureId: the two edges that
/// cross at the point, seen along the normal, or the feature of each shape that it lies on. This
/// lets points of engines without ids be tracked between frames. `shapes` must contain all shapes
/// of the frame, with faces and edges. Points on a distance field get no ids. If a mesh manifold
/// names no triangle, the mesh is searched for it, up to 20,000 triangles. True if it names any.
bool name_points(const std::vector<Shape>& shapes, Frame& frame);

}  // namespace contactscope::trace
