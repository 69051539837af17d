#pragma once

#include <string>
#include <vector>

#include "lint/linter.h"
#include "trace/json.h"

namespace contactscope::versus {

/// What an engine made of a request.
struct EngineRun {
  std::string name;
  std::string engine, version;  // as its trace says
  std::string failure;          // why there is no trace, or less than was asked; empty: none
  std::string notes{};          // what its program said
  trace::Trace trace{};
  std::string
      refusal{};  // it steps nothing, or not this, in its own words; empty: it was not asked, or does
};

/// How an engine's contacts stand to the truth, over all pairs and frames.
struct Score {
  std::string name;
  std::string failure;
  int pairs = 0;     // that were judged: each pair in each frame that was answered
  int missed = 0;    // they overlap, and no contact is told
  int invented = 0;  // they are apart, and an overlap is told
  // Of pairs that overlap and have contacts, of which the depth is known:
  int touching = 0;
  double mean_depth_error = 0, worst_depth_error = 0;  // metres, of the deepest point
  double worst_normal = 0;  // metres: how much more the overlap along its normal is than the least
  double points = 0;        // in the mean
  double area = 0;          // of the patch that all points span, in the mean; 1: all of it
  int patches = 0;          // that have an area
  double ids_kept = 0;      // share of ids that were there in the frame before, in the mean
  int id_frames = 0;        // of which that is known
  bool ids_are_made_up = false;  // from geometry, see trace::name_points: the engine tells none
  std::string worst_place{};     // "frame 12, floor-crate": of the depth
  std::vector<lint::Finding> findings{};
};

/// Judges what an engine answered to `request`. Pairs that it lists in the other order are turned round.
Score judge(const trace::Trace& request, const EngineRun& engine_run);

/// The pair of a frame of a contender's trace, a first; empty: it told no contacts of it.
std::optional<trace::Pair> pair_of(const trace::Frame& frame, const std::string& a,
                                   const std::string& b);

}  // namespace contactscope::versus
