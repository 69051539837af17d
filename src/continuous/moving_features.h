#pragma once

#include "core/vec3.h"

namespace contactscope {

/// Vertex of a deforming mesh: on a straight line at constant speed in the step. Metres.
template <class S> struct MovingCorner {
  Vec3<S> start, end;
  Vec3<S> at(S time) const { return start + time * (end - start); }
};

template <class S> using MovingEdge = std::array<MovingCorner<S>, 2>;
template <class S> using MovingFace = std::array<MovingCorner<S>, 3>;

enum class FeatureStatus {
  Separated,    // at all times of the step: proved
  Hit,          // they meet between `begin` and `end`: proved, including rounding
  Near,         // at `begin` closer than rounding or the search can resolve: possibly a hit
  Overlapping,  // at time 0, or closer than rounding then
};

constexpr const char* to_string(FeatureStatus status) {
  constexpr const char* kNames[] = {"separated", "hit", "near", "overlapping"};
  return kNames[static_cast<int>(status)];
}

/// First impact of two features. Callers that must not miss a contact treat Near as a Hit.
struct FeatureImpact {
  FeatureStatus status = FeatureStatus::Separated;
  double begin = 1;     // fraction of the step; separated before it, whatever the status
  double end = 1;       // of a Hit: they have met by this time
  double distance = 0;  // metres, at `begin`; valid unless Separated
  Vec3d normal =
      Vec3d::UnitX();  // unit, from the first feature to the second, at `begin`; likewise
  /// Contact point: the weights of a face's corners 1 and 2, or the fractions of both edges.
  double u = 0, v = 0;
  int steps = 0;  // distances measured; 0: separated along a coordinate axis
};

/// Each step follows the features until an axis no longer separates them. Misses take one step,
/// hits three to six; the maximum of a quarter of a million mostly hard cases was 57.
inline constexpr int kMaxFeatureSteps = 256;

/// First impact of a vertex and a triangle, or of two edges, when every corner moves on its own
/// straight line. Never misses, for exactly the given coordinates.
///
/// A Hit is proved: the equation of contact has a root between `begin` and `end`. A contact at the
/// border of a feature cannot be proved in rounded arithmetic and is Near.
///
/// Coordinates are subtracted first, so nothing is lost far from the origin. Edges of zero length,
/// flat triangles, features at rest and motion in one plane are fine. If differences are outside
/// 1e-45 m to 1e45 m, or not numbers, the answer is Near from time 0 on.
///
/// Idea: an answer that holds for any rounding, for the bilinear equations of contact: Snyder 1992,
/// "Interval Analysis for Computer Graphics"; Wang, Ferguson, Schneider, Jiang, Attene and Panozzo
/// 2021, "A Large-Scale Benchmark and an Inclusion-Based Algorithm for Continuous Collision
/// Detection". They bisect boxes of time and place. We deviate: see FeatureSearch.
///
/// Impacts later than `until`, a fraction of the step, may be reported as Separated.
template <class S>
FeatureImpact impact_of_vertex_face(const MovingCorner<S>& vertex, const MovingFace<S>& face,
                                    double until = 1);
template <class S>
FeatureImpact impact_of_edges(const MovingEdge<S>& a, const MovingEdge<S>& b, double until = 1);

}  // namespace contactscope
