#pragma once

#include <optional>
#include <string>
#include <vector>

#include "snapshot/brittle.h"
#include "snapshot/stage.h"
#include "trace/json.h"

namespace contactscope::snapshot {

/// Limit of sentences per frame; "and N more" follows.
inline constexpr int kMaxSentences = 8;

/// The first difference: in the first frame that has one, the earliest stage of the pipeline.
struct Parting {
  int frame = -1;         // number; -1: the headers differ
  std::string subject{};  // "crate-floor", or a shape; empty: the whole frame
  Stage stage = Stage::Words;
  std::string what{};   // "point 2 moved 1.3 mm along x"
  std::string chain{};  // the same, and what followed
};

/// Differences and their first cause.
struct TraceDifferences {
  /// "hull/face_contact frame 12, crate-floor: point 2 moved 1.3 mm along x, separation -0.0050 ->
  /// -0.0037". Empty if the traces are the same.
  std::vector<std::string> sentences{};
  std::optional<Parting> first{};
  std::string cause{};        // the first difference that may explain the others
  std::string signature{};    // of the cause; see FirstCause
  bool is_input = false;      // see FirstCause
  std::vector<int> frames{};  // numbers of frames with differences
  bool is_setup = false;      // the header differs in more than its title and source
  bool is_words = false;      // title or source differ
};

/// Compares a stored trace with the one of this run; numbers of `actual` within tolerance become
/// the expected ones.
///
/// Every field listed in trace.h is compared. Names, ids, indices and counts compare exactly, and
/// so does the presence of frames, pairs and stages. Numbers compare within a few ulps of the
/// expected trace's scalar at the size and position of the two shapes (some facts of a pair are
/// recorded in single precision only). A number that is not finite always differs. Frames match by
/// number, shapes by name, pairs by names and label, points by id.
TraceDifferences compare_and_settle(const trace::Trace& expected, trace::Trace& actual,
                                    const Margins& margins = {});

/// Compares with the text of a stored file down to its bytes. If all facts agree within tolerance,
/// the file must equal what this program would write for `actual`, numbers within tolerance as
/// stored; otherwise the first different line is reported. So even keys that are not read are
/// compared. `path` is for messages; `margins` are those of `actual`, for the cause. Throws core's
/// InputError if the text is not a trace.
TraceDifferences compare_with_stored(const std::string& text, const std::string& path,
                                     const trace::Trace& actual, const Margins& margins = {});

}  // namespace contactscope::snapshot
