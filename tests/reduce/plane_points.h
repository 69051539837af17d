#pragma once

#include <string>
#include <vector>

#include "reduce/reducer.h"

namespace contactscope::test {

/// A contact point in the x-z plane.
struct PlanePoint {
  double x = 0;
  double z = 0;
  double depth = 0;
};

template <class S = double>
std::vector<ContactPoint<S>> points_at(const std::vector<PlanePoint>& places) {
  std::vector<ContactPoint<S>> points;
  for (const PlanePoint& place : places) {
    points.push_back(
        {Vec3d(place.x, 0, place.z).cast<S>(), static_cast<S>(-place.depth), FeatureId{}});
  }
  return points;
}

/// The indices that the reducer `name` keeps of points in the x-z plane, in its order.
template <class S>
std::vector<int> kept_by(const std::string& name, const std::vector<ContactPoint<S>>& points,
                         const ReduceOptions& options = {}) {
  const Vec3<S> up = Vec3<S>::UnitY();
  const KeptIndices kept = reduce<S>(find_reducer(name), points, up, options);
  return {kept.begin(), kept.end()};
}

template <class S>
std::vector<int> kept_by(const std::string& name, const std::vector<ContactPoint<S>>& points,
                         int max_points) {
  ReduceOptions options;
  options.max_points = max_points;
  return kept_by(name, points, options);
}

}  // namespace contactscope::test
