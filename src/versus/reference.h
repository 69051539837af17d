#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lint/claims.h"
#include "trace/json.h"

namespace contactscope::versus {

/// What is true of a pair in a frame, whatever engine is asked.
struct Truth {
  std::string a, b;
  /// Metres between the shapes, negative: how deep, along the direction of the least overlap. Empty of
  /// shapes that have none, as two meshes.
  std::optional<double> separation;
  double tolerance = 0;  // metres: nearer to touching than this, either answer is right
  /// Of the patch in which two convex shapes touch, before it is reduced, m^2; 0 of a point or a line.
  double area = 0;

  bool touches() const { return separation && *separation < -tolerance; }
  bool is_separated() const { return separation && *separation > tolerance; }
};

/// Metres between two shapes, negative: how deep. Of a mesh that nothing touches infinite; empty of shapes of which
/// nobody knows, as two meshes.
std::optional<double> separation_of(const lint::Placed& a, const lint::Placed& b);

/// Of each pair of a frame, in its order.
std::vector<Truth> truths_of(const lint::Solids& solids, const trace::Frame& frame);

/// Of the points of a manifold, seen along its normal.
double area_of(const trace::Manifold& manifold);

}  // namespace contactscope::versus
