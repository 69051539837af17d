#pragma once

#include <gmock/gmock.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "lint/linter.h"
#include "scenario/run.h"

/// Correct traces in the form of another engine's, and mistakes to insert into them.
namespace contactscope::lint {

using trace::Trace;

/// Frames of a scenario as a trace of another engine: without stages.
inline Trace recorded(const std::string& file, int first, int last) {
  const Scenario scenario = load_scenario(CONTACTSCOPE_SOURCE_DIR "/" + file);
  Runner runner(scenario, trace::Stages::none());
  Trace trace{runner.header(), {}};
  for (int f = first; f <= last; ++f) {
    trace.frames.push_back(runner.frame(f));
    trace.frames.back().line = f - first + 2;
  }
  return trace;
}

/// Spheres, capsules and boxes in a heap on a plane.
inline const Trace& heap() {
  static const Trace kTrace = recorded("tests/lint/heap.toml", 40, 80);
  return kTrace;
}
/// Crates at rest, each on the one below.
inline const Trace& stack() {
  static const Trace kTrace = recorded("scenarios/solver/stack_of_ten.toml", 60, 90);
  return kTrace;
}
/// A crate, a capsule and others on a mesh.
inline const Trace& terrain() {
  static const Trace kTrace = recorded("tests/lint/terrain.toml", 30, 60);
  return kTrace;
}

using Mistaken = std::function<void(Trace&)>;

inline void each_pair(Trace& trace,
                      const std::function<void(trace::Frame&, trace::Pair&)>& change) {
  for (trace::Frame& frame : trace.frames)
    for (trace::Pair& pair : frame.pairs) change(frame, pair);
}
inline void each_manifold(
    Trace& trace,
    const std::function<void(trace::Frame&, trace::Pair&, trace::Manifold&)>& change) {
  each_pair(trace, [&](trace::Frame& frame, trace::Pair& pair) {
    for (trace::Manifold& manifold : pair.manifolds) change(frame, pair, manifold);
  });
}
inline void each_point(
    Trace& trace, const std::function<void(trace::Frame&, trace::Pair&, trace::Point&)>& change) {
  each_manifold(trace, [&](trace::Frame& frame, trace::Pair& pair, trace::Manifold& manifold) {
    for (trace::Point& point : manifold.points) change(frame, pair, point);
  });
}

inline Pose<double>& pose_of(trace::Frame& frame, const std::string& name) {
  return std::ranges::find(frame.poses, name, &trace::Placement::first)->second;
}

struct Seed {
  const char* name;
  const Trace& (*trace)();
  Mistaken sow;
  const char* cause;
};

inline std::vector<std::string> causes_of(const std::vector<Finding>& findings) {
  std::vector<std::string> causes;
  for (const Finding& finding : findings) causes.push_back(finding.cause);
  return causes;
}

/// Expects that the mistake is named first, with few other findings.
inline void expect_named(const Seed& seed) {
  SCOPED_TRACE(seed.name);
  Trace trace = seed.trace();
  seed.sow(trace);
  const std::vector<Finding> findings = lint(trace);
  ASSERT_FALSE(findings.empty());
  EXPECT_EQ(findings.front().cause, seed.cause)
      << testing::PrintToString(causes_of(findings)) << findings.front().said << "; "
      << findings.front().is;
  EXPECT_LE(findings.size(), 2u) << testing::PrintToString(causes_of(findings));
  EXPECT_GT(findings.front().count, 0);
  EXPECT_FALSE(findings.front().remedy.empty());
}

}  // namespace contactscope::lint
