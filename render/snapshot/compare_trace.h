#pragma once

#include "snapshot/compare_facts.h"
#include "trace/json.h"
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

/// Differences of one frame, or of the header (frame -1).
struct FrameDifferences {
  int frame = -1;
  const trace::Frame* expected = nullptr;  // null for the header
  const trace::Frame* actual = nullptr;
  std::vector<Difference> differences;
};

/// Summary of a changed trace.
struct FirstCause {
  /// "hull/face_contact frame 12, table-crate: the separating axis test now prefers face b: -19.98 mm against
  /// -20.01 mm of face a, a tie of 0.03 mm; so the reference face, 4 clip steps and 3 of 4 ids changed".
  std::string sentence;
  int frame = -1;  // of the first difference; -1: the header
  const Difference* first = nullptr;
  std::string chain;  // a part of the sentence: what changed first, and what followed
  /// Place and kind of the change in the pipeline, without numbers or names: equal for traces that
  /// one edit of the program may have changed.
  std::string signature;
  /// The scenario's file changed: a shape, a setting, or a pose that no solver has moved yet.
  bool is_input = false;
};

/// Finds the first frame with a difference and in it the earliest stage of the pipeline; the rest
/// may follow from it. If a number moved, also finds the next choice that flipped. `frames` is
/// sorted, header first, and not empty; `margins` belong to the actual frames.
FirstCause first_cause(const std::string& scenario, const std::vector<FrameDifferences>& frames,
                       const Margins& margins = {});

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
