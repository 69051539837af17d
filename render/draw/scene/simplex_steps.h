#pragma once

#include <optional>
#include <vector>

#include "core/view.h"
#include "trace/trace.h"

/// Which step of GJK or EPA a frame shows.
namespace contactscope::draw {

/// What a frame shows of the algorithm that walks through the Minkowski difference.
struct SimplexStep {
  enum class Of { Gjk, Epa, Mpr } of = Of::Gjk;
  std::vector<trace::SimplexVertex> vertices;
  /// Of the vertices, by the order in which support points were found: a vertex keeps its number
  /// from step to step.
  std::vector<int> numbers;
  const trace::Polytope* polytope = nullptr;  // of EPA
  std::optional<trace::SimplexVertex> next;   // the support point that the next step adds
  int step = 0;                               // 1 is the first; 0: before it
  int steps = 0;                              // that there are
  bool last() const { return step == steps; }
};

/// With the story of a step a frame, frame k shows what there is after step k, and the last step from
/// there on; without one, the last step. Nothing where the pair has no such facts.
std::optional<SimplexStep> simplex_step(const View& view, const trace::Frame& frame,
                                        const trace::Pair& pair);

/// The point of the hull of one to four points that is nearest to the origin.
Vec3d nearest_to_origin(const std::vector<Vec3d>& points);

/// Of the Minkowski difference.
inline Vec3d difference(const trace::SimplexVertex& vertex) {
  return vertex.b - vertex.a;
}

}  // namespace contactscope::draw
