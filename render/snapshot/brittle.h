#pragma once

#include <string>
#include <vector>

#include "core/view.h"
#include "snapshot/margins.h"
#include "trace/trace.h"

namespace contactscope::snapshot {

/// Decisions of a frame that rounding could take otherwise: of which the margin is no more than what a trace may
/// differ by and still count as the same. A sentence each: "frame 12, crate-floor: axis: face_a over edge_edge by
/// 0.2 nm, which is within rounding". Only frames that were run with `decisions` have any.
std::vector<std::string> brittle_decisions(const trace::Header& header, const trace::Frame& frame);

/// What the decisions of the frames that are stored say.
struct TakenDecisions {
  std::vector<std::string> brittle{};  // sentences, by frame
  Margins margins{};
};

/// Takes the decisions out of all frames where no view asks for them, so that they are not stored; `stored` are
/// the numbers of the frames of which they are told.
TakenDecisions take_decisions(const std::vector<int>& stored, const std::vector<View>& views,
                              const trace::Header& header, std::vector<trace::Frame>& frames);

}  // namespace contactscope::snapshot
