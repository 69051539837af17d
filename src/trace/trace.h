#pragma once

#include "trace/frame.h"

/// The facts that each stage of the pipeline decided: world space, metres, double. Float results
/// are held exactly. No algorithms here; an optional stage that did not run, or that nobody asked
/// for, is empty. Each struct lists its fields (field.h); README.md gives the JSON that follows.
namespace contactscope::trace {

/// Which optional stages to record: what no picture shows need not be written down. The arcs of the
/// Gauss map and the Minkowski difference are large and say nothing that the shapes do not: they are
/// only recorded where a view asks for them.
struct Stages {
  bool sat = true;
  bool clip = true;
  bool reduction = true;
  bool tree = true;
  bool gjk = true;
  bool gauss_map = false;
  bool penetration = true;
  bool minkowski = false;
  bool stability = true;

  static constexpr Stages none() {
    return {false, false, false, false, false, false, false, false, false};
  }
};

}  // namespace contactscope::trace
