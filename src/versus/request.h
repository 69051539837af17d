#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lint/claims.h"
#include "trace/json.h"

namespace contactscope::versus {

/// Keeps the pairs to query engines for: the first of several with different settings of this
/// program, and no pair with a query other than for contacts.
void keep_queried_pairs(trace::Frame& frame);

/// A request to an engine: the shapes, poses and pairs of a trace without contacts.
trace::Trace request_of(const trace::Trace& whole);

/// This program's contacts for a request, in double with default settings, for use without a
/// scenario.
trace::Trace own_contacts(const trace::Trace& request);

/// As JSON lines.
std::string to_text(const trace::Trace& trace);

/// Ground truth of a pair in a frame, independent of engines.
struct Truth {
  std::string a, b;
  /// Metres between the shapes, negative: penetration along the direction of least overlap. Empty
  /// if it cannot be computed, as for two meshes.
  std::optional<double> separation;
  double tolerance = 0;  // metres: within it of touching, either answer is right
  /// Contact patch of two convex shapes before reduction, m^2; 0 for a point or a line.
  double area = 0;

  bool touches() const { return separation && *separation < -tolerance; }
  bool is_separated() const { return separation && *separation > tolerance; }
};

/// For each pair of a frame, in order.
std::vector<Truth> truths_of(const lint::Solids& solids, const trace::Frame& frame);

/// Area of a manifold's points, seen along its normal.
double area_of(const trace::Manifold& manifold);

}  // namespace contactscope::versus
