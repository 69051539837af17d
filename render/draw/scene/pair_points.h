#pragma once

#include <vector>

#include "draw/scene/sequence_scales.h"
#include "trace/trace.h"

/// Which points a pair has.
namespace contactscope::draw {

/// A point with the manifold that it is of, both of the pair.
struct PairPoint {
  const trace::Manifold* manifold;
  const trace::Point* point;
};

std::size_t point_count(const trace::Pair& pair);

/// The points of all manifolds.
std::vector<PairPoint> all_points(const trace::Pair& pair);

/// Those of them that were kept, as the reducer saw them where it is recorded: of several manifolds
/// each was reduced by itself, and the record holds one of these.
std::vector<PairPoint> kept_points(const trace::Pair& pair);

/// A corner that the side planes cut away and that was kept all the same, because nothing else was
/// left: the contact point is above it on the reference face.
bool is_kept(const trace::Pair& pair, const trace::DroppedPoint& dropped);

/// The point is in the manifold although the shapes do not touch there, because they are within its
/// margin.
inline bool stands_off(const trace::Point& point, const SequenceScales& scales) {
  return point.separation > scales.touching;
}

}  // namespace contactscope::draw
