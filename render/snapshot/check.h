#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "image/image.h"
#include "snapshot/compare_trace.h"
#include "snapshot/frame_hashes.h"
#include "snapshot/store.h"
#include "snapshot/verdict.h"

/// From a stored file and what a run made to a finding, and to the file where the policy says so.
/// Different files may be checked from several threads at once. Every function throws
/// std::filesystem::filesystem_error where a file cannot be written or removed.
namespace contactscope::snapshot {

/// What is stored of one scenario.
struct Shelf {
  std::filesystem::path root;  // the folder "snapshots"
  std::string scenario;
  bool is_new = false;  // there is nothing yet
};
Shelf shelf_of(const std::filesystem::path& root, const std::string& scenario);

/// What came of one stored file.
struct Checked {
  std::optional<Finding> finding{};  // nothing where it is as it was
  bool is_written = false;           // or rewritten, or removed
};

struct CheckedPicture : Checked {
  std::optional<Image> expected{};  // as stored; set where it can be read and differs
  std::filesystem::path nearest{};  // the stored file that is like it most, likewise
};

/// Held against each picture that is stored under its name: frame_0012.png, and beside it frame_0012.osmesa.png of
/// another driver. It is the same where it is like any of them. Where it is like frame_0012.bad_31.png it
/// is known to be bad, as the note beside that, frame_0012.bad_31.txt, says. A stored picture that cannot be
/// read is a finding of its own kind.
CheckedPicture check_picture(const Shelf& shelf, const PictureKey& key, const Image& actual,
                             const Policy& policy, const PixelLimits& limits = {});

struct CheckedTrace : Checked {
  TraceDifferences differences{};
};

/// `actual` holds the frames that the scenario stores, no more and no fewer; `margins` are its own. Throws
/// std::domain_error where a trace with a number that is not finite would have to be written.
CheckedTrace check_trace(const Shelf& shelf, const trace::Trace& actual, const Policy& policy,
                         const Margins& margins = {});

struct CheckedFrames : Checked {
  bool is_compared =
      false;  // false too where this machine rounds otherwise than the one that stored them
  std::vector<int> changed{};  // numbers of the frames that did
};

/// Those of frames that are not stored.
CheckedFrames check_frames(const Shelf& shelf, const FrameHashes& actual, const Policy& policy);

/// Stored files that the scenario does not store any more; see stale_files().
std::vector<Checked> check_stale(const Shelf& shelf, std::span<const std::string> views,
                                 std::span<const int> frames, const Policy& policy);

/// The same for every file of scenarios that are stored but not in `scenarios` and not of another engine; for a
/// check of all. A trace that cannot be read is a finding too, and stays.
std::vector<Checked> check_stale_scenarios(const std::filesystem::path& root,
                                           std::span<const std::string> scenarios,
                                           const Policy& policy);

/// Meshes that no stored trace names, each as of a scenario "meshes/<name>"; for a check of all, after the others.
std::vector<Checked> check_stale_meshes(const std::filesystem::path& root, const Policy& policy);

/// As a stored picture is written: once, and read by every clone.
void write_stored_picture(const std::filesystem::path& path, const Image& image);

}  // namespace contactscope::snapshot
