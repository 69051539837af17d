#pragma once

#include "snapshot/compare_trace.h"
#include "snapshot/store.h"
#include "snapshot/verdict.h"

/// Compares stored files with the results of a run, returns findings, and writes files if the
/// policy says so. Different files may be checked by several threads at once. Every function throws
/// std::filesystem::filesystem_error if a file cannot be written or removed.
namespace contactscope::snapshot {

/// Hash of the bits of every value in the frame, ignoring the sign of zero. Absent values do not
/// count, so a new optional fact does not change the hashes of frames without it.
std::string hash_of(const trace::Frame& frame);

/// How this machine, C library and compiler options round the pipeline's operations: sines, square
/// roots, sums of products. Computed once.
const std::string& rounding();

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
struct FrameHashes {
  std::string rounding;
  std::map<int, std::string> hashes;  // by frame number
  friend bool operator==(const FrameHashes&, const FrameHashes&) = default;
};

std::string to_text(const FrameHashes& hashes);
/// Throws std::runtime_error for invalid text. `path` is for the message.
FrameHashes parse_hashes(const std::string& text, const std::string& path);

/// Stored files of one scenario.
struct StoredScenario {
  std::filesystem::path root;  // the folder "snapshots"
  std::string scenario;
  bool is_new = false;  // nothing is stored yet
};
StoredScenario archive_of(const std::filesystem::path& root, const std::string& scenario);

/// Result for one stored file.
struct Checked {
  std::optional<Finding> finding{};  // nullopt: unchanged
  bool is_written = false;           // or rewritten, or removed
};

struct CheckedPicture : Checked {
  std::optional<Image> expected{};  // as stored; set if readable and different
  std::filesystem::path nearest{};  // stored file most similar to it, likewise
};

/// Compares with each stored picture of the name: frame_0012.png, and for example
/// frame_0012.osmesa.png of another driver. Matching one of them is enough. A match with
/// frame_0012.bad_31.png is known to be bad; the note is in frame_0012.bad_31.txt. An unreadable
/// stored picture is a finding of its own kind.
CheckedPicture check_picture(const StoredScenario& archive, const PictureKey& key,
                             const Image& actual, const Policy& policy,
                             const PixelLimits& limits = {});

struct CheckedTrace : Checked {
  TraceDifferences differences{};
};

/// `actual` has exactly the frames that the scenario stores; `margins` belong to it. Throws
/// std::domain_error if a number in a trace to be written is not finite.
CheckedTrace check_trace(const StoredScenario& archive, const trace::Trace& actual,
                         const Policy& policy, const Margins& margins = {});

struct CheckedFrames : Checked {
  bool is_compared = false;    // false also if the machine that stored them rounds differently
  std::vector<int> changed{};  // frame numbers
};

/// Checks the hashes of frames that are not stored.
CheckedFrames check_frames(const StoredScenario& archive, const FrameHashes& actual,
                           const Policy& policy);

/// Stored files that the scenario no longer stores; see stale_files().
std::vector<Checked> check_stale(const StoredScenario& archive, std::span<const std::string> views,
                                 std::span<const int> frames, const Policy& policy);

/// For a check of all scenarios: stored files of scenarios that are neither in `scenarios` nor of
/// another engine. An unreadable trace is a finding and is kept.
std::vector<Checked> check_stale_scenarios(const std::filesystem::path& root,
                                           std::span<const std::string> scenarios,
                                           const Policy& policy);

/// Meshes that no stored trace uses, as scenarios "meshes/<name>". For a check of all, at the end.
std::vector<Checked> check_stale_meshes(const std::filesystem::path& root, const Policy& policy);

/// Writes a stored picture: compressed well, without metadata.
void write_stored_picture(const std::filesystem::path& path, const Image& image);

}  // namespace contactscope::snapshot
