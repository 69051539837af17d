#pragma once

#include <functional>
#include <optional>

#include "scenario/scenario.h"
#include "shrink/judge.h"
#include "shrink/pair_of_two.h"
#include "trace/trace.h"

namespace contactscope::shrink {

struct Shrunk {
  PairOfTwo pair;
  int tried = 0;  // number of pairs tested
};

/// Finds a minimal pair that keeps the property tested by the judge. Zeller and Hildebrandt 2002,
/// "Simplifying and Isolating Failure-Inducing Input", ddmin: remove parts, first halves and then
/// smaller ones, while the property holds. Steps, repeated until a round changes nothing:
///
/// 1. vertices of hulls, triangles of meshes, claimed points; boxes become hulls if that has fewer;
/// 2. keys of the pipeline;
/// 3. poses: a at the origin without rotation, b without rotation;
/// 4. numbers: to one digit, two, ... all at once, then individually.
///
/// Terminates because every accepted step has fewer vertices, or as many and fewer claims, keys or
/// digits. Deterministic: no randomness. `progress` is called after each accepted step.
Shrunk shrink(const PairOfTwo& start, Judge& judge,
              const std::function<void(const PairOfTwo&)>& progress = {});

/// A single pair of a frame: its shapes in the poses of the frame. `scenario`: source of the pair's
/// settings and expectations; null for a trace of another engine, whose claims are kept. Empty if
/// it cannot be written as a scenario of two shapes: a distance field, an unknown shape.
std::optional<PairOfTwo> pair_of_frame(const trace::Header& header, const trace::Frame& frame,
                                       const trace::Pair& pair, const Scenario* scenario);

}  // namespace contactscope::shrink
