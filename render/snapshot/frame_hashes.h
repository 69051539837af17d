#pragma once

#include <map>
#include <string>

#include "trace/trace.h"

/// The facts of every frame, as 16 digits each: those of frames that are not stored are held by these, in a
/// file beside the trace, so that no frame changes unnoticed.
///
///     rounding 3f2b5c0d9a7e6f14
///     0 9b1c...
///     1 04aa...
///
/// A hash tells nothing of how much a number changed, and the last digit of a sine is not the same on
/// all processors. So the file says how the machine that wrote it rounds; where another one rounds in another
/// way, its hashes are not compared, and that is told.
namespace contactscope::snapshot {

/// Of every value in the frame, down to its bits, but for the sign of zero. What is not there counts for nothing, so
/// that a new optional fact leaves the hashes of frames without it alone.
std::string hash_of(const trace::Frame& frame);

/// How this machine, with this C library and these compiler's options, rounds what the pipeline computes with:
/// sines, square roots, sums of products. Worked out once.
const std::string& rounding();

struct FrameHashes {
  std::string rounding;
  std::map<int, std::string> hashes;  // by the frame's number
  friend bool operator==(const FrameHashes&, const FrameHashes&) = default;
};

std::string to_text(const FrameHashes& hashes);
/// Throws std::runtime_error where the text is none of the above. `path` is for the message.
FrameHashes parse_hashes(const std::string& text, const std::string& path);

}  // namespace contactscope::snapshot
