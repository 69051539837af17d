#pragma once

#include <algorithm>
#include <vector>

#include "trace/contact.h"

namespace contactscope::peers {

/// Adds a point to the manifold of its normal (unit, from a to b), which is created if missing.
inline void add_point(std::vector<trace::Manifold>& manifolds, const Vec3d& normal,
                      const Vec3d& position, double separation) {
  constexpr double kSame = 1 - 1e-6;  // cosine
  auto found = std::ranges::find_if(manifolds, [&](const trace::Manifold& manifold) {
    return manifold.normal.dot(normal) > kSame;
  });
  if (found == manifolds.end()) {
    found = manifolds.emplace(manifolds.end());
    found->normal = normal.normalized();
  }
  found->points.push_back({.position = position, .separation = separation, .id = {}});
}

}  // namespace contactscope::peers
