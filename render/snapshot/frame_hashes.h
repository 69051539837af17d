#pragma once

#include "trace/trace.h"

/// Hashes of the facts of every frame, 16 digits each. They detect changes in frames that are not
/// stored. They are in a file next to the trace:
///
///     rounding 3f2b5c0d9a7e6f14
///     0 9b1c...
///     1 04aa...
///
/// Hashes are exact, and the last digit of a sine differs between processors. The file therefore
/// records how its machine rounds. On a machine that rounds differently, hashes are not compared,
/// and the check says so.
namespace contactscope::snapshot {

/// Hash of the bits of every value in the frame, ignoring the sign of zero. Absent values do not
/// count, so a new optional fact does not change the hashes of frames without it.
std::string hash_of(const trace::Frame& frame);

/// How this machine, C library and compiler options round the pipeline's operations: sines, square
/// roots, sums of products. Computed once.
const std::string& rounding();

struct FrameHashes {
  std::string rounding;
  std::map<int, std::string> hashes;  // by frame number
  friend bool operator==(const FrameHashes&, const FrameHashes&) = default;
};

std::string to_text(const FrameHashes& hashes);
/// Throws std::runtime_error for invalid text. `path` is for the message.
FrameHashes parse_hashes(const std::string& text, const std::string& path);

}  // namespace contactscope::snapshot
