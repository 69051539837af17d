#pragma once

#include <optional>
#include <vector>

#include "trace/trace.h"
#include "view/view.h"

/// The step of GJK or EPA that a frame shows.
namespace contactscope::draw {

/// State of the algorithm in the Minkowski difference, as a frame shows it.
struct SimplexStep {
  enum class Of { Gjk, Epa, Mpr } of = Of::Gjk;
  std::vector<trace::SimplexVertex> vertices;
  /// For each vertex, its place in the order of discovery; it is constant from step to step.
  std::vector<int> numbers;
  const trace::Polytope* polytope = nullptr;  // of EPA
  std::optional<trace::SimplexVertex> next;   // support point that the next step adds
  int step = 0;                               // from 1; 0: before the first
  int steps = 0;                              // number of steps
  bool last() const { return step == steps; }
};

/// If the view shows steps, frame k shows the state after step k, and later frames the last step.
/// Otherwise the last step. Nothing if the pair has no such record.
std::optional<SimplexStep> simplex_step(const View& view, const trace::Frame& frame,
                                        const trace::Pair& pair);

/// Point nearest to the origin in the convex hull of one to four points.
Vec3d nearest_to_origin(const std::vector<Vec3d>& points);

/// Point of the Minkowski difference.
inline Vec3d difference(const trace::SimplexVertex& vertex) { return vertex.b - vertex.a; }

}  // namespace contactscope::draw
