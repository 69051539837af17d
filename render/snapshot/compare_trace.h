#pragma once

#include <string>
#include <vector>

#include "snapshot/margins.h"
#include "trace/json.h"

namespace contactscope::snapshot {

/// A frame tells no more than this many differences, then "and N more".
inline constexpr int kMostSentences = 8;

/// What differs between a stored trace and the one a run just made: sentences such as
/// "hull/face_contact frame 12, crate-floor: point 2 moved 1.3 mm along x, separation -0.0050 ->
/// -0.0037". Empty when they say the same.
///
/// Every field that trace.h lists is compared. Names, ids, indices and counts compare exactly; so do
/// which frames, pairs and stages there are. Numbers compare within a few units in the last place of
/// the expected trace's scalar (what of a pair is recorded in single precision carries no more), at
/// the size and place of the two shapes. A number that is not finite always differs. Frames belong
/// together by number, shapes by name, pairs by their names and label, points by id.
std::vector<std::string> compare_traces(const trace::Trace& expected, const trace::Trace& actual);

/// What differs, and what it began with.
struct TraceDifferences {
  std::vector<std::string> sentences{};  // as compare_traces() tells them
  std::string cause{};                   // the first of them that the others may follow from
  std::string signature{};               // of that cause; see FirstCause
  bool is_input = false;                 // likewise
  std::vector<int> frames{};             // in which something differs
  bool is_setup = false;                 // the header differs, in more than its words
  bool is_words = false;                 // title or source differ
};

/// The same for the text of a stored file, down to its bytes: where no fact differs by more than its
/// tolerance, the file must be what this program would write of `actual`, with each number that is
/// within its tolerance as it is stored. What is not tells the first line that differs. So nothing
/// in a file goes unnoticed, be it listed, compared and read or not. `path` is for messages; `margins` are of
/// `actual`, for its cause. Throws core's InputError where the text is no trace.
TraceDifferences compare_with_stored(const std::string& text, const std::string& path,
                                     const trace::Trace& actual, const Margins& margins = {});

}  // namespace contactscope::snapshot
