#pragma once

#include "trace/decision.h"
#include "trace/trace.h"
#include "view/view.h"

namespace contactscope::snapshot {

/// Margins of the pipeline's decisions, by frame and pair ("crate-floor"). They are not stored:
/// each run computes them, and changes are reported with the current ones.
using Margins = std::map<std::pair<int, std::string>, std::vector<trace::Decision>>;

/// Decisions of a frame that rounding could reverse: their margin is within the tolerance between
/// equal traces. One sentence each: "frame 12, crate-floor: axis: face_a over edge_edge by 0.2 nm,
/// which is within rounding". Only frames that were run with `decisions` have any.
std::vector<std::string> brittle_decisions(const trace::Header& header, const trace::Frame& frame);

/// Results from the decisions of the stored frames.
struct TakenDecisions {
  std::vector<std::string> brittle{};  // sentences, by frame
  Margins margins{};
};

/// Removes the decisions from all frames unless a view requests them, so that they are not stored.
/// `stored` are the numbers of the frames to report.
TakenDecisions take_decisions(const std::vector<int>& stored, const std::vector<View>& views,
                              const trace::Header& header, std::vector<trace::Frame>& frames);

}  // namespace contactscope::snapshot
