#pragma once

#include <array>

#include "core/vec3.h"

namespace contactscope {

/// A corner of a mesh that deforms: in the step it goes straight from one place to the other at
/// constant speed. Metres, both in one frame.
template <class S>
struct MovingCorner {
  Vec3<S> start, end;

  /// At time 0 to 1.
  Vec3<S> at(S time) const { return start + time * (end - start); }
};

template <class S>
using MovingEdge = std::array<MovingCorner<S>, 2>;
template <class S>
using MovingFace = std::array<MovingCorner<S>, 3>;

enum class FeatureStatus {
  Separated,  // at no time of the step nearer than the gap: proved
  Hit,        // they meet between `begin` and `end`: proved, rounding included
  Near,       // at `begin` nearer than rounding, or than one can follow: may be a hit, may be none
  Overlapping,  // at time 0 already, or so near that rounding cannot tell
};

/// "separated", "hit", "near", "overlapping".
constexpr const char* to_string(FeatureStatus status) {
  constexpr const char* kNames[] = {"separated", "hit", "near", "overlapping"};
  return kNames[static_cast<int>(status)];
}

/// When two features first meet. Who must not miss a contact takes Near for one.
struct FeatureImpact {
  FeatureStatus status = FeatureStatus::Separated;
  double begin = 1;  // fraction of the step: before it they are apart for certain, whatever status
  double end = 1;    // of a Hit: at this time or before they have met
  double distance = 0;  // metres, at `begin`; of meaning unless Separated
  Vec3d normal =
      Vec3d::UnitX();  // unit, from the first feature to the second, at `begin`; likewise
  /// Where on the features: of a face the weights of its corners 1 and 2, of edges the fraction from
  /// corner 0 of the first and of the second.
  double u = 0, v = 0;
  int steps = 0;  // distances measured; 0 where a coordinate axis told them apart
};

/// Each step follows the features until an axis no longer keeps them apart. What misses takes one, what
/// hits three to six; 57 were the most of a quarter of a million cases, most of them made to be hard.
inline constexpr int kMaxFeatureSteps = 256;

/// When a vertex and a triangle, or two edges, first meet of which every corner moves on its own
/// straight line. Never a miss: a hit is reported for all that come within `gap` (metres, no less
/// than some 1e-14 of the largest difference of coordinates) at any time, by the very coordinates
/// given.
///
/// With a gap of 0 a Hit is proved to be one: the equation of contact has a root between `begin` and
/// `end`. What touches only a border of a feature cannot be proved in rounded arithmetic and is Near.
/// With a gap > 0 a Hit is within it but for rounding.
///
/// Differences of coordinates are taken first: nothing is lost far from the origin. Edges of no
/// length, flat triangles, features at rest and motion in one plane are fine. Where differences are
/// outside of 1e-45 m to 1e45 m, or no numbers, the answer is Near from time 0 on.
///
/// Idea: an answer that holds whatever the rounding, for the bilinear equations of contact: Snyder
/// 1992, "Interval Analysis for Computer Graphics"; Wang, Ferguson, Schneider, Jiang, Attene and Panozzo
/// 2021, "A Large-Scale Benchmark and an Inclusion-Based Algorithm for Continuous Collision
/// Detection". They halve boxes of time and place. We deviate: see FeatureSearch.
///
/// What is later than `until`, a fraction of the step, nobody asks: it may be told as Separated.
template <class S>
FeatureImpact impact_of_vertex_face(const MovingCorner<S>& vertex, const MovingFace<S>& face,
                                    double gap = 0, double until = 1);
template <class S>
FeatureImpact impact_of_edges(const MovingEdge<S>& a, const MovingEdge<S>& b, double gap = 0,
                              double until = 1);

}  // namespace contactscope
