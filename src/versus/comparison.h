#pragma once

#include "lint/linter.h"

namespace contactscope::versus {

/// An engine's response to a request.
struct EngineRun {
  std::string name;
  std::string engine, version;  // from its trace
  std::string failure;          // why the trace is missing or incomplete; empty: none
  std::string notes{};          // its program's error output
  trace::Trace trace{};
  std::string refusal{};  // its own reason not to step (this scene); empty: none
};

/// Errors of an engine's contacts, over all pairs and frames.
struct Score {
  std::string name;
  std::string failure;
  int pairs = 0;     // number tested: each pair in each frame with an answer
  int missed = 0;    // overlapping, but no contact is reported
  int invented = 0;  // separated, but an overlap is reported
  // For overlapping pairs with contacts and a known depth:
  int touching = 0;
  double mean_depth_error = 0, worst_depth_error = 0;  // metres, at the deepest point
  double worst_normal = 0;       // metres: excess of the overlap along its normal over the least
  double points = 0;             // mean
  double area = 0;               // of the patch of all points, mean; 1: the full patch
  int patches = 0;               // number with an area
  double ids_kept = 0;           // mean share of ids that were in the previous frame
  int id_frames = 0;             // frames for which ids_kept is known
  bool ids_are_made_up = false;  // from geometry, see trace::name_points: the engine has none
  std::string worst_place{};     // "frame 12, floor-crate": of the worst depth
  std::vector<lint::Finding> findings{};
};

/// Evaluates an engine's answer to `request`. Pairs listed in the other order are mirrored.
Score judge(const trace::Trace& request, const EngineRun& engine_run);

/// The pair in a frame of an engine's trace, a first; empty: no contacts reported.
std::optional<trace::Pair> pair_of(const trace::Frame& frame, const std::string& a,
                                   const std::string& b);

}  // namespace contactscope::versus
