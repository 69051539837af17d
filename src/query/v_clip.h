#pragma once

#include "query/hull_feature.h"

/// The distance of two hulls by walking over their features: Mirtich 1998, "V-Clip: Fast and Robust
/// Polyhedral Collision Detection"; the lecture's "V-Clip".
namespace contactscope {

/// A feature of each hull.
struct ComparedFeatures {
  HullFeature a, b;
  bool operator==(const ComparedFeatures&) const = default;
};

enum class VClipStatus { Separated, Overlap, OutOfSteps };

constexpr const char* to_string(VClipStatus status) {
  constexpr const char* kNames[] = {"separated", "overlap", "out_of_steps"};
  return kNames[static_cast<int>(status)];
}

template <class S> struct VClipResult {
  VClipStatus status = VClipStatus::OutOfSteps;
  S distance = 0;             // metres; 0 in overlap
  Vec3<S> on_a, on_b;         // closest points in A's frame; undefined in overlap
  ComparedFeatures features;  // the closest ones, or the last in overlap
  int steps = 0;              // pairs of features after the first
};

/// Two features are closest if each has a point in the other's Voronoi region that is closest to
/// the other: the points of space that are closer to it than to any other feature of its hull. A
/// feature that leaves the region through a plane names the neighbour that is closer, so the walk
/// goes there. Every step has a smaller distance, or the same and features of fewer dimensions.
///
/// `start`: the features of an earlier call, or null for the first vertices. A hull must have a
/// volume. `walk`, if any, becomes all pairs of features in order.
template <class S>
VClipResult<S> v_clip(const Hull<S>& a, const Hull<S>& b, const Pose<S>& b_in_a,
                      const ComparedFeatures* start = nullptr,
                      std::vector<ComparedFeatures>* walk = nullptr);

}  // namespace contactscope
