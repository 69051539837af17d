#pragma once

#include <algorithm>
#include <set>
#include <string>

#include "trace/trace.h"

/// What is looked for in the facts of a frame.
namespace contactscope::trace {

/// Where a frame has a shape; nullptr where it is not there.
inline const Pose<double>* find_pose(const Frame& frame, const std::string& name) {
  const auto found = std::ranges::find(frame.poses, name, &Placement::first);
  return found == frame.poses.end() ? nullptr : &found->second;
}

/// What a frame's solver knows of a body; nullptr where it does not know it.
inline const Body* find_body(const Frame& frame, const std::string& name) {
  if (!frame.solver) return nullptr;
  const auto found = std::ranges::find(frame.solver->bodies, name, &Body::name);
  return found == frame.solver->bodies.end() ? nullptr : &*found;
}

/// The point of least separation of all manifolds of a pair; nullptr without points.
inline const Point* deepest_point(const Pair& pair) {
  const Point* deepest = nullptr;
  for (const Manifold& manifold : pair.manifolds)
    for (const Point& point : manifold.points)
      if (deepest == nullptr || point.separation < deepest->separation) deepest = &point;
  return deepest;
}

/// Names of the points of a pair, of a mesh with the triangle; points without one are left out.
inline std::multiset<std::string> point_ids(const Pair& pair) {
  std::multiset<std::string> ids;
  for (const Manifold& manifold : pair.manifolds)
    for (const Point& point : manifold.points)
      if (!point.id.empty())
        ids.insert(std::to_string(manifold.triangle.value_or(-1)) + " " + point.id);
  return ids;
}

}  // namespace contactscope::trace
