#pragma once

#include <string>
#include <vector>

#include "snapshot/changes.h"
#include "trace/trace.h"

/// What differs between two records of one stage, a part of a sentence each.
namespace contactscope::snapshot {

/// "sat edge pair 3-7 gone", "sat edge pair 3-7: separation -0.0050 -> -0.0037".
void compare_edge_pairs(const std::vector<trace::EdgePair>& expected,
                        const std::vector<trace::EdgePair>& actual, const Tolerance& tolerance,
                        std::vector<std::string>& parts);

/// Polytopes, portals and directions by their place in the sequence.
void compare_penetration(const trace::Penetration& expected, const trace::Penetration& actual,
                         const Tolerance& tolerance, std::vector<std::string>& parts);

void compare_minkowski(const trace::Minkowski& expected, const trace::Minkowski& actual,
                       const Tolerance& tolerance, std::vector<std::string>& parts);

/// Points belong together by id, else by index.
void compare_incremental(const trace::Incremental& expected, const trace::Incremental& actual,
                         const Tolerance& tolerance, std::vector<std::string>& parts);

void compare_stability(const trace::Stability& expected, const trace::Stability& actual,
                       const Tolerance& tolerance, std::vector<std::string>& parts);

/// The settings of a solver alone, without its bodies.
void compare_solver(const trace::Solver& expected, const trace::Solver& actual,
                    std::vector<std::string>& parts);

/// One body; speeds and energies that are off by no more than the tolerance's relative part of the
/// largest of `largest` count as equal.
struct BodyScale {
  double speed = 0;   // metres a second
  double spin = 0;    // radians a second
  double energy = 0;  // joules
};
BodyScale largest(const std::vector<trace::Body>& bodies);
std::vector<std::string> compare_body(const trace::Body& expected, const trace::Body& actual,
                                      const BodyScale& scale, const Tolerance& tolerance);

}  // namespace contactscope::snapshot
